// Fractions: reading, rounding to doubles, and short ones near a number (continued fractions).
#include "base/rational.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "base/number.h"

namespace gainsmith {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// floor(p / q), also below 0, where the quotient of GMP is rounded towards 0.
Integer floor_of(const Rational& x) {
  const Integer p = numerator(x);
  const Integer q = denominator(x);
  Integer whole = p / q;
  if (whole * q > p) whole -= 1;
  return whole;
}

}  // namespace

Rational power_of_ten(int exponent) {
  const Integer power = pow(Integer(10), static_cast<unsigned>(std::abs(exponent)));
  return exponent < 0 ? Rational(Integer(1), power) : Rational(power);
}

std::string exact_text(const Rational& x) {
  constexpr int kMost = 100;
  int decimals = 0;
  Integer below = denominator(x);
  for (; below != 1 && decimals <= kMost; ++decimals) {
    const Integer step = gcd(below, Integer(10));
    if (step == 1) return x.str();
    below /= step;
  }
  if (decimals > kMost) return x.str();
  std::string digits = Integer(numerator(Rational(abs(x) * power_of_ten(decimals)))).str();
  if (decimals > 0) {
    const auto places = static_cast<std::size_t>(decimals);
    if (digits.size() <= places) digits.insert(0, places + 1 - digits.size(), '0');
    digits.insert(digits.size() - places, ".");
  }
  return (x < 0 ? "-" : "") + digits;
}

std::optional<Rational> parse_rational(std::string_view text) {
  if (!parse_decimal(text)) return std::nullopt;
  std::string digits;
  int exponent = 0;
  bool behind_point = false;
  bool negative = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == 'e' || c == 'E') {
      if (digits.find_first_not_of('0') == digits.npos) break;
      int stated = 0;
      const char* first = text.data() + i + (text[i + 1] == '+' ? 2 : 1);
      std::from_chars(first, text.data() + text.size(), stated);
      exponent += stated;
      break;
    }
    if (c == '-') negative = true;
    if (c == '.') behind_point = true;
    if (c == '.' || c == '+' || c == '-') continue;
    digits += c;
    if (behind_point) --exponent;
  }
  // A zero in front would make it octal.
  digits.erase(0, digits.find_first_not_of('0'));
  if (digits.empty()) return Rational(0);
  const Rational size = Rational(Integer(digits)) * power_of_ten(exponent);
  return negative ? Rational(-size) : size;
}

Integer nearest_integer(const Rational& x) { return floor_of(Rational(x + Rational(1, 2))); }

double nearest_double(const Rational& x) {
  const auto* fraction = x.backend().data();
  const auto is_exact = [](const auto* whole) { return mpz_sizeinbase(whole, 2) <= 53; };
  // A quotient of two doubles is rounded once.
  if (is_exact(mpq_numref(fraction)) && is_exact(mpq_denref(fraction)))
    return mpz_get_d(mpq_numref(fraction)) / mpz_get_d(mpq_denref(fraction));
  // What is below every double becomes 0.
  const double towards_zero = x.convert_to<double>();
  const double other = std::nextafter(towards_zero, x < 0 ? -kInfinity : kInfinity);
  if (!std::isfinite(towards_zero) || !std::isfinite(other)) return towards_zero;
  return abs(Rational(2 * x)) > abs(Rational(Rational(towards_zero) + Rational(other)))
             ? other
             : towards_zero;
}

DoubleDouble nearest_double_double(const Rational& x) {
  const double high = nearest_double(x);
  if (!std::isfinite(high)) return {high, 0};
  return {high, nearest_double(Rational(x - Rational(high)))};
}

namespace {

/// A fraction with the size by which short ones are chosen.
struct Fraction {
  Rational value;
  Rational length;  ///< |p q|
};

/// The first convergent p_k / q_k of the continued fraction of x that is within `allowed` of it:
///   x_0 = x,   a_k = floor(x_k),   x_{k+1} = 1 / (x_k - a_k)
///   p_k = a_k p_{k-1} + p_{k-2},   q_k = a_k q_{k-1} + q_{k-2}
/// Convergents are the best approximations of their denominators. A rational x ends with itself.
Fraction first_end_within(const Rational& x, const Rational& allowed) {
  Integer p0 = 0, q0 = 1, p1 = 1, q1 = 0;
  Rational rest = x;
  for (;;) {
    const Integer whole = floor_of(rest);
    const Integer p2 = whole * p1 + p0;
    const Integer q2 = whole * q1 + q0;
    const Rational found(p2, q2);
    if (abs(Rational(found - x)) <= allowed) return {found, Rational(abs(p2) * q2)};
    p0 = p1, q0 = q1, p1 = p2, q1 = q2;
    rest = 1 / Rational(rest - Rational(whole));
  }
}

}  // namespace

std::optional<Rational> short_fraction(const Rational& x, double relative, double longest) {
  if (x == 0) return x;
  const Rational within(relative);
  const double size = std::abs(nearest_double(x));
  Fraction best = first_end_within(x, Rational(abs(x) * within));
  if (size > 0 && std::isfinite(size)) {
    const Rational unit = power_of_ten(static_cast<int>(std::floor(std::log10(size))));
    const Rational scaled = x / unit;
    Fraction other = first_end_within(scaled, Rational(abs(scaled) * within));
    if (other.length < best.length) best = {Rational(other.value * unit), other.length};
  }
  if (best.length > Rational(longest)) return std::nullopt;
  return best.value;
}

}  // namespace gainsmith
