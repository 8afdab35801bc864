// Names and what they are given, as read.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "expr/text/ast.h"
#include "expr/text/parser.h"
#include "model/shape_text.h"

namespace gainsmith::model {

/// An argument of a datum that is a function.
struct Argument {
  std::string name;
  ShapeText shape;
  Place place;
};

/// Something with a name and a shape: a datum, an unknown, a state. With indices it is a family:
/// "for: i in 1..N". A datum with arguments is a function, "of: {x: n}"; its shape is that of its
/// values.
struct Declaration {
  std::string name;
  ShapeText shape;
  std::vector<expr::Index> indices;
  /// A datum's default or a state's start, used when the problem gives none.
  std::optional<expr::Expression> fallback;
  std::string help;
  Place place;
  std::vector<Argument> arguments{};
};

/// A name and its expression, in the order of the file.
struct Named {
  std::string name;
  expr::Expression value;
  Place place;
};

/// An entry of `let`: "mu: ..." or "E(tau): ...".
struct Let {
  expr::Signature signature;
  expr::Expression body;
  Place place;
};

}  // namespace gainsmith::model
