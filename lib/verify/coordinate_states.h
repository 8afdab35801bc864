// The same runs in the coordinates of the claims.
//
// Of linear sampled dynamics (linear/coordinates.h) errors of observers are states, and so is
// expm(-A*s)*e where it is constant along flows. Then rounding of what grows is no error of a claim,
// and states that no claim depends on rest: a run does not end because one of them diverges.
//
// The flow is that of the coordinates, x' = A x + b; the jump has one map a component. What is
// drawn stays in its place.
#pragma once

#include <vector>

#include "claims/claims.h"
#include "linear/coordinates.h"
#include "model/run_texts.h"

namespace gainsmith::verify {

/// Coordinates that are no states are variables behind the others, so that draws are the same. Signals
/// are left out. `claims`: those of the texts; the functions of the coordinates are their programs.
model::RunTexts with_coordinates(model::RunTexts texts, const linear::Coordinates& coordinates,
                                 const std::vector<claims::Claim>& claims);

}  // namespace gainsmith::verify
