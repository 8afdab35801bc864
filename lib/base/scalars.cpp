#include "base/scalars.h"

#include <boost/math/constants/constants.hpp>

#include "base/number.h"

namespace gainsmith {
namespace {

/// Decimals that tell any two numbers of 107 (31 digits) and of 500 (100 digits) bits apart.
constexpr int kQuadText = 34, kWideText = 153;

/// Boost fills in a limit of a number type at its first call, unsafe where two threads make that
/// call. This one is made before threads begin: Boost's own does it for types with expression
/// templates alone (multiprecision/mpfr.hpp, data_initializer).
[[maybe_unused]] const bool limits_are_filled_in = [] {
  using Limits = std::numeric_limits<Decimal100>;
  Limits::epsilon();
  Limits::round_error();
  (Limits::min)();
  (Limits::max)();
  Limits::infinity();
  Limits::quiet_NaN();
  return true;
}();

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
  static const auto value = boost::math::constants::pi<Decimal100>();
  return value;
}
template <>
DoubleDouble pi<DoubleDouble>() {
  return as<DoubleDouble>(pi<Decimal100>());
}

}  // namespace gainsmith
