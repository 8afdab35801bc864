#include "base/scalars.h"

#include <boost/math/constants/constants.hpp>

#include "base/number.h"

namespace gainsmith {
namespace {

/// Decimals that tell any two numbers of 107 (31 digits) and of 500 (100 digits) bits apart.
constexpr int kQuadText = 34, kWideText = 153;

}  // namespace

template <>
std::optional<double> parse_as<double>(std::string_view text) {
  return parse_decimal(text);
}

template <>
std::optional<Decimal100> parse_as<Decimal100>(std::string_view text) {
  if (!parse_decimal(text)) return std::nullopt;
  return Decimal100(std::string(text));
}

template <>
std::optional<DoubleDouble> parse_as<DoubleDouble>(std::string_view text) {
  const auto wide = parse_as<Decimal100>(text);
  if (!wide) return std::nullopt;
  return as<DoubleDouble>(*wide);
}

template <>
std::string decimal<double>(const double& value) {
  return decimal17(value);
}

template <>
std::string decimal<Decimal100>(const Decimal100& value) {
  return value.str(kWideText);
}

template <>
std::string decimal<DoubleDouble>(const DoubleDouble& value) {
  return isfinite(value) ? as<Decimal100>(value).str(kQuadText) : decimal17(value.hi());
}

template <>
double pi<double>() {
  return boost::math::constants::pi<double>();
}
template <>
Decimal100 pi<Decimal100>() {
  return boost::math::constants::pi<Decimal100>();
}
template <>
DoubleDouble pi<DoubleDouble>() {
  return as<DoubleDouble>(pi<Decimal100>());
}

}  // namespace gainsmith
