// Sums of products of double-double numbers, kept in two halves.
#pragma once

#if defined(__FMA__)
#include <immintrin.h>
#endif

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "base/double_double.h"

namespace gainsmith::sdp {

constexpr int kLanes = 8;

/// A vector register of the machine, and a b + c in it. The instruction is named: compilers prefer
/// to fuse element by element where they think that wide registers cost speed. Registers of AVX-512
/// gain nothing here (docs/decisions/0057-one-program.md).
#if defined(__FMA__)
constexpr int kWidth = 4;
using Register = double __attribute__((vector_size(32)));
inline Register multiply_add(const Register& a, const Register& b, const Register& c) {
  return _mm256_fmadd_pd(a, b, c);
}
inline double multiply_add(double a, double b, double c) { return std::fma(a, b, c); }
#else
constexpr int kWidth = 2;
using Register = double __attribute__((vector_size(16)));
template <typename V>
V multiply_add(const V& a, const V& b, const V& c) {
  return a * b + c;
}
#endif

/// a b - p for p = a b as rounded: no rounding of its own. Without a fused operation from the
/// halves of a and b (Dekker 1971), for factors below 1e300.
template <typename V>
V product_error(const V& a, const V& b, const V& p) {
#if defined(__FMA__)
  return multiply_add(a, b, -p);
#else
  constexpr double kSplitter = 0x1p27 + 1;
  const V a_scaled = a * kSplitter, b_scaled = b * kSplitter;
  const V a_upper = a_scaled - (a_scaled - a), b_upper = b_scaled - (b_scaled - b);
  const V a_lower = a - a_upper, b_lower = b - b_upper;
  return ((a_upper * b_upper - p) + a_upper * b_lower + a_lower * b_upper) + a_lower * b_lower;
#endif
}

/// sum += a b; returns the error of that. |sum| is above |a b| before and after it.
inline Register add_to_larger(Register& sum, const Register& a, const Register& b) {
  const Register before = sum;
#if defined(__FMA__)
  sum = multiply_add(a, b, before);
  return multiply_add(a, b, before - sum);
#else
  const Register p = a * b;
  sum = before + p;
  return ((before - sum) + p) + product_error(a, b, p);
#endif
}

/// The halves of kWidth numbers apart, and together again.
inline void split_pairs(const DoubleDouble* from, Register& high, Register& low) {
  Register first, second;
  std::memcpy(&first, from, sizeof first);
  std::memcpy(&second, from + kWidth / 2, sizeof second);
#if defined(__FMA__)
  high = __builtin_shufflevector(first, second, 0, 2, 4, 6);
  low = __builtin_shufflevector(first, second, 1, 3, 5, 7);
#else
  high = __builtin_shufflevector(first, second, 0, 2);
  low = __builtin_shufflevector(first, second, 1, 3);
#endif
}
inline void join_pairs(const Register& high, const Register& low, DoubleDouble* to) {
#if defined(__FMA__)
  const Register first = __builtin_shufflevector(high, low, 0, 4, 1, 5);
  const Register second = __builtin_shufflevector(high, low, 2, 6, 3, 7);
#else
  const Register first = __builtin_shufflevector(high, low, 0, 2);
  const Register second = __builtin_shufflevector(high, low, 1, 3);
#endif
  std::memcpy(static_cast<void*>(to), &first, sizeof first);
  std::memcpy(static_cast<void*>(to + kWidth / 2), &second, sizeof second);
}

/// (high, low) += (a_high + a_low) (b_high + b_low), with the rounding errors of the product and of
/// the sum (Ogita, Rump, Oishi 2005, Dot2, extended to factors of two halves): about as accurate as
/// if computed in twice the precision and rounded. In a double or in every lane of a register.
template <typename V>
void add_product(V& high, V& low, const V& a_high, const V& a_low, const V& b_high,
                 const V& b_low) {
  const V p = a_high * b_high;
  V e = product_error(a_high, b_high, p);
  e = multiply_add(a_high, b_low, e);
  e = multiply_add(a_low, b_high, e);
  const V s = high + p;
  const V t = s - high;
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
  static constexpr std::size_t kParts = kLanes / kWidth;
  std::array<Register, kParts> high{}, low{};

  /// One factor for all lanes.
  void add(const double* a_high, const double* a_low, double b_high, double b_low) {
    const Register of_high = Register{} + b_high, of_low = Register{} + b_low;
    for (std::size_t p = 0; p < kParts; ++p) {
      Register a_upper, a_lower;
      std::memcpy(&a_upper, a_high + p * kWidth, sizeof a_upper);
      std::memcpy(&a_lower, a_low + p * kWidth, sizeof a_lower);
      add_product(high[p], low[p], a_upper, a_lower, of_high, of_low);
    }
  }
  /// a_r b_r in lane r.
  void add(const DoubleDouble* a, const DoubleDouble* b) {
    for (std::size_t p = 0; p < kParts; ++p) {
      Register a_upper, a_lower, b_upper, b_lower;
      split_pairs(a + p * kWidth, a_upper, a_lower);
      split_pairs(b + p * kWidth, b_upper, b_lower);
      add_product(high[p], low[p], a_upper, a_lower, b_upper, b_lower);
    }
  }
  PairSum lane(std::size_t r) const {
    return {high[r / kWidth][r % kWidth], low[r / kWidth][r % kWidth]};
  }
  DoubleDouble operator[](std::size_t r) const { return lane(r).value(); }
  /// The sum over the lanes.
  PairSum total() const {
    PairSum sum;
    for (std::size_t r = 0; r < kLanes; ++r) {
      const PairSum part = lane(r);
      add_product(sum.high, sum.low, part.high, 0.0, 1.0, 0.0);
      sum.low += part.low;
    }
    return sum;
  }
};

/// A power of two above `value`; 0 for 0 (and for what is not normalised).
inline double power_above(double value) {
  constexpr std::uint64_t kExponent = 0x7ff0000000000000;
  return 2 * std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) & kExponent);
}

