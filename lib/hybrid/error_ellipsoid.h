// Bounds of errors that take many steps  e+ = E e + d,  |d_i| <= delta_i.
//
// Bounds element by element would grow with the powers of |E|, which says nothing of E. Instead
//
//   Y+ = E Y E' + n diag(delta)^2,  m the number of deltas:
//   |c' e|^2 <= (sum of |c' Phi_i| delta_i)^2 <= m c' Y c   for every c (Cauchy and Schwarz)
//
// so errors turn and die down as the steps do, and |e_i| <= sqrt(m Y_ii). Y is kept as G G' + Z: Z
// is what came since the last gather(), which takes it into G by the factorisation
// [G, sqrt(n diag Z)]' = Q R. Both are computed in double. The rounding of E G is a delta like the
// others, eps |E| |G|, so G may fall over hundreds of decades; that of E Z E', at most eps g_i g_j
// with g = |E| sqrt(diag Z), is covered by n eps g^2 on the diagonal.
#pragma once

#include <Eigen/Core>
#include <Eigen/QR>

#include "numbers/matrix.h"

namespace gainsmith::hybrid {

class ErrorEllipsoid {
 public:
  /// Errors with |e_i| <= delta_i.
  void start(const Eigen::VectorXd& delta);
  /// `E` in double, `sizes` = |E|; `slack`: relative errors of E besides its rounding.
  void step(const numbers::Matrix& E, const numbers::Matrix& sizes, double slack,
            const Eigen::VectorXd& delta);
  /// Takes Z into G: cheaper and sharper steps follow.
  void gather();

  /// |e_i| is at most this.
  const Eigen::VectorXd& bounds() const { return bounds_; }

 private:
  void set_bounds();
  void rescale(double largest);

  Eigen::VectorXd bounds_;
  numbers::Matrix G_, Z_, product_;
  Eigen::VectorXd norm_, root_;  ///< of the rows of G_; of the diagonal of Z_
  double scale_ = 1;             ///< G is scale G_, Z is scale^2 Z_
  double steps_ = 0;             ///< m
  numbers::Matrix stacked_;
  Eigen::HouseholderQR<numbers::Matrix> factored_;
};

}  // namespace gainsmith::hybrid
