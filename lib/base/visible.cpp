#include "base/visible.h"

#include <fmt/format.h>

namespace gainsmith {

namespace {

/// Bytes of the one at the beginning; 0: it is none.
std::size_t control_length(std::string_view text) {
  const auto within = [&](std::size_t k, unsigned low, unsigned high) {
    const unsigned byte = k < text.size() ? static_cast<unsigned char>(text[k]) : 0U;
    return low <= byte && byte <= high;
  };
  if (within(0, 0, 0x1F) || within(0, 0x7F, 0x7F)) return 1;
  if (within(0, 0xC2, 0xC2) && within(1, 0x80, 0x9F)) return 2;
  // U+200E, 200F, 2028 to 202E; U+2066 to 2069.
  const bool marks = within(1, 0x80, 0x80) && (within(2, 0x8E, 0x8F) || within(2, 0xA8, 0xAE));
  const bool isolates = within(1, 0x81, 0x81) && within(2, 0xA6, 0xA9);
  return within(0, 0xE2, 0xE2) && (marks || isolates) ? 3 : 0;
}

}  // namespace

std::size_t control_character(std::string_view utf8, std::string_view allowed) {
  for (std::size_t at = 0; at < utf8.size(); ++at)
    if (allowed.find(utf8[at]) == allowed.npos && control_length(utf8.substr(at)) > 0) return at;
  return std::string_view::npos;
}

std::string visible(std::string_view utf8, std::string_view allowed) {
  std::string text;
  for (std::size_t at; (at = control_character(utf8, allowed)) != utf8.npos;) {
    text += utf8.substr(0, at);
    const std::string_view found = utf8.substr(at, control_length(utf8.substr(at)));
    for (const char c : found) text += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    utf8.remove_prefix(at + found.size());
  }
  return text.append(utf8);
}

}  // namespace gainsmith
