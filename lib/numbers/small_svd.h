// Internal to numbers: the singular values of a matrix of doubles without allocation.
#pragma once

#include "numbers/matrix.h"

namespace gainsmith::numbers {

/// Writes the min(rows, cols) singular values of M, largest first. False, for them to be found
/// otherwise: M is larger than 8 x 8, or an element is not finite.
///
/// Jacobi: of a symmetric M rotations of rows and columns leave the eigenvalues; of any other
/// one-sided rotations make the columns orthogonal, and their lengths are the singular values. They
/// are those of a matrix M + E with |E| of some units in the last place of |M| (Demmel, Veselic,
/// "Jacobi's method is more accurate than QR", 1992).
bool small_singular_values(const Matrix& M, double* out);

/// The rates u' dM v of the singular values, in their order: u = M v / |M v|, with one-sided
/// rotations. That of a value of 0 is 0. False as above.
bool small_singular_slopes(const Matrix& M, const Matrix& dM, double* out);

}  // namespace gainsmith::numbers
