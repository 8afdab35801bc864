// Steps of the backward differentiation formulas for stiff flows, with Newton's method: CVODE of
// SUNDIALS (Hindmarsh et al., ACM Trans. Math. Software 31, 2005).
//
//   x_{k+1} = sum_i alpha_i x_{k-i} + h beta f(t_{k+1}, x_{k+1}),   orders 1 to 5
//
// The Jacobian is dense, by differences. It is made anew after five steps at the latest.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "ode/guarded_rate.h"

namespace gainsmith::ode {

class ImplicitSteps {
 public:
  /// `rate` must outlive it.
  explicit ImplicitSteps(GuardedRate& rate);
  ~ImplicitSteps();

  /// As Integrator::start, after GuardedRate::begin.
  void start(double t, const Eigen::VectorXd& x, double last, double relative,
             const Eigen::VectorXd& absolute, double longest);
  /// A step; false: none is short enough.
  bool step();

  double t() const;
  /// Whether x has grown, and goes on at the rate that f was evaluated to last.
  bool has_escaped() const;
  /// Of the polynomial of the last step.
  int degree() const;
  /// x at a time of the last step.
  void within(double t, Eigen::VectorXd& x) const;

 private:
  class Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace gainsmith::ode
