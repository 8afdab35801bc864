// The margin that has no units: how far a symmetric matrix M is from not being positive definite,
// with its diagonal as the measure.
#pragma once

#include "numbers/matrix.h"

namespace gainsmith::lmi {

/// The smallest eigenvalue of D^-1/2 M D^-1/2, D = diag(M): in (0, 1] when M > 0, the same for S M
/// S with any diagonal S > 0, and within a factor n of the best that a diagonal scaling can give
/// (van der Sluis 1969). Of a 1 x 1 matrix > 0 it is 1. When M has a diagonal element <= 0: that
/// element over the largest |element| of its row, or -1 for one that is not finite; at most 0.
double correlation_margin(const numbers::Matrix& M);

}  // namespace gainsmith::lmi
