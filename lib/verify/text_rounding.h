// What the evaluation of a text in double rounds, by running error analysis (hybrid/ball.h): two
// runs that are compared round it alike, as where it cancels.
#pragma once

#include <Eigen/Core>

#include "hybrid/bounded_system.h"

namespace gainsmith::verify {

/// Constants with their errors: what is no whole number counts as rounded once, as decimals are.
hybrid::BallsOf<double> rounded_once(const numbers::Values& constants);

/// Of a number as a function of all variables. The program and the constants must outlive it.
class TextRounding {
 public:
  TextRounding(const expr::Program& program, const hybrid::StateLayout& layout,
               const hybrid::BallsOf<double>& constants);

  /// How far the computed value may be from the true one at x; 0 where no bound is known.
  double operator()(const Eigen::VectorXd& x);

 private:
  hybrid::BallFunction<double> function_;
  Eigen::VectorXd exact_;
};

}  // namespace gainsmith::verify
