// Functions of a ball (ball.h): the value at its middle, and how far the function moves over it.
//
//   exp            e^m (e^r - 1)                      log    -log(1 - r/m)
//   sin cos tanh   min(r, 2), as |f'| <= 1            sqrt   r / (sqrt(m) + sqrt(m - r))
//   x^y            e^d - 1 times the value, d = s |log m| - (|n| + s) log(1 - r/m)
//
// for the ball (m, r), and (n, s) of y. Wide balls are taken from their ends where f is monotone.
#pragma once

#include <algorithm>
#include <functional>
#include <iterator>
#include <optional>

#include "numbers/types/ball.h"
#include "numbers/types/scalar_functions.h"
#include "numbers/types/shared_rules.h"

namespace gainsmith::numbers {

namespace ball {

/// The value at the middle, whose own error is that of the function, moving by at most `moved`.
template <class S>
Ball<S> moved_by(const S& value, double moved) {
  return {value,
          bound_or_nothing(up(moved + function_roundoff<S>() * magnitude(value), 16) + kTiny)};
}

/// Above this radius of the exponent exp and powers are taken from the ends.
constexpr double kWideLogarithm = 0.1;

template <class S>
Ball<S> exp(const Ball<S>& x) {
  using std::exp;
  if (x.is_zero()) return {S(1), 0};
  if (x.rad > kWideLogarithm) {
    const double low = std::exp(low_end(x)) * (1 - 0x1p-48) - kTiny;
    if (std::isinf(low)) return {S(exp(x.mid)), kNothingKnown};
    return hull<S>(std::max(0.0, low), up(std::exp(high_end(x)), 16) + kTiny);
  }
  const S value = exp(x.mid);
  return moved_by(value, x.rad == 0 ? 0 : up(magnitude(value) * std::expm1(x.rad), 16));
}

/// None when all of the ball lies outside, where x <= 0.
template <class S>
std::optional<Ball<S>> log(const Ball<S>& x) {
  using std::log;
  if (high_end(x) <= 0 || (x.is_exact() && !(x.mid > S(0)))) return std::nullopt;
  if (!is_positive(x)) return Ball<S>{S(0), kNothingKnown};
  if (x.is_exact() && x.mid == S(1)) return Ball<S>{};
  const double ratio = up(x.rad / below(x.mid));
  return moved_by(S(log(x.mid)), ratio < 1 ? -std::log1p(-ratio) : kNothingKnown);
}

/// None when all of the ball lies outside, where x < 0; where a part does, the root of the rest.
template <class S>
std::optional<Ball<S>> sqrt(const Ball<S>& x) {
  using std::sqrt;
  if (high_end(x) < 0 || (x.is_exact() && x.mid < S(0))) return std::nullopt;
  if (x.is_zero() || (x.is_exact() && x.mid == S(1))) return x;
  if (!is_positive(x)) return hull<S>(0, up(std::sqrt(high_end(x))));
  const S value = sqrt(x.mid);
  // sqrt(m) - sqrt(m - r) = r / (sqrt(m) + sqrt(m - r)).
  const double sum = std::sqrt(below(x.mid)) + std::sqrt(std::max(0.0, low_end(x)));
  // In 31 digits the square of the root may underflow in its last half.
  return moved_by(value, up(x.rad / sum + kTiny / sum, 16));
}

template <class S>
Ball<S> sin(const Ball<S>& x) {
  using std::sin;
  return x.is_zero() ? x : moved_by(S(sin(x.mid)), std::min(x.rad, 2.0));
}
template <class S>
Ball<S> cos(const Ball<S>& x) {
  using std::cos;
  return x.is_zero() ? Ball<S>{S(1), 0} : moved_by(S(cos(x.mid)), std::min(x.rad, 2.0));
}
template <class S>
Ball<S> tanh(const Ball<S>& x) {
  using std::tanh;
  return x.is_zero() ? x : moved_by(S(tanh(x.mid)), std::min(x.rad, 2.0));
}

template <class S>
Ball<S> abs(const Ball<S>& x) {
  if (is_not_negative(x)) return x;
  if (is_not_negative(-x)) return -x;
  return hull<S>(0, std::max(high_end(x), -low_end(x)));
}

template <class S>
Ball<S> sign(const Ball<S>& x) {
  if (is_positive(x)) return {S(1), 0};
  if (is_positive(-x)) return {S(-1), 0};
  return {S(0), x.is_zero() ? 0.0 : 1.0};
}

/// Where the order is not certain: |max(x, y) - max(m, n)| <= max(r, s).
template <class S>
Ball<S> maximum(const Ball<S>& x, const Ball<S>& y) {
  if (is_at_least(x, y)) return x;
  if (is_at_least(y, x)) return y;
  return {x.mid < y.mid ? y.mid : x.mid, std::max(x.rad, y.rad)};
}
template <class S>
Ball<S> minimum(const Ball<S>& x, const Ball<S>& y) {
  return -maximum(-x, -y);
}

/// Both whole numbers, and what lies between, where it is not certain on which side of a step x is.
template <class S>
Ball<S> floor(const Ball<S>& x) {
  using std::floor;
  if (x.is_exact()) return {S(floor(x.mid)), 0};
  const double low = std::floor(low_end(x)), high = std::floor(high_end(x));
  return low == high ? Ball<S>{S(low), 0} : hull<S>(low, high);
}

/// a - b floor(a / b): where it is not certain which floor it is, all that a rest can be. b is not
/// 0.
template <class S>
Ball<S> mod(const Ball<S>& a, const Ball<S>& b) {
  using std::floor;
  if (is_positive(-b)) return -mod(-a, -b);
  if (!is_positive(b)) return {S(0), kNothingKnown};
  const S count = floor(S(a.mid / b.mid));
  for (const S& shift : {S(0), S(-1), S(1)}) {
    const Ball<S> rest = a - b * Ball<S>{S(count + shift), 0};
    if (is_not_negative(rest) && is_positive(b - rest)) return rest;
  }
  return hull<S>(0, high_end(b));
}

/// The angle of (x, y): the point in the middle is r away from the origin, the others at most rad
/// from it, under an angle of at most asin(rad / r) to it.
template <class S>
Ball<S> atan2(const Ball<S>& y, const Ball<S>& x) {
  constexpr double kPi = 3.15;  // above it
  if (x.is_zero() && y.is_zero()) return {};
  const bool above = is_not_negative(y), right = is_not_negative(x);
  const bool may_jump = !above && !is_positive(-y) && !right;
  const auto least = [](const S& value) {
    return std::max(0.0, below(value < S(0) ? S(-value) : value));
  };
  const double rad = up(std::hypot(x.rad, y.rad));
  const double distance = std::hypot(least(x.mid), least(y.mid)) * (1 - 0x1p-48);
  if (!may_jump && rad < distance) {
    // asin t <= t (1 + t^2/5) for t <= 1/2, <= pi/2 t for t <= 1.
    const double t = up(rad / distance);
    return moved_by(angle(y.mid, x.mid), up(t * (t < 0.5 ? 1 + 0.2 * t * t : kPi / 2), 16));
  }
  if (above) return hull<S>(0, kPi);
  return right ? hull<S>(-kPi / 2, kPi / 2) : hull<S>(-kPi, kPi);
}

/// A ball that holds both balls: the mean of m and n, radius at least |m - n|/2 + max(r, s).
template <class S>
Ball<S> either(const Ball<S>& x, const Ball<S>& y) {
  const Ball<S> sum = x + y;
  const Ball<S> apart = x - y;
  return {S(sum.mid / S(2)),
          bound_or_nothing(up((magnitude(apart.mid) + sum.rad) / 2 + std::max(x.rad, y.rad) +
                              unit_roundoff<S>() * magnitude(sum.mid)) +
                           (x.mid == y.mid && x.is_exact() && y.is_exact() ? 0 : kTiny))};
}

/// Whether d > 0 (strict) or d >= 0 holds; none when it is not certain.
template <class S>
std::optional<bool> holds(const Ball<S>& d, bool strict) {
  if (d.is_exact()) return strict ? d.mid > S(0) : d.mid >= S(0);
  if (is_positive(d) || (!strict && is_not_negative(d))) return true;
  if (is_positive(-d) || (strict && is_not_negative(-d))) return false;
  return std::nullopt;
}

/// x^n by products.
template <class S>
Ball<S> whole_power(const Ball<S>& x, int n) {
  return numbers::whole_power(Ball<S>{S(1), 0}, x, n, std::multiplies<>());
}

/// x^y. None when it is certainly no number.
template <class S>
std::optional<Ball<S>> real_power(const Ball<S>& x, const Ball<S>& y) {
  using std::pow;
  // Whole exponents up to this size are products.
  constexpr double kMostProducts = 64;
  const auto exponent = static_cast<double>(y.mid);
  const bool whole = y.is_exact() && exponent == std::floor(exponent) && y.mid == S(exponent);
  if (whole && std::abs(exponent) <= kMostProducts) {
    const Ball<S> product = whole_power(x, static_cast<int>(std::abs(exponent)));
    if (exponent >= 0) return product;
    if (x.is_zero()) return std::nullopt;
    return Ball<S>{S(1), 0} / product;
  }
  if (is_positive(x)) {
    using std::log;
    // x^y = m^n e^d, |d| <= |y - n| |log m| + |y| |log x - log m|.
    const double ratio = up(x.rad / below(x.mid));
    if (!(ratio < 1)) return Ball<S>{S(0), kNothingKnown};
    const double d = up(y.rad * magnitude(S(log(x.mid))) * (1 + 1e-12) -
                            (magnitude(y.mid) + y.rad) * std::log1p(-ratio),
                        16) +
                     kTiny;
    if (d > kWideLogarithm) {
      const double corners[] = {std::pow(low_end(x), low_end(y)), std::pow(low_end(x), high_end(y)),
                                std::pow(high_end(x), low_end(y)),
                                std::pow(high_end(x), high_end(y))};
      const auto [least, most] = std::minmax_element(std::begin(corners), std::end(corners));
      return hull<S>(std::max(0.0, *least * (1 - 0x1p-48) - kTiny), up(*most, 16) + kTiny);
    }
    const S value = pow(x.mid, y.mid);
    return moved_by(value, d <= 2 * kTiny ? kTiny : up(magnitude(value) * std::expm1(d), 16));
  }
  if (x.is_exact() && y.is_exact()) {
    const S value = pow(x.mid, y.mid);
    using std::isfinite;
    if (!isfinite(value)) return std::nullopt;
    return moved_by(value, 0);
  }
  const double most = high_end(x);
  if (most < 0 && y.is_exact() && !whole) return std::nullopt;
  if (whole || !is_positive(y) || !(most >= 0)) return Ball<S>{S(0), kNothingKnown};
  const double largest = std::max(std::pow(most, low_end(y)), std::pow(most, high_end(y)));
  return hull<S>(0, up(largest, 16) + kTiny);
}

}  // namespace ball

}  // namespace gainsmith::numbers
