// A number with a bound of its error: |true - mid| <= rad. Radii are doubles, rounded upward; an
// infinite one says that nothing is known. The errors of the operations are bounded as they are
// made (running error analysis: Higham, Accuracy and Stability of Numerical Algorithms, ch. 3).
//
// Of balls (m, r) and (n, s), with u the unit roundoff of the scalar:
//   sum        (m + n,  r + s + u |m + n|)
//   product    (m n,    |m| s + r |n| + r s + u |m n|)
//   quotient   (q,      (r + |q| s)/(|n| - s) + u |q|),  q = m/n, where |n| > s
// plus a few times the least double, where something may have underflowed. Sums and products of
// exact doubles that do not round keep radius 0, as those of whole numbers below 2^53 do.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "base/scalars.h"

namespace gainsmith::numbers {

/// The radius of a ball of which nothing is known.
constexpr double kNothingKnown = std::numeric_limits<double>::infinity();

/// |computed - exact| <= unit_roundoff * |computed| for each operation, root and function of
/// <cmath> of the scalar, with room to spare beyond double.
template <class S>
constexpr double unit_roundoff() {
  if constexpr (std::is_same_v<S, double>) return 0x1p-53;
  return std::is_same_v<S, DoubleDouble> ? 0x1p-100 : 1e-148;
}

/// The relative error of functions: of double 5 u, as functions of libm are within 2 units of the
/// last place; those of MPFR and of 31 digits are within unit_roundoff().
template <class S>
constexpr double function_roundoff() {
  return std::is_same_v<S, double> ? 5 * 0x1p-53 : unit_roundoff<S>();
}

/// Below this a rounding error is no longer relative to the result; kTiny bounds it then, a few
/// times.
constexpr double kLeastNormal = 1e-290;
constexpr double kTiny = 16 * std::numeric_limits<double>::denorm_min();

/// Not below the exact value of `radius`, a sum or product of numbers >= 0 with at most
/// `operations` roundings: each is off by 2^-53 of it.
inline double up(double radius, double operations = 6) {
  return radius * (1 + (operations + 2) * 0x1p-52);
}

/// NaN is nothing known.
inline double bound_or_nothing(double radius) {
  // NOLINTNEXTLINE(bugprone-narrowing-conversions)
  return radius >= 0 ? radius : kNothingKnown;
}

/// Not below |x|.
template <class S>
double magnitude(const S& x) {
  if constexpr (std::is_same_v<S, double>) return std::abs(x);
  const double rounded = std::abs(static_cast<double>(x));
  if (rounded >= kLeastNormal) return up(rounded);
  return x == S(0) ? 0 : rounded + kTiny;
}

/// Not above x.
template <class S>
double below(const S& x) {
  const auto rounded = static_cast<double>(x);
  if constexpr (std::is_same_v<S, double>) return rounded;
  return rounded - (x == S(rounded) ? 0 : up(std::abs(rounded) * 0x1p-52) + kTiny);
}

/// 2^exponent x, exact where it does not underflow.
inline double times_power_of_two(double x, int exponent) {
  constexpr int kLeast = -1022, kMost = 1023;
  if (exponent < kLeast || exponent > kMost) return std::ldexp(x, exponent);
  return x * std::bit_cast<double>(static_cast<std::uint64_t>(exponent + kMost) << 52);
}
inline DoubleDouble times_power_of_two(const DoubleDouble& x, int exponent) {
  return {times_power_of_two(x.hi(), exponent), times_power_of_two(x.lo(), exponent)};
}
inline Decimal100 times_power_of_two(const Decimal100& x, int exponent) {
  return ldexp(x, exponent);
}

/// All numbers within rad of mid. rad >= 0 and is no NaN; mid is of use where rad is finite.
template <class S>
struct Ball {
  S mid{0};
  double rad = 0;

