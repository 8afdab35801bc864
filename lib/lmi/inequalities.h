// The inequalities of an instance, ready to be evaluated: what each states is given here once,
// for the blocks that are solved (compile.h) and for the margins that are recomputed
// (verdict/margins.h).
#pragma once

#include <optional>
#include <vector>

#include "forall/box.h"
#include "forall/domain.h"
#include "lmi/unknowns.h"
#include "model/function.h"
#include "model/instance.h"

namespace gainsmith::lmi {

/// An inequality for all values of its variables.
struct Statement {
  const model::Design::Inequality* stated = nullptr;
  forall::Domain domain;                   ///< with numbers
  std::vector<expr::Program> differences;  ///< one a comparison, unknown functions linked
};

/// Unknown functions are polynomials of their declared degree or, when the problem asks for gains
/// at the vertices of a box, have one coefficient for each vertex (vertex_gains.h).
struct Inequalities {
  /// InputError, at its place, for an empty interval and what vertex_box() refuses.
  explicit Inequalities(const model::Instance& of);

  const model::Design& design() const { return *instance.design; }

  model::Instance instance;
  std::optional<forall::Box> box;  ///< of vertex gains
  std::vector<model::Function> functions;
  model::Bodies bodies;
  Unknowns unknowns;
  std::vector<Statement> statements;  ///< in the order of the method
};

}  // namespace gainsmith::lmi
