// UTF-8 as RFC 3629 has it: overlong forms, surrogates and what lies above U+10FFFF are no
// characters.
#include "drawing/text.h"

#include <cstdint>

namespace gainsmith::drawing {

namespace {

/// The replacement character, U+FFFD.
constexpr char32_t unreadable = 0xFFFD;
constexpr std::string_view unreadable_bytes = "\xEF\xBF\xBD";
constexpr std::string_view ellipsis = "\xE2\x80\xA6";

struct Character {
  char32_t code = unreadable;
  std::size_t bytes = 1;
};

/// Whether XML 1.0 has the character (production 2 of its grammar).
bool in_xml(char32_t code) {
  if (code < 0x20) return code == '\t' || code == '\n' || code == '\r';
  return code <= 0x10FFFF && !(code >= 0xD800 && code <= 0xDFFF) && code != 0xFFFE &&
         code != 0xFFFF;
}

/// The first character of a text that is not empty.
Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t lead = byte(0);
  if (lead < 0x80) return {in_xml(lead) ? lead : unreadable, 1};
  const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < bytes) return {};
  char32_t code = lead & (0xFFU >> (bytes + 1));
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0U) != 0x80) return {};
    code = (code << 6U) | (byte(i) & 0x3FU);
  }
  constexpr char32_t least[] = {0x80, 0x800, 0x10000};
  if (code < least[bytes - 2] || !in_xml(code)) return {};
  return {code, bytes};
}

/// In units of the font's size, after DejaVu Sans, which is wider than its relatives.
double width_of(char32_t code) {
  constexpr std::string_view narrow = "ijl.,:;|!'`()[]{}tfrI/\\ ";
  if (code < 0x80) {
    const char c = static_cast<char>(code);
    if (narrow.find(c) != std::string_view::npos) return 0.4;
    if (std::string_view("mwMW%@").find(c) != std::string_view::npos) return 1.0;
    if (c >= 'A' && c <= 'Z') return 0.74;
    if (std::string_view("+=<>~^").find(c) != std::string_view::npos) return 0.84;
    return 0.64;
  }
  if (code >= 0x300 && code < 0x370) return 0;       // marks above the one before
  if (code >= 0x2070 && code < 0x20A0) return 0.45;  // small figures
  if (code == 0x2212) return 0.84;                   // minus
  if ((code >= 0x1100 && code < 0x1200) || code >= 0x2E80) return 1.0;  // East Asian, pictures
  return 0.76;
}

}  // namespace

std::string escaped(std::string_view utf8) {
  std::string text;
  while (!utf8.empty()) {
    const Character next = first_character(utf8);
    if (next.code == '&')
      text += "&amp;";
    else if (next.code == '<')
      text += "&lt;";
    else if (next.code == '>')
      text += "&gt;";
    else if (next.code == '"')
      text += "&quot;";
    else if (next.code == '\t' || next.code == '\n' || next.code == '\r')
      text += ' ';
    else if (next.code == unreadable)
      text += unreadable_bytes;
    else
      text += utf8.substr(0, next.bytes);
    utf8.remove_prefix(next.bytes);
  }
  return text;
}

double text_width(std::string_view utf8, double size) {
  double width = 0;
  while (!utf8.empty()) {
    const Character next = first_character(utf8);
    width += width_of(next.code);
    utf8.remove_prefix(next.bytes);
  }
  return width * size;
}

/// Characters are never cut in two.
std::string shortened(std::string_view utf8, double size, double width) {
  if (text_width(utf8, size) <= width) return std::string(utf8);
  const double room = width - text_width(ellipsis, size);
  std::size_t end = 0;
  double used = 0;
  while (end < utf8.size()) {
    const Character next = first_character(utf8.substr(end));
    used += width_of(next.code) * size;
    if (used > room) break;
    end += next.bytes;
  }
  return std::string(utf8.substr(0, end)) + std::string(ellipsis);
}

}  // namespace gainsmith::drawing
