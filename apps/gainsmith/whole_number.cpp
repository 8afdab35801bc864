#include "gainsmith/whole_number.h"

#include <charconv>

namespace gainsmith::app {

namespace {

template <typename Whole>
std::optional<Whole> digits_only(const std::string& text) {
  Whole value = 0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  if (text.empty() || text.front() == '-' || read.ec != std::errc() || read.ptr != end)
    return std::nullopt;
  return value;
}

}  // namespace

std::optional<std::uint64_t> parse_whole(const std::string& text) {
  const std::size_t mark = text.find_first_of("eE");
  std::string digits = text.substr(0, mark);
  if (digits.empty()) return std::nullopt;
  // A larger exponent fits no number but 0.
  int exponent = 0;
  if (mark != std::string::npos) {
    const std::size_t sign = mark + 1 < text.size() && text[mark + 1] == '+' ? 1 : 0;
    const auto read = digits_only<std::uint16_t>(text.substr(mark + 1 + sign));
    if (!read) return std::nullopt;
    exponent = *read;
  }
  if (const std::size_t point = digits.find('.'); point != std::string::npos && point > 0) {
    exponent -= static_cast<int>(digits.size() - point - 1);
    digits.erase(point, 1);
  }
  for (; exponent < 0 && digits.ends_with('0'); ++exponent) digits.pop_back();
  if (exponent < 0) return std::nullopt;
  constexpr int kDigits = 20;  // of the largest number
  if (exponent > kDigits) return std::nullopt;
  digits.append(static_cast<std::size_t>(exponent), '0');
  return digits_only<std::uint64_t>(digits);
}

}  // namespace gainsmith::app
