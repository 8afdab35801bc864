// Internal to bind: the gains, and the products in their formulas that bounds are put on.
//
// For a product inv(S) E with a symmetric unknown S a further scalar s and the inequalities
//
//   S >= s I,   [S, E/beta; E'/beta, s I] >= 0
//
// give E' inv(S) E <= beta^2 s I and s <= lambda_min(S). So the largest singular value of inv(S) E
// is at most beta, whatever the scale of the unknowns. The condition is sufficient, not necessary.
// Binding finds the products; the inequalities are made in lmi/gain_bounds.h.
#pragma once

#include <string>
#include <vector>

#include "bind/binding.h"

namespace gainsmith::bind {

/// Adds the gains of a design, and their names to the scopes running and results. A gain is a
/// matrix, or a function of a number where it has a variable.
void bind_gains(Binding& binding);

/// The formula of a gain that a gain file brings, over the names of its design and the file's
/// coefficients.
expr::Program bind_gain_formula(const model::Instance& instance,
                                const std::vector<model::UnknownMatrix>& unknowns,
                                const std::string& text, const std::string& variable,
                                const Place& place);

}  // namespace gainsmith::bind
