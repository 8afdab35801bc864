// What a function is at the start, the middle and the end of a step.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>

#include "ode/tolerances.h"

namespace gainsmith::ode {

struct StepRange {
  double low = 0, high = 0;

  /// The least and the largest of function(points[k]), three evaluations.
  template <class Function>
  StepRange(const Function& function, const std::array<Eigen::VectorXd, 3>& points) {
    const std::array<double, 3> values = {function(points[0]), function(points[1]),
                                          function(points[2])};
    low = *std::min_element(values.begin(), values.end());
    high = *std::max_element(values.begin(), values.end());
  }

  /// Whether the function is so far from 0 that it has no root on the step. `sign`: on which
  /// side; 0: any.
  bool is_far_from_zero(double sign = 0) const {
    const double above = sign >= 0 ? low : -high;
    const double below = sign == 0 ? -high : above;
    return std::max(above, below) > kFar * (high - low);
  }
};

}  // namespace gainsmith::ode
