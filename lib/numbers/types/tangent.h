// Internal to numbers: a number with its slope in one direction, for algorithms that are written
// element by element (householder.h): (a + a' e)(b + b' e) = a b + (a' b + a b') e with e^2 = 0.
#pragma once

#include <cmath>
#include <optional>

namespace gainsmith::numbers {

template <class S>
struct Tangent {
  S value{0};
  S slope{0};

  friend Tangent operator+(const Tangent& a, const Tangent& b) {
    return {S(a.value + b.value), S(a.slope + b.slope)};
  }
  friend Tangent operator-(const Tangent& a, const Tangent& b) {
    return {S(a.value - b.value), S(a.slope - b.slope)};
  }
  friend Tangent operator*(const Tangent& a, const Tangent& b) {
    return {S(a.value * b.value), S(a.slope * b.value + a.value * b.slope)};
  }
  friend Tangent operator/(const Tangent& a, const Tangent& b) {
    const S quotient = a.value / b.value;
    return {quotient, S((a.slope - quotient * b.slope) / b.value)};
  }
};

/// What complement() asks of them: sqrt(x)' = x'/(2 sqrt(x)), not a number for x = 0.
template <class S>
struct TangentNumbers {
  static Tangent<S> root(const Tangent<S>& x) {
    using std::sqrt;
    const S root = sqrt(x.value);
    return {root, S(x.slope / (S(2) * root))};
  }
  static bool is_zero(const Tangent<S>& x) { return x.value == S(0) && x.slope == S(0); }
  static std::optional<bool> is_negative(const Tangent<S>& x) { return x.value < S(0); }
};

}  // namespace gainsmith::numbers
