// Numbers of twice the precision of double: an unevaluated sum of two doubles, 31 digits.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include "base/isa.h"

namespace gainsmith {

/// hi + lo with |lo| <= ulp(hi)/2. Arithmetic after Dekker (1971), Knuth and Hida, Li, Bailey
/// (2001); relative errors (Joldes, Muller, Popescu 2017): + and - 3 u^2, * 5 u^2, / 10 u^2, u =
/// 2^-53. They hold as long as the low half and the error of a product are above the least double:
/// for results from 1e-290 to 1e300. A result that is not finite may be NaN where double has an
/// infinity.
class DoubleDouble {
 public:
  constexpr DoubleDouble() = default;
  constexpr DoubleDouble(double value) : hi_(value) {}
  constexpr DoubleDouble(int value) : hi_(value) {}
  /// Of a size or an index, below 2^53: Eigen counts by them.
  constexpr DoubleDouble(std::ptrdiff_t value) : hi_(static_cast<double>(value)) {}
  constexpr DoubleDouble(double hi, double lo) : hi_(hi), lo_(lo) {}

  constexpr double hi() const { return hi_; }
  constexpr double lo() const { return lo_; }
  explicit constexpr operator double() const { return hi_; }
  explicit constexpr operator int() const { return static_cast<int>(hi_); }

  constexpr DoubleDouble operator-() const { return {-hi_, -lo_}; }

  /// (a.hi + b.hi) and (a.lo + b.lo) are each taken without error, then summed by size.
  friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble s = two_sum(a.hi_, b.hi_);
    const DoubleDouble t = two_sum(a.lo_, b.lo_);
    const DoubleDouble v = fast_two_sum(s.hi_, s.lo_ + t.hi_);
    return fast_two_sum(v.hi_, v.lo_ + t.lo_);
  }
  friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + (-b); }
  friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
    const DoubleDouble p = two_product(a.hi_, b.hi_);
    return fast_two_sum(p.hi_, p.lo_ + fused_multiply_add(a.hi_, b.lo_, a.lo_ * b.hi_));
  }
  friend DoubleDouble operator*(const DoubleDouble& a, double b) {
    const DoubleDouble p = two_product(a.hi_, b);
    return fast_two_sum(p.hi_, fused_multiply_add(a.lo_, b, p.lo_));
  }
  friend DoubleDouble operator*(double a, const DoubleDouble& b) { return b * a; }
  /// Long division: three quotients of doubles, each of what the ones before leave.
  friend DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
    const double q = a.hi_ / b.hi_;
    const DoubleDouble r = a - b * q;
    const double q2 = r.hi_ / b.hi_;
    const DoubleDouble r2 = r - b * q2;
    return fast_two_sum(q, q2) + DoubleDouble(r2.hi_ / b.hi_);
  }
  DoubleDouble& operator+=(const DoubleDouble& b) { return *this = *this + b; }
  DoubleDouble& operator-=(const DoubleDouble& b) { return *this = *this - b; }
  DoubleDouble& operator*=(const DoubleDouble& b) { return *this = *this * b; }
  DoubleDouble& operator/=(const DoubleDouble& b) { return *this = *this / b; }

  friend bool operator==(const DoubleDouble& a, const DoubleDouble& b) {
    return a.hi_ == b.hi_ && a.lo_ == b.lo_;
  }
  friend bool operator<(const DoubleDouble& a, const DoubleDouble& b) {
    return a.hi_ < b.hi_ || (a.hi_ == b.hi_ && a.lo_ < b.lo_);
  }
  friend bool operator>(const DoubleDouble& a, const DoubleDouble& b) { return b < a; }
  friend bool operator<=(const DoubleDouble& a, const DoubleDouble& b) { return a < b || a == b; }
  friend bool operator>=(const DoubleDouble& a, const DoubleDouble& b) { return b <= a; }
  friend bool operator!=(const DoubleDouble& a, const DoubleDouble& b) { return !(a == b); }

  /// One step of Newton's from r = sqrt(a.hi): r + (a - r^2) / (2 r). NaN below 0.
  friend DoubleDouble sqrt(const DoubleDouble& a) {
    if (!(a.hi_ > 0)) return {std::sqrt(a.hi_)};
    const double root = std::sqrt(a.hi_);
    const DoubleDouble rest = a - two_product(root, root);
    return fast_two_sum(root, rest.hi_ / (2 * root));
  }
  friend DoubleDouble floor(const DoubleDouble& a) {
    const double high = std::floor(a.hi_);
    return high == a.hi_ && a.lo_ != 0 ? fast_two_sum(high, std::floor(a.lo_)) : DoubleDouble(high);
  }
  friend DoubleDouble abs(const DoubleDouble& a) { return a.hi_ < 0 ? -a : a; }
  friend bool isfinite(const DoubleDouble& a) { return std::isfinite(a.hi_); }
  friend bool isinf(const DoubleDouble& a) { return std::isinf(a.hi_); }
  friend bool isnan(const DoubleDouble& a) { return std::isnan(a.hi_); }

  /// By MPFR, from an argument of 50 digits, rounded to two halves: relative errors of 2 u^2.
  /// Special values as in <cmath>.
  friend DoubleDouble exp(const DoubleDouble& a);
  friend DoubleDouble log(const DoubleDouble& a);
  friend DoubleDouble sin(const DoubleDouble& a);
  friend DoubleDouble cos(const DoubleDouble& a);
  friend DoubleDouble tanh(const DoubleDouble& a);
  friend DoubleDouble pow(const DoubleDouble& a, const DoubleDouble& b);
  friend DoubleDouble atan2(const DoubleDouble& y, const DoubleDouble& x);

 private:
  /// a + b = s + e exactly, for any sizes (Knuth).
  static DoubleDouble two_sum(double a, double b) {
    const double s = a + b;
    const double t = s - a;
    return {s, (a - (s - t)) + (b - t)};
  }
  /// The same for |a| >= |b| (Dekker 1971).
  static DoubleDouble fast_two_sum(double a, double b) {
    const double s = a + b;
    return {s, b - (s - a)};
  }
  /// a b = p + e exactly: e = fma(a, b, -p).
  static DoubleDouble two_product(double a, double b) {
    const double p = a * b;
    return {p, fused_multiply_add(a, b, -p)};
  }

  double hi_ = 0;
  double lo_ = 0;
};

}  // namespace gainsmith

template <>
class std::numeric_limits<gainsmith::DoubleDouble> : public std::numeric_limits<double> {
 public:
  using DoubleDouble = gainsmith::DoubleDouble;
  static constexpr int digits = 104;
  static constexpr int digits10 = 31;
  static constexpr int max_digits10 = 34;
  static constexpr DoubleDouble epsilon() { return {4.93038065763132e-32}; }  // 2^-104
  static constexpr DoubleDouble min() { return {2.0041683600089728e-292}; }   // 2^(-1022+53)
  static constexpr DoubleDouble max() { return {std::numeric_limits<double>::max()}; }
  static constexpr DoubleDouble lowest() { return {std::numeric_limits<double>::lowest()}; }
  static constexpr DoubleDouble infinity() { return {std::numeric_limits<double>::infinity()}; }
  static constexpr DoubleDouble quiet_NaN() { return {std::numeric_limits<double>::quiet_NaN()}; }
};
