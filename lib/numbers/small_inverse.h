// Internal to numbers: the inverse of a matrix of doubles without allocation.
#pragma once

#include "numbers/matrix.h"

namespace gainsmith::numbers {

/// Writes the inverse of M, column by column, as inverse() of dense.h finds it, up to rounding.
/// False, for it to be asked: M is larger than 8 x 8, or its reciprocal condition is below 2^-25.
bool small_inverse(const Matrix& M, double* out);

}  // namespace gainsmith::numbers
