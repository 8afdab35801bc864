// Internal to numbers: functions of one scalar that <cmath> does not have as the language means
// them, or not for every scalar.
#pragma once

#include <cmath>
#include <limits>
#include <type_traits>

#include "base/scalars.h"

namespace gainsmith::numbers {

/// a - b floor(a / b), b != 0: in [0, b) for b > 0, in (b, 0] for b < 0, also after rounding.
template <class S>
S mod(const S& a, const S& b) {
  using std::abs;
  using std::floor;
  S rest(0);
  if constexpr (std::is_same_v<S, double>) {
    rest = std::fmod(a, b);
  } else {
    rest = a - b * floor(S(a / b));
    // The quotient is rounded before its floor is taken.
    if (abs(rest) >= abs(b)) rest = rest - b;
  }
  if (rest != S(0) && (rest < S(0)) != (b < S(0))) rest = rest + b;
  if (rest == S(0)) return S(0);
  if (abs(rest) < abs(b)) return rest;
  if constexpr (std::is_same_v<S, double>) return std::nextafter(b, 0.0);
  return S(b - b * std::numeric_limits<S>::epsilon());
}

/// In (-pi, pi], 0 at the origin; the sign of a zero does not count.
template <class S>
S angle(const S& y, const S& x) {
  using std::atan2;
  if (y == S(0)) return x < S(0) ? pi<S>() : S(0);
  return atan2(y, x);
}

}  // namespace gainsmith::numbers
