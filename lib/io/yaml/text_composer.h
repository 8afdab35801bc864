// Internal to io: one text put together from scalars and punctuation, each character with its
// place.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <utility>
#include <vector>

#include "expr/text/parser.h"

namespace gainsmith::io {

/// Adds texts one behind the other. `positions_` has the place of each byte of the text so far.
class TextComposer {
 public:
  explicit TextComposer(std::string file) : file_(std::move(file)) {}

  void punctuation(const std::string& mark, const Place& place) {
    text_ += mark;
    positions_.insert(positions_.end(), mark.size(), {place.line, place.column});
  }

  void text(const expr::Text& part) {
    text_ += part.str();
    for (std::size_t at = 0; at < part.str().size(); ++at) {
      const Place place = part.place(at);
      positions_.push_back({place.line, place.column});
    }
  }

  /// In brackets of its own a part cannot be torn apart by what is around it; a number or a name
  /// needs none.
  void bracketed(const expr::Text& part) {
    const auto is_one = [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
    };
    if (std::all_of(part.str().begin(), part.str().end(), is_one)) return text(part);
    punctuation("(", part.place(0));
    text(part);
    punctuation(")", part.place(part.str().size()));
  }

  /// The whole text as an expression; `end` is the place of what lacks behind it.
  expr::Expression parse(const Place& end) {
    positions_.push_back({end.line, end.column});
    return expr::parse({text_, file_, std::move(positions_)});
  }

 private:
  std::string file_;
  std::string text_;
  std::vector<expr::Position> positions_;
};

}  // namespace gainsmith::io
