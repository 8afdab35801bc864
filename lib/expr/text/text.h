// A piece of the matrix language inside a file, with the place of each of its characters.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/error.h"

namespace gainsmith::expr {

/// A line and a column, both from 1.
struct Position {
  int line = 1;
  int column = 1;
};

/// Text plus, for every byte of it, where it is in the file (a YAML scalar may be quoted or
/// folded over lines, so the places need not be consecutive).
class Text {
 public:
  Text() = default;
  /// `positions` has one element a byte and one more for the end.
  Text(std::string text, std::string file, std::vector<Position> positions);
  /// Text that is in one piece at `start`.
  Text(std::string text, std::string file, Position start = {});

  /// Text that was made, not read: each of its bytes has the place of what it was made from.
  static Text generated(std::string text, const Place& place);

  const std::string& str() const { return text_; }
  const std::string& file() const { return file_; }
  /// The place of the byte `offset`; past the end: the place just behind the text.
  Place place(std::size_t offset) const;
  /// The bytes [begin, end) with their places.
  Text part(std::size_t begin, std::size_t end) const;

 private:
  std::string text_;
  std::string file_;
  std::vector<Position> positions_;
};

}  // namespace gainsmith::expr
