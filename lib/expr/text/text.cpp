#include "expr/text/text.h"

#include <algorithm>
#include <utility>

#include "base/utf8.h"

namespace gainsmith::expr {

namespace {

/// A position for each byte and one for the end. Bytes after the first of a character of UTF-8 are
/// in its column.
std::vector<Position> consecutive(const std::string& text, Position at) {
  std::vector<Position> positions;
  positions.reserve(text.size() + 1);
  for (const char c : text) {
    positions.push_back(at);
    if (c == '\n') {
      at = {at.line + 1, 1};
    } else if (!is_continuation(c)) {
      ++at.column;
    }
  }
  positions.push_back(at);
  return positions;
}

}  // namespace

Text::Text(std::string text, std::string file, std::vector<Position> positions)
    : text_(std::move(text)), file_(std::move(file)), positions_(std::move(positions)) {}

Text::Text(std::string text, std::string file, Position start)
    : text_(std::move(text)), file_(std::move(file)), positions_(consecutive(text_, start)) {}

Text Text::generated(std::string text, const Place& place) {
  std::vector<Position> positions(text.size() + 1, {place.line, place.column});
  return {std::move(text), place.file, std::move(positions)};
}

Place Text::place(std::size_t offset) const {
  if (positions_.empty()) return {file_};
  const Position at = positions_[std::min(offset, positions_.size() - 1)];
  return {file_, at.line, at.column};
}

Text Text::part(std::size_t begin, std::size_t end) const {
  const auto first = positions_.begin();
  return {text_.substr(begin, end - begin), file_,
          std::vector<Position>(first + static_cast<std::ptrdiff_t>(begin),
                                first + static_cast<std::ptrdiff_t>(end) + 1)};
}

}  // namespace gainsmith::expr
