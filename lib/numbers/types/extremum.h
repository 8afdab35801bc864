// The value of Op::extremum: maximum(f, x in [a, b], ...) and minimum.
//
// It is f at the point of the box that largest_over_box (numerics/box_search.h) finds for f or -f
// in double: an estimate, from below of a maximum and from above of a minimum. Over more digits f
// is evaluated at that point, whose coordinates at an end of the box are that end in all its
// digits.
#pragma once

#include "expr/program/number_type.h"
#include "numbers/matrix.h"

namespace gainsmith::numbers {

/// EvaluationError for an empty box, and where f has no value at a point of the box, which is
/// named.
template <class Scalar>
MatrixOf<Scalar> extremum(const expr::Instruction& instruction,
                          expr::Operands<MatrixOf<Scalar>> operands);

extern template Matrix extremum<double>(const expr::Instruction&, expr::Operands<Matrix>);

}  // namespace gainsmith::numbers
