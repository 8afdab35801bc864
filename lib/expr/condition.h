// Conditions: comparisons joined by `and`, `or`, `not`.
//
// Each comparison is a boundary: the difference of its sides, whose sign says on which side of it a
// point lies. A simulator searches for the roots of the differences and evaluates the whole there.
#pragma once

#include <string>
#include <vector>

#include "expr/program.h"
#include "expr/scope.h"

namespace gainsmith::expr {

struct Condition {
  enum class Kind {
    positive,     ///< difference > 0, for each element
    nonnegative,  ///< difference >= 0, for each element
    zero,         ///< difference == 0, for each element
    all,          ///< each of the parts
    any,          ///< one of the parts
    none          ///< not its only part
  };
  Kind kind = Kind::all;
  Program difference;            ///< of a comparison: the larger side minus the smaller one
  std::vector<Condition> parts;  ///< of the others; `all` of nothing is true
  std::string text;              ///< as written
  Place place;

  bool is_comparison() const {
    return kind == Kind::positive || kind == Kind::nonnegative || kind == Kind::zero;
  }
};

/// Whether an expression is a comparison or is made of them.
bool is_condition(const Expression& expression);

/// InputError when the expression is no condition, and for sides of different shapes. A chain a < b
/// <= c is both of its comparisons; `!=` is the negation of `==`. A number is compared with each
/// element of a column.
Condition compile_condition(const Expression& expression, const Scope& scope);

}  // namespace gainsmith::expr
