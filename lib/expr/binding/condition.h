// Conditions: comparisons joined by `and`, `or`, `not`.
//
// Each comparison is a boundary: the difference of its sides, whose sign says on which side of it a
// point lies. A simulator searches for the roots of the differences and evaluates the whole there.
#pragma once

#include <string>
#include <vector>

#include "base/truth.h"
#include "expr/binding/scope.h"
#include "expr/program/program.h"

namespace gainsmith::expr {

/// A tree. Leaves are comparisons of a difference with 0, element by element.
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

/// Of all, any or none of the parts, where `of` says what one is. It stops where that is decided,
/// so that a part may guard a later one against having no value.
template <class Parts, class Of>
Truth joined(Condition::Kind kind, Parts& parts, const Of& of) {
  if (kind == Condition::Kind::none) return opposite(of(parts.front()));
  const Truth decides = truth_of(kind == Condition::Kind::any);
  Truth result = opposite(decides);
  for (auto& part : parts) {
    const Truth one = of(part);
    if (one == decides) return one;
    if (one == Truth::unknown) result = one;
  }
  return result;
}

/// Whether an expression is a comparison or is made of them.
bool is_condition(const Expression& expression);

/// InputError when the expression is no condition, and for sides of different shapes. A chain a < b
/// <= c is both of its comparisons; `!=` is the negation of `==`. A number is compared with each
/// element of a column.
Condition compile_condition(const Expression& expression, const Scope& scope);

}  // namespace gainsmith::expr
