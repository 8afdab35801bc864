// What excludes every solution: the certificates beside an interior solution, the cheapest first.
//
//   1. the solver's multipliers, exact in double            robustly infeasible
//   2. an eigenvalue on the wrong side, in fractions        on the boundary of the cone, as a rule
//   3. on the boundary, with x beside the multipliers       strict complementarity
//   4. the same of the least violation, one more program    constant parts, nearly singular in 1
//   5. the least violation again, by a scale                homogeneous, one scalar > 0 by itself
//   6. the solver's multipliers, exact in 31 digits         small programs
// Steps 1 and 6 are all for a search that does not want more digits, and where the largest margin
// is above 1e-6. Where the verdict alone is asked for, step 2 is left out.
//
// Multipliers inside the cone are exact if r' H^-1 r < 1 (verdict/exactness.h); on its boundary
// they are made so by an eigenvalue (verdict/algebraic_multipliers.h) or as a pair with x
// (verdict/boundary_pair.h).
#pragma once

#include "design/attempt.h"

namespace gainsmith::design {

/// The first certificate that excludes every solution, or the best found (its backward error).
/// OutOfAllowance passes through.
verdict::Refutation find_certificate(const Posed& posed, const Effort& effort,
                                     const lmi::Formulation& formulation,
                                     const sdp::Solution& solution, const Solve& solve);

}  // namespace gainsmith::design
