#include "base/visible.h"

#include <fmt/format.h>

namespace gainsmith {

namespace {

/// Bytes of the one at the beginning; 0: it is none.
std::size_t control_length(std::string_view text) {
  const auto byte = [&](std::size_t k) {
    return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U;
  };
  if (byte(0) < 0x20 || byte(0) == 0x7F) return 1;
  if (byte(0) == 0xC2 && byte(1) >= 0x80 && byte(1) < 0xA0) return 2;
  const bool separates = byte(1) == 0x80 && byte(2) >= 0xA8 && byte(2) <= 0xAE;
  const bool marks = byte(1) == 0x80 && (byte(2) == 0x8E || byte(2) == 0x8F);
  const bool isolates = byte(1) == 0x81 && byte(2) >= 0xA6 && byte(2) <= 0xA9;
  return byte(0) == 0xE2 && (separates || marks || isolates) ? 3 : 0;
}

}  // namespace

std::size_t control_character(std::string_view utf8, std::string_view allowed) {
  for (std::size_t at = 0; at < utf8.size(); ++at)
    if (allowed.find(utf8[at]) == std::string_view::npos && control_length(utf8.substr(at)) > 0)
      return at;
  return std::string_view::npos;
}

std::string visible(std::string_view utf8, std::string_view allowed) {
  std::string text;
  for (std::size_t at; (at = control_character(utf8, allowed)) != std::string_view::npos;) {
    text += utf8.substr(0, at);
    const std::size_t end = at + control_length(utf8.substr(at));
    for (; at < end; ++at) text += fmt::format("\\x{:02x}", static_cast<unsigned char>(utf8[at]));
    utf8.remove_prefix(end);
  }
  return text.append(utf8);
}

}  // namespace gainsmith