/// kWidth x count sums for matrix products, at half the operations of PairSums: `high` starts from
/// a bias of 3 u, u a bound of the sum of |a b|, and so stays in the binade [2 u, 4 u), where the
/// error of adding a b is at hand. What is lost is relative to u, the product of the bounds of row
/// and column, not to each sum: 2^-104 times a few.
template <std::size_t count>
class BiasedSums {
 public:
  /// row[r] column[q] >= sum of |a_r b_q|, all of them powers of two (or 0).
  BiasedSums(const double* row, const std::array<double, count>& column) {
    for (std::size_t q = 0; q < count; ++q)
      for (std::size_t r = 0; r < kWidth; ++r) bias_[q][r] = 3 * row[r] * column[q];
    high_ = bias_;
  }
  /// Lane r: a_r b_q, where b_q is q strides from b.
  void add(const double* a_high, const double* a_low, const DoubleDouble* b,
           std::ptrdiff_t stride) {
    Register high, low;
    std::memcpy(&high, a_high, sizeof high);
    std::memcpy(&low, a_low, sizeof low);
#pragma GCC unroll 8
    for (std::size_t q = 0; q < count; ++q, b += stride) {
      const Register b_high = Register{} + b->hi(), b_low = Register{} + b->lo();
      const Register error = multiply_add(high, b_low, add_to_larger(high_[q], high, b_high));
      low_[q] += multiply_add(low, b_high, error);
    }
  }

  /// c_r = the sum q of lane r, or c_r loses it; with an error of 2^-105 of the larger one.
  void store(std::size_t q, bool subtract, DoubleDouble* c) const {
    Register high = high_[q] - bias_[q], low = low_[q];
    if (subtract) {
      Register c_high, c_low;
      split_pairs(c, c_high, c_low);
      const Register difference = c_high - high;
      const Register moved = difference - c_high;
      low = ((c_high - (difference - moved)) - (high + moved)) + (c_low - low);
      high = difference;
    }
    const Register sum = high + low;
    const Register moved = sum - high;
    join_pairs(sum, (high - (sum - moved)) + (low - moved), c);
  }

 private:
  std::array<Register, count> bias_, high_, low_{};
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
