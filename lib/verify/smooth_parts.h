// The parts of a step on which a value is smooth, and where it is largest there.
#pragma once

#include <numbers>
#include <utility>
#include <vector>

#include "verify/run_values.h"

namespace gainsmith::verify {

struct SmoothPart {
  double from = 0;
  double to = 0;
  bool after_jump = false;   ///< the value jumps just before it
  bool before_jump = false;  ///< just after it
};

/// In order, at least one.
std::vector<SmoothPart> smooth_parts(RunValue& value, const hybrid::DenseStep& step);

/// Where a function is largest in [low, high], if it has one peak there: by golden section.
template <class Function>
double peak_between(const Function& at, double low, double high, int sections = 50) {
  const double ratio = std::numbers::phi - 1;
  double a = high - ratio * (high - low);
  double b = low + ratio * (high - low);
  double at_a = at(a);
  double at_b = at(b);
  for (int k = 0; k < sections && low < a && a < b && b < high; ++k) {
    if (at_a >= at_b) {
      high = std::exchange(b, std::exchange(a, b - ratio * (b - low)));
      at_b = std::exchange(at_a, at(a));
    } else {
      low = std::exchange(a, std::exchange(b, a + ratio * (high - a)));
      at_a = std::exchange(at_b, at(b));
    }
  }
  return at_a >= at_b ? a : b;
}

}  // namespace gainsmith::verify
