// The real number types that the program computes in, and what is exact between them.
//
//   double         53 bits, 15 digits
//   DoubleDouble   106 bits, 31 digits   a sum of two doubles (double_double.h)
//   Decimal100     500 bits, 150 digits   MPFR; 100 of its digits are relied on
//
// Code is written once for all three, as a template that GAINSMITH_FOR_EACH_SCALAR instantiates.
// Conversions to a wider type are exact. Exact fractions are in rational.h.
#pragma once

#include <boost/multiprecision/mpfr.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "base/double_double.h"
#include "base/finer.h"

namespace gainsmith {

/// 100 decimal digits that may be relied on, and 50 to lose in computing them (MPFR, kept on the
/// stack), for what 31 do not settle. A program that is nearly singular ends with some two thirds
/// of the digits it is solved in.
using Decimal100 = boost::multiprecision::number<
    boost::multiprecision::mpfr_float_backend<150, boost::multiprecision::allocate_stack>,
    boost::multiprecision::et_off>;

/// Decimal digits of each arithmetic.
constexpr int kDoubleDigits = 15, kQuadDigits = 31, kWideDigits = 100;

/// "double", "31 digits", "100 digits".
template <typename T>
std::string name_of() {
  if constexpr (std::is_same_v<T, double>)
    return "double";
  else
    return std::to_string(std::is_same_v<T, DoubleDouble> ? kQuadDigits : kWideDigits) + " digits";
}

/// The number in another type: rounded where that is narrower, exact where it is wider.
template <typename To, typename From>
To as(const From& value) {
  return static_cast<To>(value);
}
template <>
inline Decimal100 as<Decimal100, DoubleDouble>(const DoubleDouble& value) {
  return Decimal100(value.hi()) + Decimal100(value.lo());
}
template <>
inline DoubleDouble as<DoubleDouble, Decimal100>(const Decimal100& value) {
  const double high = static_cast<double>(value);
  return {high, static_cast<double>(Decimal100(value - high))};
}

/// x = as<DoubleDouble>(x) + the finer part of x.
inline Finer finer_part(Decimal100 x) {
  const auto leading = as<DoubleDouble>(x);
  x -= leading.hi();
  x -= leading.lo();
  Finer finer;
  for (double& part : finer) {
    part = static_cast<double>(x);
    x -= part;
  }
  return finer;
}
inline Decimal100 with_finer(const DoubleDouble& leading, const Finer& finer) {
  Decimal100 x(0);
  for (auto part = finer.rbegin(); part != finer.rend(); ++part) x += *part;
  return x + leading.lo() + leading.hi();
}

/// The value of a decimal text, with all the digits that T has. Texts and refusals
/// are those of parse_decimal (number.h), so that a text is a number in every arithmetic or in
/// none.
template <typename T>
std::optional<T> parse_as(std::string_view text);
template <>
std::optional<double> parse_as<double>(std::string_view text);
template <>
std::optional<DoubleDouble> parse_as<DoubleDouble>(std::string_view text);
template <>
std::optional<Decimal100> parse_as<Decimal100>(std::string_view text);

/// A decimal with so many digits (17, 34, 153) that parse_as<T> gives the same number; in 31 digits
/// where the halves touch, and to 2^-106 of it where they lie apart. As "%g" otherwise: 0.5, 1e-07,
/// inf, nan.
template <typename T>
std::string decimal(const T& value);
template <>
std::string decimal<double>(const double& value);
template <>
std::string decimal<DoubleDouble>(const DoubleDouble& value);
template <>
std::string decimal<Decimal100>(const Decimal100& value);

/// pi, rounded to T.
template <typename T>
T pi();
template <>
double pi<double>();
template <>
DoubleDouble pi<DoubleDouble>();
template <>
Decimal100 pi<Decimal100>();

}  // namespace gainsmith

// Expands DO(T) for each of them; used at the end of a source for its explicit instantiations.
#define GAINSMITH_FOR_EACH_SCALAR(DO) \
  DO(double)                          \
  DO(gainsmith::DoubleDouble)         \
  DO(gainsmith::Decimal100)
