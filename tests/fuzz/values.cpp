#include "fuzz/values.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace gainsmith::fuzz {

namespace {

[[noreturn]] void missing(const std::string& value) {
  throw std::logic_error("the file does not have the value " + value);
}

template <class Number>
bool has(Number value, std::string_view bytes) {
  std::string stored(sizeof value, '\0');
  std::memcpy(stored.data(), &value, sizeof value);
  if (bytes.find(stored) != std::string_view::npos) return true;
  std::reverse(stored.begin(), stored.end());
  return bytes.find(stored) != std::string_view::npos;
}

}  // namespace

NumbersOfText::NumbersOfText(std::string_view text) {
  // Where a number may begin: strtod goes on as far as it is one.
  const std::string copy(text);
  for (std::size_t at = 0; at < copy.size(); ++at) {
    char* end = nullptr;
    const double value = std::strtod(copy.c_str() + at, &end);
    if (end == copy.c_str() + at) continue;
    values_.insert(value);
    values_.insert(-value);
  }
}

void NumbersOfText::require(double value) const {
  if (!values_.contains(value)) missing(std::to_string(value));
}

void NumbersOfText::require(const std::string& decimal) const {
  if (!values_.contains(std::strtod(decimal.c_str(), nullptr))) missing(decimal);
}

void require_stored(const std::string& decimal, std::string_view bytes) {
  const double value = std::strtod(decimal.c_str(), nullptr);
  if (has(value, bytes) || has(static_cast<float>(value), bytes)) return;
  if (decimal.find_first_of(".e") == std::string::npos) {
    const bool negative = decimal.starts_with('-');
    const std::uint64_t word =
        negative ? static_cast<std::uint64_t>(std::strtoll(decimal.c_str(), nullptr, 10))
                 : std::strtoull(decimal.c_str(), nullptr, 10);
    const auto fits = [&](unsigned bits) {
      return negative ? value >= -std::ldexp(1, static_cast<int>(bits) - 1)
                      : value < std::ldexp(1, static_cast<int>(bits));
    };
    if (has(word, bytes) || (fits(32) && has(static_cast<std::uint32_t>(word), bytes)) ||
        (fits(16) && has(static_cast<std::uint16_t>(word), bytes)) ||
        (fits(8) && has(static_cast<std::uint8_t>(word), bytes)))
      return;
  }
  missing(decimal);
}

}  // namespace gainsmith::fuzz
