// A gain of a static output feedback, as far as local searches find one.
//
//   minimise over F  the largest real part of eig(A + B F C), in discrete time the largest modulus
//
// The function has kinks where two eigenvalues are the largest. BFGS with a line search for the
// weak Wolfe conditions goes along them (J. V. Burke, D. Henrion, A. S. Lewis, M. L. Overton,
// "HIFOO - a MATLAB package for fixed-order controller design", ROCOND 2006; A. S. Lewis,
// M. L. Overton, "Nonsmooth optimization via quasi-Newton methods", Math. Programming 141, 2013).
// It begins at F = 0, then at up to 99 evenly spread gains of several sizes, until one has a
// margin. Nothing is promised of the gain. The same matrices give the same bits.
#pragma once

#include "numerics/matrix.h"

namespace gainsmith::numerics {

enum class Time { continuous, discrete };

/// F, m x p, of A, n x n, B, n x m, and C, p x n: the best that was found. Zero where one of the
/// sizes is 0, and where elements are not finite.
Matrix output_gain(const Matrix& A, const Matrix& B, const Matrix& C, Time time);

}  // namespace gainsmith::numerics
