// x' = f(t, x) in steps of an error control; within a step the solution is a polynomial.
//
// The explicit method of order 8 of Dormand and Prince (explicit_steps.h); where what decays fast
// keeps its steps short, or none is short enough, the flow is stiff and goes on with BDF
// (implicit_steps.h).
//
// The folder holds the ordinary differential equations of a run, in double, and functions of time
// along their solutions. Errors are estimated, not bounded.
//   integrator.h              the choice of the method, step by step
//   dormand_prince.h          coefficients of the explicit method;  step_control.h  its lengths
//   gauss.h, gauss_stages.h   implicit Runge-Kutta steps of a given length, of order 2 s
//   exponential_tables.h      matrix exponentials that exact flows share
//   chebyshev.h, roots.h      series of functions on a step, and all their roots
//   guarded_rate.h            f with its faults;  tolerances.h  all sizes that decide
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

namespace gainsmith::ode {

/// A flow that cannot be continued.
struct IntegrationError : std::runtime_error {
  IntegrationError(const std::string& message, double at, bool escaped_, bool undefined_ = false)
      : std::runtime_error(message), t(at), escaped(escaped_), undefined(undefined_) {}
  double t;
  bool escaped;    ///< x has grown while the steps fell to nothing
  bool undefined;  ///< f has no value
};

class Integrator {
 public:
  /// Writes x' at (t, x). What it throws shortens the step; where no step is short enough, it ends
  /// the integration.
  using Rate = std::function<void(double t, const Eigen::VectorXd& x, Eigen::VectorXd& rate)>;

  /// `size` elements of x. Of size 0 there is nothing to integrate: the one step leads to `last`.
  Integrator(Eigen::Index size, Rate rate);
  Integrator(Integrator&&) noexcept;
  Integrator& operator=(Integrator&&) noexcept;
  ~Integrator();

  /// From x at t on. `absolute`: the error of each element that counts as `relative` of it, > 0. f
  /// is not evaluated after `last`, and no step is longer than `longest`: what lasts less may be
  /// stepped over.
  void start(double t, const Eigen::VectorXd& x, double last, double relative,
             const Eigen::VectorXd& absolute, double longest);

  /// Over one step x is a polynomial of time.
  struct Step {
    double from = 0;
    double to = 0;
    int degree = 0;
  };

  /// The next step, of a length that the error control chooses, at most to
  /// `last`. IntegrationError where the flow ends before.
  Step step();
  /// Writes x at a time t of the last step, from its polynomial; no value of f is asked for. Leaves
  /// `x` as it is for size 0.
  void within(double t, Eigen::VectorXd& x);

 private:
  class Methods;
  std::unique_ptr<Methods> methods_;
  double t_ = 0, last_ = 0;  ///< of a flow of size 0
};

}  // namespace gainsmith::ode
