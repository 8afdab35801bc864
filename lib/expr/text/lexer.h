// From characters to tokens.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "expr/text/text.h"

namespace gainsmith::expr {

enum class TokenKind {
  number,
  name,
  part,  ///< ".A" behind a parenthesis: of a system
#define SYMBOL(token, spelling) token,
#include "expr/operations.def"
  end
};

/// A piece of the text, bytes begin ... end - 1.
struct Token {
  TokenKind kind = TokenKind::end;
  std::string text;
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Splits the text; the last token is `end`. InputError on a character that the language does not
/// know, with what was probably meant (== for <=, ** for ^, a typographic minus, ...).
std::vector<Token> tokenize(const Text& text);

}  // namespace gainsmith::expr
