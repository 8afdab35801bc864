// The problem in mathematics: data, unknowns, inequalities, gains.
#pragma once

#include <string>

#include "model/gains.h"
#include "page/notation.h"

namespace gainsmith::page {

/// What is given: data with their values, parameters with those of the result, definitions.
std::string given(const model::Problem& problem, const model::Gains& gains,
                  const Notation& notation);

/// What is wanted: unknowns, inequalities with what they hold for, the objective, gains.
std::string wanted(const model::Problem& problem, const Notation& notation);

/// What a requirement holds for: "for all τ ∈ [0, T_2], i = 1, …, N"; empty for one without.
std::string holds_for(const model::Requirement& requirement, const Notation& notation);

}  // namespace gainsmith::page
