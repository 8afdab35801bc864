// Certificates on the boundary of the cone, from multipliers that are only nearly one.
#pragma once

#include "lmi/scale.h"
#include "verdict/refutation.h"

namespace gainsmith::verdict {

/// What multipliers near those of an interior solution say in 100 digits, made with the solution
/// beside them so that they have no residual (boundary_pair.h). The solution may be one in double.
/// The functions of this file need the pair (x, Y) in 100 digits by boundary_pair.h, and return a
/// Refutation that says nothing (an error of 1) where it does not settle.
Refutation refute_on_boundary(const lmi::Inequalities& of, const lmi::Lmi& lmi,
                              const lmi::Formulation& formulation, const sdp::Solution& solution);

/// The same of the least violation: a formulation and its solution by formulate_violation().
Refutation refute_by_violation(const lmi::Inequalities& of, const lmi::Lmi& lmi,
                               const lmi::Formulation& formulation, const sdp::Solution& solution);

/// The same of homogeneous inequalities, by the formulation and solution of scaled(lmi, scale).
Refutation refute_by_violation(const lmi::Inequalities& of, const lmi::Lmi& lmi,
                               const lmi::Scale& scale, const lmi::Formulation& formulation,
                               const sdp::Solution& solution);

}  // namespace gainsmith::verdict
