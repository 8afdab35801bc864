// Multipliers as a solver left them, in all their digits.
#pragma once

#include <vector>

#include "base/scalars.h"
#include "lmi/formulation.h"
#include "numbers/matrix.h"
#include "sdp/solution.h"

namespace gainsmith::verdict {

/// The multipliers of the rows that were solved, in 31 digits and balanced units, one a block of
/// the Lmi.
using Multipliers = std::vector<numbers::MatrixOf<DoubleDouble>>;

/// Of an interior solution.
Multipliers multipliers_of(const lmi::Formulation& formulation, std::size_t blocks,
                           const sdp::Solution& solution);
/// The same with all digits that the solution has.
std::vector<numbers::MatrixOf<Decimal100>> wide_multipliers_of(const lmi::Formulation& formulation,
                                                               std::size_t blocks,
                                                               const sdp::Solution& solution);

}  // namespace gainsmith::verdict
