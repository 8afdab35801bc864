// The names that an expression may use, and what they stand for.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "expr/ast.h"
#include "expr/matrix.h"
#include "expr/parser.h"
#include "expr/program.h"

namespace gainsmith::expr {

/// A named matrix that a program takes as input. A known value (plant data, parameters) lets
/// functions whose shape depends on it (orth, null) be bound.
struct Symbol {
  Shape shape;
  std::optional<Matrix> value;
};

/// "name: expression" or "name(a, b): expression" in `let`.
struct Definition {
  std::vector<std::string> parameters;
  Expression body;
};

struct Scope {
  std::map<std::string, int> dimensions;  ///< n, p, ...
  std::map<std::string, Symbol> symbols;
  std::map<std::string, Definition> definitions;  ///< in any order; cycles are found when bound

  /// All names, for suggestions.
  std::vector<std::string> names() const;
};

}  // namespace gainsmith::expr
