// Dense matrices of a scalar type, under the names that the number types give them.
//
// The folder holds the number types over which programs are evaluated (expr/program/number_type.h),
// and the linear algebra that they need:
//   real.h               reals in double, 31 and 100 digits
//   dual.h, tangent.h    a value with its first derivatives (forward differentiation)
//   ball.h, enclosed.h   |true - mid| <= rad, every rounding included
//   enclosure.h          the number type over them
//   jet.h                balls with two derivatives over an interval
//   rational.h           fractions, without rounding;  rational_algebra.h  elimination over them
//   degree.h             constant, affine or neither, from the text of a program
//   scalar_graph.h       programs as operations on single numbers;  tape.h  run in double
//   range.h              intervals of doubles, for tapes
// Linear algebra: dense.h (double), wide_dense.h (31 and 100 digits), enclosed_functions.h (balls),
// definite.h (proofs that M > 0), spectrum.h (eigenvalues, equations of Riccati).
// What is said to be certain of a ball, a fraction or Sign::positive is a theorem on the given
// numbers. All others are values of floating-point arithmetic.
#pragma once

#include "numerics/matrix.h"

namespace gainsmith::numbers {

using numerics::is_finite;
using numerics::Matrix;
using numerics::MatrixOf;
using numerics::times;
using numerics::Vector;

}  // namespace gainsmith::numbers
