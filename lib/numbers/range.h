// Intervals: bounds of what operations on numbers give when their operands lie anywhere in theirs,
// rounding included.
#pragma once

#include <algorithm>
#include <vector>

#include "numbers/scalar_graph.h"

namespace gainsmith::numbers {

/// [low, high].
struct Range {
  double low = 0, high = 0;

  double largest() const { return std::max(-low, high); }       ///< |x| is not above it
  double least() const { return std::max({low, -high, 0.0}); }  ///< not below it
  void widen(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
};

using Box = std::vector<Range>;

/// Writes the bounds of the operation to `out`. False: it may have no value, or none are known.
/// `square`: a and b are the same number.
bool enclose(ScalarOp op, const Range& a, const Range& b, const Range& c, bool square, Range& out);

}  // namespace gainsmith::numbers
