// Round numbers on an axis.
#pragma once

#include <cstdint>
#include <string>

namespace gainsmith::drawing {

/// The multiples k s, k = first, ..., last, of the step s = multiplier 10^exponent, multiplier 1, 2
/// or 5, of degrees other whole ones. They are decimals, so each is the double nearest to what its
/// label says.
struct Ticks {
  std::int64_t first = 0;
  std::int64_t last = 0;
  int multiplier = 1;
  int exponent = 0;

  std::int64_t count() const { return last - first + 1; }
  double value(std::int64_t k) const;
  std::string label(std::int64_t k, int factor = 0) const;  ///< of the value divided by 10^factor
};

/// All multiples within [low, high] of the smallest step, at least 10^smallest_exponent, that has
/// at most `most` of them (>= 3). Where smallest_exponent does not bind these are at least 2 most /
/// 5, rounded down: 4 to 10 for 10. A ten-thousandth of a step outside is within. Demands finite
/// ends with high - low >= 1e-300 and >= 1e-10 times the greater size of both.
Ticks ticks(double low, double high, int most, int smallest_exponent = -310);

/// The same of degrees: between 10 and 36000 the step is 15, 30, 45, 90, 180 or a number of turns.
Ticks ticks_of_degrees(double low, double high, int most);

}  // namespace gainsmith::drawing
