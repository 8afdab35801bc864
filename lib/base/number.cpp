#include "base/number.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace gainsmith {

namespace {

constexpr int kDigits = std::numeric_limits<double>::digits10;

std::string general(double value, int digits) {
  std::array<char, 64> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::general, digits);
  return {buffer.data(), end.ptr};
}

/// An exponent beyond 1000, of a number that is not 0. No double has it. A fraction of that size
/// takes all memory, and where 100 digits have their smallest number this would be 0 there too.
bool has_vast_exponent(std::string_view text) {
  constexpr int kMostExponent = 1000;
  const std::size_t e = text.find_first_of("eE");
  if (text.substr(0, e).find_first_of("123456789") == text.npos || e == text.npos) return false;
  text.remove_prefix(e + (text.substr(e + 1).starts_with('+') ? 2 : 1));
  int exponent = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), exponent);
  return read.ec == std::errc::result_out_of_range || exponent < -kMostExponent ||
         exponent > kMostExponent;
}

}  // namespace

std::string decimal17(double value) { return general(value, 17); }

std::string shortest(double value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                 std::chars_format::scientific);
  const std::string text(buffer.data(), end.ptr);  // "-1.25e+03"
  const std::size_t e = text.find('e');
  if (e == std::string::npos || value == 0) return general(value, kDigits);
  const bool negative = text[0] == '-';
  std::string digits = text.substr(negative, e - negative);
  std::erase(digits, '.');
  const int exponent = std::atoi(text.c_str() + e + 1);
  const int count = static_cast<int>(digits.size());
  if (exponent < -4 || exponent >= std::max(count, kDigits)) return text;
  if (exponent < 0) digits.insert(0, std::string(static_cast<std::size_t>(-exponent), '0'));
  const std::size_t whole = static_cast<std::size_t>(std::max(exponent, 0)) + 1;
  if (digits.size() < whole) digits.append(whole - digits.size(), '0');
  if (digits.size() > whole) digits.insert(whole, ".");
  return (negative ? "-" : "") + digits;
}

std::string brief(double value, int digits) { return general(value, digits); }

std::string brief_below(double value, int digits) {
  const std::string nearest = brief(value, digits);
  if (!(parse_decimal(nearest).value_or(value) > value)) return nearest;
  const double unit = std::pow(10, std::floor(std::log10(std::abs(value))) + 1 - digits);
  return brief(value - 0.5 * unit, digits);
}

std::string brief_above(double value, int digits) {
  const std::string below = brief_below(-value, digits);
  return below.starts_with('-') ? below.substr(1) : value == 0 ? "0" : "-" + below;
}

std::optional<double> parse_decimal(std::string_view text) {
  // from_chars knows no plus sign.
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  if (text.empty() || text.find_first_not_of("0123456789+-.eE") != std::string_view::npos)
    return std::nullopt;
  double value = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end.ptr != text.data() + text.size() || has_vast_exponent(text)) return std::nullopt;
  if (end.ec == std::errc::result_out_of_range) {
    // from_chars does not say whether the number is too large or too small; strtod does.
    value = std::strtod(std::string(text).c_str(), nullptr);
    if (std::isinf(value)) return std::nullopt;
    return value;
  }
  if (end.ec != std::errc()) return std::nullopt;
  return value;
}

}  // namespace gainsmith
