// Intervals: bounds of what operations on numbers give when their operands lie anywhere in theirs,
// rounding included (Moore, Interval Analysis, 1966):
//
//   a + b   [a.low + b.low, a.high + b.high]       a b   the hull of the four products of ends
//   f(a)    [f(a.low), f(a.high)] where f rises
//
// Ends are computed in rounding to nearest and moved outward: by 2^-52 of them, of functions of
// libm by 2^-50; products and functions also by the least double. Whole numbers up to 2^53 stay
// exact.
#pragma once

#include <algorithm>
#include <vector>

#include "numbers/graph/scalar_graph.h"

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
