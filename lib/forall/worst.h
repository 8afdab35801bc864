// Where an inequality holds least, the unknowns fixed.
#pragma once

#include <vector>

#include "expr/program.h"
#include "forall/domain.h"

namespace gainsmith::forall {

struct Minimum {
  double value = 0;  ///< the smallest eigenvalue
  Point point;       ///< values of all variables
};

struct Minima {
  std::vector<Minimum> list;  ///< the smallest first
  /// False when the eigenvalue grows without end where an interval was divided as far as doubles
  /// go: a pole.
  bool resolved = true;
};

/// The local minima over the domain of the smallest eigenvalue of a symmetric matrix given as text.
/// The text is evaluated over double, so any dependence on the variables is taken. Over a polytope
/// the vertices are enough: the eigenvalue is concave in its variable. Over one interval see
/// local_minima; `known` gives data, parameters and unknowns. `rows`: units s of the rows, the
/// eigenvalue is that of diag(s) B diag(s); empty: of B.
Minima local_minima(const expr::Program& difference, const Domain& domain,
                    const numbers::Values& known, const numbers::Vector& rows = {});

/// (B + B') / 2 at a point that has values for all variables.
numbers::Matrix matrix_at(const expr::Program& difference, const Point& point,
                          const numbers::Values& known);

}  // namespace gainsmith::forall
