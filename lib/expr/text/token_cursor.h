// Internal to expr: the tokens of a text, read one after the other.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "expr/text/lexer.h"

namespace gainsmith::expr {

/// A position in the tokens of one text. The last token is `end`, and the cursor does not pass it.
class TokenCursor {
 public:
  explicit TokenCursor(std::shared_ptr<const Text> text);

  const std::shared_ptr<const Text>& text() const { return text_; }
  TokenKind peek() const { return tokens_[at_].kind; }
  /// The token here, and those `ahead` of it; the end represents all beyond it.
  const Token& here(std::size_t ahead = 0) const;
  const Token& next() { return tokens_[at_++]; }
  /// Where the token before ends; `otherwise` at the first.
  std::size_t last_end(std::size_t otherwise) const {
    return at_ > 0 ? tokens_[at_ - 1].end : otherwise;
  }

  /// Whether the token before is that.
  bool is_behind(TokenKind kind) const { return at_ > 0 && tokens_[at_ - 1].kind == kind; }

  /// Takes the token here if it is that, or that word of the language.
  bool accept(TokenKind kind);
  bool accept(std::string_view word);
  /// Takes it; InputError "expected ..., found ..." for another.
  const Token& expect(TokenKind kind, const std::string& what);

  /// What is here, and what is likely to be missing before it, for messages.
  std::string found() const;
  std::string missing() const;
  /// InputError for a comma between the digits of one number.
  void refuse_decimal_comma() const;
  /// InputError at the token here.
  [[noreturn]] void fail(const std::string& message) const;

 private:
  std::shared_ptr<const Text> text_;
  std::vector<Token> tokens_;
  std::size_t at_ = 0;
};

}  // namespace gainsmith::expr
