// Points at which an inequality between polynomials is false.
#pragma once

#include <optional>
#include <vector>

#include "sos/program.h"

namespace gainsmith::sos {

struct Counterexample {
  std::vector<Rational> x;  ///< the variables
  std::vector<Rational> v;  ///< of a matrix: v'M(x)v < 0; {1} of a polynomial
  Rational value = 0;       ///< v'M(x)v
};

/// One of a statement without unknowns, by descent from 100 points that are drawn, in fractions. A
/// search: none found says nothing. None is looked for where the variables satisfy equations.
std::optional<Counterexample> find_counterexample(const Statement& statement);

}  // namespace gainsmith::sos
