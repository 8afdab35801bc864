// How far every inequality holds, recomputed in double from the matrices as they are written.
#pragma once

#include <vector>

#include "lmi/compile.h"
#include "model/gains.h"

namespace gainsmith::lmi {

/// One record for each comparison of each requirement. The smallest eigenvalue is taken over
///  - the vertices that were imposed, from the affine blocks, and
///  - for intervals, 33 equidistant points of the interval, from the text itself evaluated over
///  double,
/// so that a mistake in compiling the blocks shows up as a margin that does not hold. `scale` of a
/// homogeneous problem is the coefficients' size times the largest |x_i|. A strict inequality holds
/// when its smallest eigenvalue is positive, another when it is above -1e-11 times the largest
/// element of a term x_i B_i.
std::vector<model::Margin> margins(const model::Instance& instance, const Lmi& lmi,
                                   const std::vector<double>& scales, bool homogeneous,
                                   double required, const std::vector<double>& x);

}  // namespace gainsmith::lmi
