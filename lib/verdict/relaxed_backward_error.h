// What a solution in double excludes of the program that was solved.
#pragma once

#include "lmi/formulation.h"
#include "sdp/solution.h"

namespace gainsmith::verdict {

/// The backward error of an interior solution for the blocks as they were solved, gain bounds and
/// corners of boxes included, in double: what it excludes is only sufficient for the inequalities.
/// The largest |r_i| / W_i (refutation.h), r_0 only where v < 0; the best over several choices of
/// which small multipliers count. At most 1, which says nothing. It has no bound of its rounding.
double relaxed_backward_error(const lmi::Lmi& lmi, const lmi::GainBounds& bounds,
                              const lmi::Formulation& formulation, const sdp::Solution& solution);

}  // namespace gainsmith::verdict
