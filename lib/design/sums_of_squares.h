// Gains from inequalities that are shown as sums of squares: p(x) = b(x)' Q b(x), Q >= 0, with b a
// vector of monomials (Parrilo 2000); on a set g_i(x) >= 0 with multipliers that are sums of
// squares themselves (Putinar 1993). Identities and moments are in fractions (sos/program.h).
#pragma once

#include "design/semidefinite_program.h"
#include "lmi/inequalities.h"
#include "model/gains.h"
#include "sdp/solver.h"

namespace gainsmith::design {

/// The verdict, with its unknowns and margins.
///     yes   an identity in fractions shows each inequality at the decimals of the unknowns
///     no    no unknowns make them sums of squares of these degrees: by the equations
///           themselves, or by moments in fractions
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
