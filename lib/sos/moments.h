// What moments show: multipliers y of the equations for which
//   X_j = sum_i y_i F_ij >= 0   for each Gram matrix Q_j,
// F_ij its coefficients in equation i with the value c_i. For all solutions 0 <= sum_j X_j . Q_j =
// c'y, so c'y < 0 excludes them, and c'y = 0 does where X_j is not 0 at a constant of a strict
// inequality. Where sum_i y_i F_ij + D_j >= 0, D the coefficients of an objective, this is at least
// -c'y. All in fractions.
#pragma once

#include <optional>
#include <vector>

#include "sos/solve.h"

namespace gainsmith::sos {

/// A multiplier for each equation of a semidefinite program, in its order.
using Moments = std::vector<Rational>;

/// The same of the equations of the program, before unknowns were eliminated, without zeros.
std::map<Key, Rational> of_monomials(const std::vector<Equation>& equations,
                                     const Eliminated& eliminated, const Semidefinite& posed,
                                     const Moments& y);

/// Those near x, where they show that there are no solutions.
std::optional<Moments> excluding_moments(const Program& program, const Eliminated& eliminated,
                                         const Semidefinite& posed, const std::vector<double>& x);

/// The greatest lower bound of an objective that multipliers x + e `inside` show, e small: `inside`
/// are those of a solution without objective, whose X_j are far from singular.
std::optional<Rational> lower_bound(const Program& program, const Eliminated& eliminated,
                                    const Semidefinite& posed, const Equation& objective,
                                    const std::vector<double>& x,
                                    const std::vector<double>& inside);

}  // namespace gainsmith::sos
