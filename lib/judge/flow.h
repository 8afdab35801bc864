// Internal to the judge (judge.h): flows, integrated again.
//
// Each step is integrated again by Gauss steps of order 8 (step.h) and compared at its quarters:
//
//   |recorded - again| <= kFactor sqrt(n) (relative |x| + absolute),   n moving elements
//
// Errors of one sign add up to a drift. So the sum of the signed differences over a flow of N steps
// is bounded too, by kFactor (1 + kCertain N) accuracies.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "hybrid/trajectory.h"
#include "judge/faults.h"
#include "judge/step.h"
#include "judge/texts.h"

namespace gainsmith::judge {

/// The sum of the sizes of the coefficients, the largest of each variable: a bound for its values
/// on the step, to which rounding and accuracy are relative.
Eigen::VectorXd step_sizes(const Texts& texts, const hybrid::DenseStep& step);

/// What each element moves at x in a few units in the last place of t. 0 where there is no rate.
Eigen::VectorXd time_rounding_at(Texts& texts, double t, const Eigen::VectorXd& x);

/// How far each element may be off at x by rounding, 0 of what rests:
///   1e-13 of its size,
///   a thousandth of the accuracy: a step that ends at an event is part of a longer one, of larger
///   values,
///   and time_rounding_at: events lie at times that are rounded too.
Eigen::VectorXd rounding_at(Texts& texts, double t, const Eigen::VectorXd& x,
                            const Eigen::VectorXd& sizes);

/// Checks one piece after the other. Texts and faults must outlive it.
class FlowCheck {
 public:
  FlowCheck(Texts& texts, Faults& faults);

  /// The piece alone; where it begins is known to be right.
  void operator()(std::size_t part, const hybrid::FlowPiece& piece);

 private:
  /// The end of a step, x, against the start of the next; noise and measured data may change there.
  void check_joint(const Eigen::VectorXd& x, double t, const Eigen::VectorXd& next,
                   const Eigen::VectorXd& sizes, bool inner, const Eigen::VectorXd& shift);
  /// At 17 points of the step: what rests has its value, and clocks are lines of rate 1 or -1.
  void check_rest(const hybrid::DenseStep& step, const Eigen::VectorXd& x,
                  const Eigen::VectorXd& sizes);
  /// Adds to `sum` the difference at the end.
  void check_step(const hybrid::DenseStep& step, const Eigen::VectorXd& x,
                  const Eigen::VectorXd& sizes, Eigen::VectorXd& sum);
  /// The worst element of each variable.
  void report(double t, const std::string& what, const Eigen::VectorXd& size,
              const Eigen::VectorXd& allowed);

  Texts& texts_;
  Faults& faults_;
  std::size_t part_ = 0;
  std::vector<bool> flowing_;  ///< by variable
  MovingElements moving_;
};

}  // namespace gainsmith::judge
