// Sums of products of double-double numbers, kept in two halves.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "sdp/double_double.h"

namespace gainsmith::sdp {

constexpr int kLanes = 8;

/// (high, low) += (a_high + a_low) (b_high + b_low), with the rounding errors of the product and of
/// the sum (Ogita, Rump, Oishi 2005, Dot2, extended to factors of two halves): as accurate as if
/// computed in twice the precision and rounded.
inline void add_product(double& high, double& low, double a_high, double a_low, double b_high,
                        double b_low) {
  const double p = a_high * b_high;
  double e = std::fma(a_high, b_high, -p);
  e = std::fma(a_high, b_low, e);
  e = std::fma(a_low, b_high, e);
  const double s = high + p;
  const double t = s - high;
  low += ((high - (s - t)) + (p - t)) + e;
  high = s;
}

/// One such sum.
struct PairSum {
  double high = 0, low = 0;

  void add(const DoubleDouble& a, const DoubleDouble& b) {
    add_product(high, low, a.hi(), a.lo(), b.hi(), b.lo());
  }
  DoubleDouble value() const { return DoubleDouble(high) + DoubleDouble(low); }
};

/// kLanes of them side by side, for the vector unit.
struct PairSums {
  std::array<double, kLanes> high{}, low{};

  /// One factor for all lanes.
  void add(const double* a_high, const double* a_low, double b_high, double b_low) {
    for (std::size_t r = 0; r < kLanes; ++r)
      add_product(high[r], low[r], a_high[r], a_low[r], b_high, b_low);
  }
  /// a_r b_r in lane r.
  void add(const DoubleDouble* a, const DoubleDouble* b) {
    for (std::size_t r = 0; r < kLanes; ++r)
      add_product(high[r], low[r], a[r].hi(), a[r].lo(), b[r].hi(), b[r].lo());
  }
  DoubleDouble operator[](std::size_t r) const {
    return DoubleDouble(high[r]) + DoubleDouble(low[r]);
  }
  /// The sum over the lanes.
  PairSum total() const {
    PairSum sum;
    for (std::size_t r = 0; r < kLanes; ++r) {
      add_product(sum.high, sum.low, high[r], 0, 1, 0);
      sum.low += low[r];
    }
    return sum;
  }
};

/// sum of a_i b_i, i < count.
inline DoubleDouble inner_product(const DoubleDouble* a, const DoubleDouble* b, std::size_t count) {
  PairSums lanes;
  std::size_t i = 0;
  for (; i + kLanes <= count; i += kLanes) lanes.add(a + i, b + i);
  PairSum sum = i > 0 ? lanes.total() : PairSum{};
  for (; i < count; ++i) sum.add(a[i], b[i]);
  return sum.value();
}

}  // namespace gainsmith::sdp
