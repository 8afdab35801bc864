// Internal to lmi: the units that a bound on a gain is meant in when nobody states it.
#pragma once

#include <vector>

#include "lmi/affine.h"

namespace gainsmith::lmi {

/// T S T and T E U for S (n x n) and E (n x k), with powers of two T and U for which the elements
/// of both are near 1 when unknown i is of the size 2^units[i - 1]. Where S is no unknown it stays
/// the identity; where it is not symmetric it becomes T S V with another diagonal V. With other
/// units of the problem, by powers of two, the same numbers come out.
void bring_to_units(AffineForm& S, AffineForm& E, bool is_unknown, const std::vector<int>& units);

}  // namespace gainsmith::lmi
