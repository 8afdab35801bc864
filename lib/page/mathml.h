// Expressions of the matrix language as MathML, as a paper prints them.
//
//   He(P*A - Y*C) + 2*alpha*P < 0      He(PA − YC) + 2αP ≺ 0       in an inequality
//   inv(P1)*Y, expm(A*s)', a/b         powers, raised texts and fractions
//   [P1, Y; *, g*I]                    a matrix in brackets; * is the star of symmetric blocks
//   P(i), z(2), f(x), Y(tau)           a member, an element, values of functions
//
// Parentheses are where the tree needs them, not where they were written. MathML Core alone is
// used, what browsers show without help.
#pragma once

#include <string>

#include "expr/text/ast.h"
#include "expr/text/parser.h"
#include "page/notation.h"

namespace gainsmith::page {

/// The inside of a <math> element. Empty for an expression without a root.
std::string mathml(const expr::Expression& expression, const Notation& notation);

/// The same with the order of symmetric matrices in comparisons, where they are not of numbers.
std::string inequality_mathml(const expr::Expression& expression, const Notation& notation);

/// A name, with a hat if it is an estimate.
std::string name_mathml(const std::string& name, const Notation& notation);

/// What is defined: "μ", "E(τ)", "L_i(s)".
std::string signature_mathml(const expr::Signature& signature, const Notation& notation);

/// "i = 1, …, N".
std::string index_mathml(const expr::Index& index, const Notation& notation);

}  // namespace gainsmith::page
