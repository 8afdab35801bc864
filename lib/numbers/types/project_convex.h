// Op::project_convex: the nearest point of { z : c(z) <= 0 } in a metric
// (numerics/convex_projection.h), with the body of the instruction for c.
//
// c is evaluated in the working arithmetic (numerics/working.h), with its derivatives by dual
// numbers. An element that is below 0 at a point without a derivative does not count there.
#pragma once

#include "expr/program/number_type.h"
#include "numbers/matrix.h"
#include "numbers/types/dual.h"

namespace gainsmith::numbers {

/// numerics::NoProjection, also where c has no value at x, or no derivative where it is not below
/// 0.
template <class Scalar>
MatrixOf<Scalar> project_convex(const expr::Instruction& instruction,
                                expr::Operands<MatrixOf<Scalar>> operands);

/// The slope of `out`, which has its shape.
template <class Scalar>
void project_convex_slope(const expr::Instruction& instruction,
                          expr::Operands<Dual<Scalar>> operands, Dual<Scalar>& out);

}  // namespace gainsmith::numbers
