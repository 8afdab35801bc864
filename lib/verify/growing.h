// Why claims are violated: what they read grows by itself.
#pragma once

#include <string>

#include "claims/run_setup.h"

namespace gainsmith::verify {

/// The eigenvalue that grows most of what the stated claims read: of F of the flow s' = F s + f,
/// of J of the only event s+ = J s + j, or of J e^(F T) of both, T the longest length of its clock.
/// Empty where none grows, or the dynamics are of another kind.
std::string growing_mode(const claims::RunSetup& setup);

}  // namespace gainsmith::verify
