// What excludes every solution: the certificates beside an interior solution, the cheapest first.
//
//   1. the solver's multipliers, exact in double            robustly infeasible
//   2. an eigenvalue on the wrong side, in fractions        on the boundary of the cone, as a rule
//   3. on the boundary, with x beside the multipliers       strict complementarity
//   4. the same of the least violation, one more program    constant parts, nearly singular in 1
//   5. multipliers alone, refined with steps in double      where those of 1 are nearly singular
//   6. the least violation again, by a scale              homogeneous, one scalar > 0 by itself
//   7. the solver's multipliers, exact in 31 digits         small programs
//   8. multipliers alone, refined with wide steps           whatever is left
// Steps 1 and 7 are all for a search that does not want more digits.
#pragma once

#include "design/attempt.h"

namespace gainsmith::design {

/// The first certificate that excludes every solution, or the best found (its backward error).
/// OutOfAllowance passes through.
verdict::Refutation find_certificate(const Posed& posed, const Effort& effort,
                                     const lmi::Formulation& formulation,
                                     const sdp::Solution& solution, const Solve& solve);

}  // namespace gainsmith::design
