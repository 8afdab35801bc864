// Op::flow_map: where a point is after it has been moved along a rate for some time.
//
//   z(0) = x,   dz/ds = e(z, t + s),   result z(d);      x, z r x c, d 1 x 1 of any sign
//
// by extrapolation (numerics/extrapolation.h) of dz/dq = d e(z, t + q d) over q in [0, 1]. A smooth
// e is integrated until the error of a step is within 16 units in the last place of z; where e has
// a kink or a jump the steps become short, and the error is some thousand units. No branch of e is
// passed over, however short it is taken.
//
// The slope of the result is that of the same equation in dual numbers (dual.h): with z' the slope
// of z, the variational equation
//
//   dz'/dq = d (de/dz z' + de/dp p' + de/dt (t' + q d')) + d' e,      p what else e depends on
//
// Across a boundary of e where e jumps, and which is reached sooner or later as something changes,
// there is none.
#pragma once

#include "expr/program/number_type.h"
#include "numbers/matrix.h"
#include "numbers/types/dual.h"

namespace gainsmith::numbers {

/// EvaluationError, with the time that was reached, where z escapes, e has no value, or the steps
/// become too short or too many.
template <class Scalar>
MatrixOf<Scalar> flow_map(const expr::Instruction& instruction,
                          expr::Operands<MatrixOf<Scalar>> operands);

/// The slope of `out`, which has its shape.
template <class Scalar>
void flow_map_slope(const expr::Instruction& instruction, expr::Operands<Dual<Scalar>> operands,
                    Dual<Scalar>& out);

}  // namespace gainsmith::numbers
