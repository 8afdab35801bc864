// Internal to expr: what to write instead, where the parser met something else.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "expr/text/lexer.h"

namespace gainsmith::expr {

/// "; ..." for the token at `at`, which did not fit: an operator, a comma or quotation marks that
/// are missing, a unit behind a number, a matrix that is indexed by brackets. Empty when none is
/// the cause.
std::string missing_between(std::span<const Token> tokens, std::size_t at);

/// What is said of a comma at `at` between the digits of one number; empty for other tokens.
std::string decimal_comma(std::span<const Token> tokens, std::size_t at);

}  // namespace gainsmith::expr
