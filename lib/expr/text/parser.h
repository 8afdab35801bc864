// From tokens to a syntax tree, by recursive descent: one function for each rule.
//
//   condition  := conjunction ("or" conjunction)*
//   conjunction := negation ("and" negation)*
//   negation   := "not" negation | comparison
//   comparison := sum (relation sum)*
//   sum        := term (("+" | "-") term)*
//   term       := sign (("*" | "/" | ".*" | "./") sign)*
//   sign       := ("-" | "+") sign | postfix
//   postfix    := primary ("'" | "(" arguments ")" | ("^" | ".^") exponent | ".A" ... ".D")*
//                 (left to right, as in MATLAB)
//   exponent   := ("-" | "+") exponent | primary
//   primary    := number | name | "(" condition ")" | "[" row (";" row)* "]"
//   row        := entry ("," entry)*;   entry := "*" | sum
//   arguments  := argument ("," argument)*
//   argument   := ":" | condition [":" comparison] | index | box
//   index      := name "in" sum ".." sum
//   box        := name "in" "[" sum "," sum "]"
#pragma once

#include "expr/text/ast.h"

namespace gainsmith::expr {

/// Parses the whole text. InputError at the first character that does not fit, with what was
/// expected there.
Expression parse(Text text);

/// The same of one element of a matrix: "1 -1", two elements in MATLAB, is refused.
Expression parse_element(Text text);

/// "i in 1..N": whole numbers that count the members of a family.
struct Index {
  std::string name;
  Expression low;
  Expression high;
  Place place;
};

/// "i in 1..N" alone. InputError for anything else.
Index parse_index(Text text);

/// A left-hand side: "mu", "E(tau)", "f(a, b)", or of a family "L(i in 1..N)", "L(i in 1..N)(s)".
struct Signature {
  std::string name;
  std::vector<std::string> parameters;
  std::vector<Index> indices{};
};

/// InputError for a parameter or an index that is given twice.
Signature parse_signature(Text text);

}  // namespace gainsmith::expr
