// The rate of an operation on matrices that has no formula on numbers.
#pragma once

#include "expr/program/number_type.h"
#include "numbers/matrix.h"

namespace gainsmith::numbers {

/// Whether block_slope has one.
bool has_block_slope(expr::Op op);

/// The derivative of an instruction in a direction: of `operands` the second half are the slopes of
/// the first. False: there is none.
///
/// Where singular values are equal, each has some rate between those that it has before and after;
/// where one is 0, its rate is 0.
bool block_slope(const expr::Instruction& instruction, expr::Operands<Matrix> operands,
                 Matrix& slope);

}  // namespace gainsmith::numbers
