// The place of an error must lie in the text that was read.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "base/error.h"

namespace gainsmith {

/// Characters, not bytes: those that continue one do not count.
inline int code_points(std::string_view text) {
  int count = 0;
  for (const char c : text) count += (static_cast<unsigned char>(c) & 0xC0U) != 0x80U ? 1 : 0;
  return count;
}

/// std::logic_error, which a fuzzer takes for a crash, unless the error has a message and its place is
/// known and inside `text`; one column behind the end of a line is inside. Places in other files than
/// `file` are not looked at.
inline void require_place(const InputError& error, const std::string& file, std::string_view text) {
  const auto stop = [&](const char* what) {
    throw std::logic_error(std::string(what) + ": " + error.what());
  };
  if (error.message().empty()) stop("an error without a message");
  const Place& place = error.place();
  if (place.file != file) return;
  if (place.line < 1 || place.column < 1) stop("an error without a place");
  for (int line = 1; line < place.line; ++line) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) stop("a line behind the end of the text");
    text.remove_prefix(end + 1);
  }
  if (place.column > code_points(text.substr(0, text.find('\n'))) + 1)
    stop("a column behind the end of its line");
}

}  // namespace gainsmith
