// Internal to bind: the gains, and the products in their formulas that bounds are put on.
#pragma once

#include <string>
#include <vector>

#include "bind/binding.h"

namespace gainsmith::bind {

void bind_gains(Binding& binding);

/// The formula of a gain that a gain file brings, over the names of its design and the file's
/// coefficients.
expr::Program bind_gain_formula(const model::Instance& instance,
                                const std::vector<model::UnknownMatrix>& unknowns,
                                const std::string& text, const std::string& variable,
                                const Place& place);

}  // namespace gainsmith::bind
