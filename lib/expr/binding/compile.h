// From expressions to programs: names, shapes and definitions are resolved.
//
// Shapes are matrices' rows x columns; numbers are 1 x 1 and multiply anything. Two things take
// their size from where they are:
//   I   the identity; any expression s*I + t*I is still "a multiple of I"
//   0   in a block, a sum or a comparison
// In a block [a, b; c, d] a "*" is the transpose of the entry mirrored at the diagonal, and then
// the rows are cut like the columns.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "expr/binding/scope.h"

namespace gainsmith::expr {

/// The program of an expression that is not a comparison. `expected` gives its size to a bare I or
/// 0 and is checked. InputError with the shapes at fault, or the nearest known name.
Program compile(const Expression& expression, const Scope& scope,
                std::optional<Shape> expected = std::nullopt);

/// A linear system as one matrix.
struct CompiledSystem {
  Program matrix;               ///< [A, B; C, D]
  int states = 0;               ///< the first rows and columns
  std::optional<Program> step;  ///< the sampling time; none: continuous
};

/// Whether a text makes a system by its calls and operators, whatever its names mean.
bool makes_system(const Node& node);

/// The program of a system; a matrix is one without states. InputError as of compile().
CompiledSystem compile_system(const Expression& expression, const Scope& scope);

/// The ends of the range of an index, whole numbers over dimensions: numbers, +, - and *.
/// InputError at what is none, and for more than 100,000 values.
std::pair<int, int> range_of(const Index& index, const Scope& scope);

/// Whether a comparison of such whole numbers holds, `i != j`, `i < j <= k`.
bool whole_condition(const Expression& expression, const Scope& scope);

/// One comparison of a chain: the larger side minus the smaller one, to be > 0 (strict) or >= 0.
/// It is of use for inequalities of symmetric matrices; `difference` is square.
struct CompiledRelation {
  Program difference;  ///< of `==`: [0, D; D', 0], D of any shape
  bool strict = true;
  bool equation = false;
};

/// The comparisons of a chain such as I <= P <= kappa*I, in order. InputError when the expression
/// is no comparison or a difference is neither square nor a column or a row, whose elements are
/// compared.
std::vector<CompiledRelation> compile_relations(const Expression& expression, const Scope& scope);

}  // namespace gainsmith::expr
