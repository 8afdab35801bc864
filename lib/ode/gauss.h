// The implicit Runge-Kutta method of Gauss with four stages, of order 8, for x' = f(t, x).
//
//   Z_i = h sum_j a_ij f(t + c_j h, x + Z_j),   x(t + h) = x + sum_i d_i Z_i
//
// c, b and a_ij as in gauss_stages.h, d' = b' A^-1, so that a stiff f does not multiply the errors
// of Z. A-stable and symmetric (Hairer & Wanner, "Solving ordinary differential equations II", IV.5
// and IV.8).
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "numbers/matrix.h"

namespace gainsmith::ode {

/// c, b, A (a_ij) and d of the header.
struct GaussTableau {
  Eigen::Vector4d c;
  Eigen::Vector4d b;
  Eigen::Matrix4d A;
  Eigen::Vector4d d;
};

/// The coefficients of four stages, to rounding of double.
GaussTableau gauss_tableau();

class GaussIntegrator {
 public:
  /// Writes x' at (t, x). std::runtime_error from it counts as a step that does not converge.
  using Rate = std::function<void(double t, const Eigen::VectorXd& x, Eigen::VectorXd& rate)>;
  /// Where the solution may lie; a start for the stages, of no influence on what they converge to.
  using Guess = std::function<Eigen::VectorXd(double t)>;

  /// For x of `size` elements.
  GaussIntegrator(Eigen::Index size, Rate rate);

  /// One step from x at t. `tolerance` > 0, one an element: the equations of the stages are solved
  /// to a hundredth of it. Fixed-point iterations do that; where they do not contract, Newton's
  /// method with a Jacobian of differences. None when neither converges.
  std::optional<Eigen::VectorXd> step(double t, const Eigen::VectorXd& x, double h,
                                      const Eigen::VectorXd& tolerance, const Guess& guess);

 private:
  /// Z <- h A F(Z), at most kMostIterations times; false where that does not contract by 2.
  bool fixed_point(double t, const Eigen::VectorXd& x, double h, const Eigen::VectorXd& tolerance);
  /// (I - h A (x) J) dZ = h A F(Z) - Z, 4n x 4n with Kronecker's product, where J, n x n, is the
  /// Jacobian at the start of the step.
  bool newton(double t, const Eigen::VectorXd& x, double h, const Eigen::VectorXd& tolerance);
  /// h A F(Z) - Z, one column a stage; false where f has no finite value.
  bool residual(double t, const Eigen::VectorXd& x, double h);
  /// By differences; with elements that are not finite where f has no value.
  numbers::Matrix jacobian(double t, const Eigen::VectorXd& x, const Eigen::VectorXd& tolerance);

  GaussTableau tableau_;
  Rate rate_;
  numbers::Matrix stages_;  ///< Z, one column a stage
  numbers::Matrix rates_;
  numbers::Matrix residual_;
  Eigen::VectorXd at_, value_;
};

}  // namespace gainsmith::ode
