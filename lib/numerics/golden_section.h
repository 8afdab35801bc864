// The largest value of a function with one peak.
#pragma once

#include <numbers>
#include <utility>

namespace gainsmith::numerics {

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

}  // namespace gainsmith::numerics
