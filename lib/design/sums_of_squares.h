// Gains from inequalities that are shown as sums of squares.
#pragma once

#include "design/semidefinite_program.h"
#include "lmi/inequalities.h"
#include "model/gains.h"
#include "sdp/solver.h"

namespace gainsmith::design {

/// The verdict, with its unknowns and margins.
///   yes        an identity in fractions shows each inequality at the decimals of the unknowns
///   no         no unknowns make them sums of squares of these degrees: by the equations themselves,
///              or by moments in fractions
/// Of an objective the point is one near the least value, at which the identities hold; the lower
/// bound, by moments in fractions, is of sums of squares of these degrees.
void solve_sums_of_squares(const lmi::Inequalities& inequalities, const sdp::Options& options,
                           model::Gains& gains);

/// The same at unknowns that are given: whether all inequalities are sums of squares there.
void check_sums_of_squares(const lmi::Inequalities& inequalities, const std::vector<double>& x,
                           const sdp::Options& options, model::Gains& gains);

/// What the solver is first asked.
SemidefiniteProgram program_of_sums_of_squares(const lmi::Inequalities& inequalities);

}  // namespace gainsmith::design
