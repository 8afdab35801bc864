// Characters that are no text: they move a cursor, end a line or turn the direction of writing.
#pragma once

#include <string>
#include <string_view>

namespace gainsmith {

/// The byte of the first one, other than those of `allowed`; npos: there is none. C0 and C1
/// controls, DEL, ends of lines and paragraphs, marks of direction.
std::size_t control_character(std::string_view utf8, std::string_view allowed = {});

/// The text with each byte of them as "\x1b".
std::string visible(std::string_view utf8, std::string_view allowed = "\n\t");

}  // namespace gainsmith
