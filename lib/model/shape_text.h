// Declared shapes: "n x p", "n" (a column), "scalar", "symmetric n", "diagonal n"; and "system",
// "system n", "system n p x m": a linear system with n states, p outputs and m inputs.
#pragma once

#include <optional>
#include <string>

#include "expr/program/program.h"
#include "expr/text/ast.h"
#include "model/words.h"

namespace gainsmith::model {

/// Sizes are whole-number expressions in dimension names, such as n, 2 or n + p.
struct ShapeText {
  Structure structure = Structure::scalar;
  std::optional<expr::Expression> rows;  ///< none for scalar
  std::optional<expr::Expression> cols;  ///< none for scalar, symmetric, diagonal and columns
  bool system = false;
  std::optional<expr::Expression> states;  ///< of a system, whose D is rows x cols
  std::string text;                        ///< as written
  Place place;

  bool is_column() const { return structure == Structure::full && rows && !cols && !system; }
};

/// InputError when the text is none of the forms above.
ShapeText parse_shape(const expr::Text& text);

/// Learns the sizes of a system from [A, B; C, D] of this shape; false for a contradiction.
bool learn_system(const ShapeText& shape, expr::Shape whole, int states, Dimensions& dimensions);

/// The shape, when all its dimension names are known; otherwise none. InputError when a size is
/// negative or no whole number.
std::optional<expr::Shape> resolve(const ShapeText& shape, const Dimensions& dimensions);

/// Learns dimension names from an actual shape: "n x p" against 2 x 1 gives n = 2, p = 1. Returns
/// false when the shape contradicts what is known.
bool learn(const ShapeText& shape, expr::Shape actual, Dimensions& dimensions);

}  // namespace gainsmith::model
