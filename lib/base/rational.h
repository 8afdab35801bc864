// Exact numbers: fractions and whole numbers of any size.
#pragma once

#include <boost/multiprecision/gmp.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "base/double_double.h"

namespace gainsmith {

using Rational = boost::multiprecision::number<boost::multiprecision::gmp_rational,
                                               boost::multiprecision::et_off>;
using Integer =
    boost::multiprecision::number<boost::multiprecision::gmp_int, boost::multiprecision::et_off>;

/// 10^exponent, also for exponents below 0.
Rational power_of_ten(int exponent);

/// The value of a decimal text. Texts and refusals are those of parse_decimal
/// (number.h), which leave no exponent that takes all memory.
std::optional<Rational> parse_rational(std::string_view text);

/// "0.125" where x has decimals, up to 100 of them, and otherwise "1/3".
std::string exact_text(const Rational& x);

/// The whole number nearest to x, of two the larger one.
Integer nearest_integer(const Rational& x);

/// Rounded to double, and to 31 digits.
double nearest_double(const Rational& x);
DoubleDouble nearest_double_double(const Rational& x);

/// A short fraction p/q within `relative` |x| of x, or p/q times a power of ten: the first end of
/// the continued fraction of x, or of x / 10^k between 1 and 10, that is so near, whichever has the
/// smaller |p q|. None when that exceeds `longest`.
std::optional<Rational> short_fraction(const Rational& x, double relative, double longest);

}  // namespace gainsmith
