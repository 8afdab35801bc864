// The inequalities of an instance as statements of sums of squares (sos/program.h).
#pragma once

#include <string>
#include <vector>

#include "lmi/inequalities.h"
#include "sos/program.h"

namespace gainsmith::design {

/// Whether an inequality is to be shown as a sum of squares: then all of them are.
bool has_sums_of_squares(const model::Design& design);

struct SosStatements {
  std::vector<sos::Statement> statements;
  /// Of each statement: the inequality, and its variables as they are written, "x(1)".
  std::vector<std::size_t> inequalities;
  std::vector<std::vector<std::string>> variables;
  std::vector<std::string> unknowns;  ///< "P(2,1)", by the numbers of the statements, from 1
  std::optional<sos::Polynomial> objective;
};

/// One for each comparison and each element of the sets that variables run over; comparisons of the
/// elements of a column one by one. InputError at its place for what is no polynomial, or not
/// affine in the unknowns, and for variables over a polytope.
SosStatements sos_statements(const lmi::Inequalities& of);

/// Whether all unknowns 0 satisfy everything: no part is without unknowns, and nothing is strict.
bool hold_at_zero(const SosStatements& stated);

}  // namespace gainsmith::design
