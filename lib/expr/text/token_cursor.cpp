#include "expr/text/token_cursor.h"

#include <algorithm>
#include <utility>

#include "expr/text/parser_advice.h"

namespace gainsmith::expr {

TokenCursor::TokenCursor(std::shared_ptr<const Text> text)
    : text_(std::move(text)), tokens_(tokenize(*text_)) {}

/// The end is the token at all places behind it.
const Token& TokenCursor::here(std::size_t ahead) const {
  return tokens_[std::min(at_ + ahead, tokens_.size() - 1)];
}

bool TokenCursor::accept(TokenKind kind) {
  if (peek() != kind) return false;
  ++at_;
  return true;
}

bool TokenCursor::accept(std::string_view word) {
  if (peek() != TokenKind::name || here().text != word) return false;
  ++at_;
  return true;
}

const Token& TokenCursor::expect(TokenKind kind, const std::string& what) {
  if (peek() != kind) fail("expected " + what + ", found " + found() + missing());
  return kind == TokenKind::end ? here() : next();
}

std::string TokenCursor::found() const {
  return peek() == TokenKind::end ? "the end of the text" : "'" + here().text + "'";
}

std::string TokenCursor::missing() const { return missing_between(tokens_, at_); }

void TokenCursor::refuse_decimal_comma() const {
  if (const std::string said = decimal_comma(tokens_, at_); !said.empty()) fail(said);
}

void TokenCursor::fail(const std::string& message) const {
  throw InputError(text_->place(here().begin), message);
}

}  // namespace gainsmith::expr
