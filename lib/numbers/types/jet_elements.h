// Internal to numbers: functions of numbers with two derivatives, for the elements of a Jet.
#pragma once

#include <optional>

#include "expr/program/number_type.h"
#include "numbers/types/ball_functions.h"

namespace gainsmith::numbers::jets {

using Number = Ball<double>;

/// Value, first and second derivative of a function of one number over a ball. They are
/// derivatives, not the coefficients of a Taylor series.
struct Taylor {
  Number value, first, second;
};
constexpr Number kUnknown{0, kNothingKnown};

/// It does not depend on t.
inline bool is_still(const Taylor& x) { return x.first.is_zero() && x.second.is_zero(); }

/// f(x): f' x', f'' x'^2 + f' x''.
inline Taylor composed(const Taylor& f, const Taylor& x) {
  const Number square = x.first * x.first;
  return {f.value, f.first * x.first, f.second * square + f.first * x.second};
}
inline Taylor product(const Taylor& a, const Taylor& b) {
  const Number two{2, 0};
  return {a.value * b.value, a.first * b.value + a.value * b.first,
          a.second * b.value + two * a.first * b.first + a.value * b.second};
}
/// q = a/b: q' = (a' - q b')/b, q'' = (a'' - 2 q' b' - q b'')/b.
inline Taylor quotient(const Taylor& a, const Taylor& b) {
  if (b.value.is_zero()) expr::fault::division_by_zero();
  const Number two{2, 0};
  const Number value = a.value / b.value;
  const Number first = (a.first - value * b.first) / b.value;
  return {value, first, (a.second - two * first * b.first - value * b.second) / b.value};
}

inline Taylor exp_of(const Number& x) {
  const Number value = ball::exp(x);
  return {value, value, value};
}
/// log x, 1/x, -1/x^2. None where all of x lies outside.
inline std::optional<Taylor> log_of(const Number& x) {
  const auto value = ball::log(x);
  if (!value) return std::nullopt;
  const Number first = Number{1, 0} / x;
  return Taylor{*value, first, -(first * first)};
}

/// x^k, k >= 0. An even power of a number that changes its sign is a power of its size.
inline Taylor whole_power(const Number& x, int k) {
  const Number value = ball::whole_power(k % 2 == 0 ? ball::abs(x) : x, k);
  if (k == 0) return {value, {}, {}};
  const auto factor = [](int n) { return Number{static_cast<double>(n), 0}; };
  const Number first = factor(k) * ball::whole_power(x, k - 1);
  if (k == 1) return {value, first, {}};
  return {value, first, factor(k) * factor(k - 1) * ball::whole_power(x, k - 2)};
}

/// a^b: by the chain rule where the exponent does not move, as e^(b log a) where it moves.
inline Taylor real_power(const Taylor& a, const Taylor& b, bool exponent_moves) {
  const auto known = ball::real_power(a.value, b.value);
  if (!known) expr::fault::not_finite(expr::Op::real_power);
  if (exponent_moves) {
    const Taylor log = log_of(a.value).value_or(Taylor{kUnknown, kUnknown, kUnknown});
    const Taylor exponent = product(b, composed(log, a));
    const Taylor power = composed(exp_of(exponent.value), exponent);
    return {*known, power.first, power.second};
  }
  const auto or_unknown = [&](const Number& exponent) {
    return ball::real_power(a.value, exponent).value_or(kUnknown);
  };
  const Number one{1, 0}, two{2, 0}, y = b.value;
  return composed({*known, y * or_unknown(y - one), y * (y - one) * or_unknown(y - two)}, a);
}

/// Level between whole numbers; nothing is known of the derivatives where x may meet one.
inline Taylor floor_of(const Number& x) {
  const Number value = ball::floor(x);
  if (value.is_exact()) return {value, {}, {}};
  return {value, kUnknown, kUnknown};
}

/// a - b k: the slope is known where k is.
inline Taylor rest_of(const Taylor& a, const Taylor& b) {
  if (b.value.is_zero()) expr::fault::division_by_zero();
  const Number value = ball::mod(a.value, b.value);
  const Number count = ball::floor((a.value - value) / b.value + Number{0.5, 0});
  if (!count.is_exact()) return {value, kUnknown, kUnknown};
  return {value, a.first - count * b.first, a.second - count * b.second};
}

/// a' = (x y' - y x')/s with s = x^2 + y^2; a'' = (x y'' - y x'' - a' s')/s.
inline Taylor angle_of(const Taylor& y, const Taylor& x) {
  const Number value = ball::atan2(y.value, x.value);
  if (!(value.rad < 1)) return {value, kUnknown, kUnknown};
  const Number s =
      ball::whole_power(ball::abs(x.value), 2) + ball::whole_power(ball::abs(y.value), 2);
  const Number half = x.value * x.first + y.value * y.first;
  const Number first = (x.value * y.first - y.value * x.first) / s;
  const Number turned = x.value * y.second - y.value * x.second;
  return {value, first, (turned - Number{2, 0} * first * half) / s};
}

}  // namespace gainsmith::numbers::jets
