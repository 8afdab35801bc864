// Errors of a text in double, by running error analysis (bounded/ball.h): what its evaluation
// rounds, and what errors of the variables make of it where it branches. Two runs that are compared
// do not show either: they round alike, and may both take the wrong branch.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "bounded/bounded_system.h"
#include "claims/run_values.h"

namespace gainsmith::claims {

/// Constants with their errors: what is no whole number counts as rounded once, as decimals are.
bounded::BallsOf<double> rounded_once(const numbers::Values& constants);

/// Of a number as a function of all variables. All arguments must outlive it.
class TextBall {
 public:
  /// `value` is the program as a function.
  TextBall(const expr::Program& program, RunValue& value, const hybrid::StateLayout& layout,
           const bounded::BallsOf<double>& constants);

  /// How far the computed value may be from the true one at x; 0 where no bound is known.
  double rounding(const Eigen::VectorXd& x);

  /// Whether it is uncertain which branch is taken when the variables may be off by r. An estimate
  /// decides where no bound is known.
  bool is_open(const Eigen::VectorXd& x, const Eigen::VectorXd& r);
  /// All values that it may have then; infinite where no bound is known.
  bounded::Bounded<double> hull(const Eigen::VectorXd& x, const Eigen::VectorXd& r);

 private:
  bool is_open(std::size_t k, const Eigen::VectorXd& x, const Eigen::VectorXd& r);

  RunValue* value_;
  bounded::BallFunction<double> function_;
  std::vector<bounded::BallFunction<double>> differences_;
  Eigen::VectorXd exact_;
};

}  // namespace gainsmith::claims
