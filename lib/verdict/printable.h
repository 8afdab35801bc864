// Points whose printed decimals satisfy linear equations exactly.
//
// With x_i = X_i / 10^q_i, X_i whole numbers of so many digits, the equations of an affine space
// x = x_0 + N y are equations in whole numbers (numerics/lattice.h).
#pragma once

#include <optional>
#include <vector>

#include "verdict/faces.h"

namespace gainsmith::verdict {

/// Unknowns near the point of `y` with `digits` digits, at most 16, each, whose decimals as printed
/// are exactly in the space of `faces`; none when there are no such decimals. `units`: an x_i far
/// below its unit has as many decimals as one of a millionth of it.
std::optional<std::vector<double>> printable_point(const Faces& faces,
                                                   const std::vector<Rational>& y,
                                                   const std::vector<double>& units, int digits);

}  // namespace gainsmith::verdict
