// From tokens to a syntax tree.
//
//   comparison := sum (("<" | "<=" | ">" | ">=") sum)*
//   sum        := term (("+" | "-") term)*
//   term       := sign (("*" | "/") sign)*
//   sign       := ("-" | "+") sign | postfix
//   postfix    := primary ("'" | "(" arguments ")" | "^" exponent)*
//                 (left to right, as in MATLAB)
//   exponent   := ("-" | "+") exponent | primary
//   primary    := number | name | "(" comparison ")" | "[" row (";" row)* "]"
//   row        := entry ("," entry)*;   entry := "*" | sum
//   arguments  := argument ("," argument)*;   argument := ":" | comparison [":" comparison]
#pragma once

#include "expr/ast.h"

namespace gainsmith::expr {

/// Parses the whole text. InputError at the first character that does not fit, with what was
/// expected there.
Expression parse(Text text);

/// A definition's left-hand side: "mu" or "E(tau)" or "f(a, b)".
struct Signature {
  std::string name;
  std::vector<std::string> parameters;
};

Signature parse_signature(const Text& text);

}  // namespace gainsmith::expr
