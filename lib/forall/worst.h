// Where an inequality holds least, the unknowns fixed: the local minima over t of the smallest
// eigenvalue of B(t), from which an exchange grows.
#pragma once

#include <vector>

#include "expr/program/program.h"
#include "forall/domain.h"

namespace gainsmith::forall {

struct Minimum {
  double value = 0;  ///< the smallest eigenvalue, as measured
  Point point;       ///< values of all variables
};

/// Of diag(s) B diag(s): s the given units of the rows (empty: 1), or those in which the diagonal
/// is 1, where it is positive (lmi/correlation.h).
enum class Measure { eigenvalue, margin };

/// The local minima over the domain, the smallest first, of the smallest eigenvalue of a symmetric
/// matrix given as text.
/// The text is evaluated over double, so any dependence on the variables is taken. Over a polytope
/// the vertices are enough: the eigenvalue is concave in its variable. Over one interval see
/// local_minima; `known` gives data, parameters and unknowns, `rows` the units of the rows.
std::vector<Minimum> local_minima(const expr::Program& difference, const Domain& domain,
                                  const numbers::Values& known, const numbers::Vector& rows = {},
                                  Measure measure = Measure::eigenvalue);

/// (B + B') / 2 at a point that has values for all variables.
numbers::Matrix matrix_at(const expr::Program& difference, const Point& point,
                          const numbers::Values& known);

}  // namespace gainsmith::forall
