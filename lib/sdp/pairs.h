// Sums of products of double-double numbers, kept in two halves.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "base/double_double.h"

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

/// A power of two above `value`; 0 for 0 (and for what is not normalised).
inline double power_above(double value) {
  constexpr std::uint64_t kExponent = 0x7ff0000000000000;
  return 2 * std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) & kExponent);
}

/// kLanes doubles: one register, if the machine has such.
using PairLanes = double __attribute__((vector_size(kLanes * sizeof(double))));

/// The halves of kLanes numbers apart, and together again.
inline void split_pairs(const DoubleDouble* from, PairLanes& high, PairLanes& low) {
  PairLanes first, second;
  std::memcpy(&first, from, sizeof first);
  std::memcpy(&second, from + kLanes / 2, sizeof second);
  high = __builtin_shufflevector(first, second, 0, 2, 4, 6, 8, 10, 12, 14);
  low = __builtin_shufflevector(first, second, 1, 3, 5, 7, 9, 11, 13, 15);
}
inline void join_pairs(const PairLanes& high, const PairLanes& low, DoubleDouble* to) {
  const PairLanes first = __builtin_shufflevector(high, low, 0, 8, 1, 9, 2, 10, 3, 11);
  const PairLanes second = __builtin_shufflevector(high, low, 4, 12, 5, 13, 6, 14, 7, 15);
  std::memcpy(static_cast<void*>(to), &first, sizeof first);
  std::memcpy(static_cast<void*>(to + kLanes / 2), &second, sizeof second);
}

/// kLanes x count sums for matrix products, at half the operations of PairSums: `high` starts from
/// a bias of 3 u, u a bound of the sum of |a b|, and so stays in the binade [2 u, 4 u). There s =
/// high + a b, rounded once, has the errors high - s and a b + (high - s), the former exact. What
/// is lost is relative to u, the product of the bounds of row and column, not to each sum: 2^-104
/// times a few.
template <std::size_t count>
class BiasedSums {
 public:
  /// row[r] column[q] >= sum of |a_r b_q|, all of them powers of two (or 0).
  BiasedSums(const double* row, const std::array<double, count>& column) {
    for (std::size_t q = 0; q < count; ++q)
      for (std::size_t r = 0; r < kLanes; ++r) bias_[q][r] = 3 * row[r] * column[q];
    high_ = bias_;
  }
  /// Lane r: a_r b_q, where b_q is q strides from b.
  void add(const double* a_high, const double* a_low, const DoubleDouble* b,
           std::ptrdiff_t stride) {
    Lanes high, low;
    std::memcpy(&high, a_high, sizeof high);
    std::memcpy(&low, a_low, sizeof low);
#pragma GCC unroll 8
    for (std::size_t q = 0; q < count; ++q, b += stride) {
      const Lanes b_high = Lanes{} + b->hi(), b_low = Lanes{} + b->lo();
      Lanes sum, error;
      multiply_add(high, b_high, high_[q], sum);
      const Lanes moved = high_[q] - sum;
      multiply_add(high, b_high, moved, error);
      high_[q] = sum;
      multiply_add(high, b_low, error, error);
      multiply_add(low, b_high, error, error);
      low_[q] += error;
    }
  }

  /// c_r = the sum q of lane r, or c_r loses it; with an error of 2^-105 of the larger one.
  void store(std::size_t q, bool subtract, DoubleDouble* c) const {
    Lanes high = high_[q] - bias_[q], low = low_[q];
    if (subtract) {
      Lanes c_high, c_low;
      split_pairs(c, c_high, c_low);
      const Lanes difference = c_high - high;
      const Lanes moved = difference - c_high;
      low = ((c_high - (difference - moved)) - (high + moved)) + (c_low - low);
      high = difference;
    }
    const Lanes sum = high + low;
    const Lanes moved = sum - high;
    join_pairs(sum, (high - (sum - moved)) + (low - moved), c);
  }

 private:
  using Lanes = PairLanes;

  static void multiply_add(const Lanes& a, const Lanes& b, const Lanes& c, Lanes& result) {
    for (int r = 0; r < kLanes; ++r) result[r] = std::fma(a[r], b[r], c[r]);
  }

  std::array<Lanes, count> bias_, high_, low_{};
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
