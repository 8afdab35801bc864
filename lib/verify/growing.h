// Why a claim is violated: what it reads grows by itself.
#pragma once

#include <string>

#include "claims/run_setup.h"

namespace gainsmith::verify {

/// The eigenvalue that grows most, of those whose modes change the value of the claim: of F of the
/// flow s' = F s + f, of J of the only event s+ = J s + j, or of J e^(F T) where its clock has one
/// length T. Empty where none grows, or the dynamics are of another kind.
std::string growing_mode(const claims::RunSetup& setup, const claims::Claim& claim);

}  // namespace gainsmith::verify