  bool is_exact() const { return rad == 0; }
  bool is_zero() const { return rad == 0 && mid == S(0); }
};

/// x times a power of two.
template <class S>
Ball<S> scaled(const Ball<S>& x, double power) {
  return {x.mid * S(power), x.rad * power};
}

/// Ends of a ball, rounded outward.
template <class S>
double low_end(const Ball<S>& x) {
  const double end = below(x.mid) - x.rad;
  return x.rad == 0 ? end : end - up(std::abs(end) * 0x1p-52 + kTiny);
}
template <class S>
double high_end(const Ball<S>& x) {
  return -low_end(Ball<S>{-x.mid, x.rad});
}

/// A ball that holds [low, high]; nothing is known where an end is not finite.
template <class S>
Ball<S> hull(double low, double high) {
  if (!(std::isfinite(low) && std::isfinite(high))) return {S(0), kNothingKnown};
  const double mid = low / 2 + high / 2;
  const double rad = std::max(high - mid, mid - low);
  // Halves of a number stay exact, so that what is known to be >= 0 stays so.
  return {S(mid), low == 0 && mid * 2 == high ? mid : up(rad) + kTiny};
}

/// Certainly x >= y, x > 0, x >= 0; false where that is not certain.
template <class S>
bool is_at_least(const Ball<S>& x, const Ball<S>& y) {
  if (x.is_exact() && y.is_exact()) return x.mid >= y.mid;
  return below(S(x.mid - y.mid)) * (1 - 0x1p-50) - kTiny >= up(x.rad + y.rad);
}
template <class S>
bool is_positive(const Ball<S>& x) {
  return x.is_exact() ? x.mid > S(0) : below(x.mid) > x.rad;
}
template <class S>
bool is_not_negative(const Ball<S>& x) {
  return below(x.mid) >= x.rad;
}

template <class S>
Ball<S> operator-(const Ball<S>& x) {
  return {-x.mid, x.rad};
}

/// The size of the error of a sum or product in double, exact unless something underflows or
/// overflows: TwoSum (Knuth, The Art of Computer Programming 2, 4.2.2), and a fused multiply-add.
inline double error_of_sum(double x, double y, double sum) {
  const double part = sum - x;
  return std::abs((x - (sum - part)) + (y - part));
}
inline double error_of_product(double x, double y, double product) {
  return std::abs(fused_multiply_add(x, y, -product));
}

/// The error of a sum or product in S: that of double where S holds no more, so that whole numbers
/// stay exact.
template <class S, class Error>
double rounding_error(const S& x, const S& y, const S& result, const Error& error) {
  if constexpr (std::is_same_v<S, double>) {
    return error(x, y, result);
  } else {
    const auto a = static_cast<double>(x), b = static_cast<double>(y),
               c = static_cast<double>(result);
    if (S(a) == x && S(b) == y && S(c) == result && error(a, b, c) == 0) return 0;
    return unit_roundoff<S>() * magnitude(result);
  }
}

template <class S>
Ball<S> operator+(const Ball<S>& x, const Ball<S>& y) {
  const S sum = x.mid + y.mid;
  const double error =
      x.mid == S(0) || y.mid == S(0) ? 0 : rounding_error(x.mid, y.mid, sum, error_of_sum);
  return {sum, bound_or_nothing(up(x.rad + y.rad + error))};
}
template <class S>
Ball<S> operator-(const Ball<S>& x, const Ball<S>& y) {
  return x + (-y);
}

/// A product of two balls that are wide, from their ends: it keeps what is known of its sign.
template <class S>
Ball<S> wide_product(const Ball<S>& x, const Ball<S>& y) {
  const double a = low_end(x), b = high_end(x), c = low_end(y), d = high_end(y);
  if (!(std::isfinite(a) && std::isfinite(b) && std::isfinite(c) && std::isfinite(d)))
    return {S(0), kNothingKnown};
  const auto [low, high] = std::minmax({a * c, a * d, b * c, b * d});
  if (!std::isfinite(low) || !std::isfinite(high)) return {S(0), kNothingKnown};
  const double below_low = low - up(std::abs(low) * 0x1p-52 + kTiny);
  const double above_high = high + up(std::abs(high) * 0x1p-52 + kTiny);
  const bool same =
      (is_not_negative(x) && is_not_negative(y)) || (is_not_negative(-x) && is_not_negative(-y));
  const bool opposite =
      (is_not_negative(x) && is_not_negative(-y)) || (is_not_negative(-x) && is_not_negative(y));
  if (opposite) return -hull<S>(std::max(0.0, -above_high), -below_low);
  return hull<S>(same ? std::max(0.0, below_low) : below_low, above_high);
}

/// Relative radius of both factors from which a product is taken from the ends: the formula above
/// would lose what is known of its sign.
constexpr double kWide = 0.01;

template <class S>
Ball<S> operator*(const Ball<S>& x, const Ball<S>& y) {
  if (x.is_zero() || y.is_zero()) return {};
  if (x.rad > kWide * magnitude(x.mid) && y.rad > kWide * magnitude(y.mid))
    return wide_product(x, y);
  const S product = x.mid * y.mid;
  const double size = magnitude(product);
  const double error = rounding_error(x.mid, y.mid, product, error_of_product);
  double rad = up(magnitude(x.mid) * y.rad + x.rad * magnitude(y.mid) + x.rad * y.rad + error);
  if (size < kLeastNormal || (rad != 0 && rad < kLeastNormal)) rad += kTiny;
  if (x.rad != 0 || y.rad != 0) rad += kTiny;
  return {product, bound_or_nothing(rad)};
}

/// Nothing is known of the quotient by a ball that holds 0.
template <class S>
Ball<S> operator/(const Ball<S>& x, const Ball<S>& y) {
  const double least = low_end(Ball<S>{y.mid < S(0) ? S(-y.mid) : y.mid, y.rad});
  if (!(least > 0)) return {S(0), kNothingKnown};
  if (x.is_zero()) return {};
  const S quotient = x.mid / y.mid;
  const double size = magnitude(quotient);
  const bool exact = y.is_exact() && (y.mid == S(1) || y.mid == S(-1));
  const double error = exact ? 0 : unit_roundoff<S>() * size;
  double rad = up((x.rad + size * y.rad) / least + error);
  // In 31 digits the remainder of the division may underflow before it is divided.
  if (!exact || x.rad != 0) rad += kTiny + up(kTiny / least);
  return {quotient, bound_or_nothing(rad)};
}

}  // namespace gainsmith::numbers
