// Op::flow_map (flow_map.h) along a rate that is affine in the state,
//
//   e(z) = A z + b:   z(d) = E x + V b,   [E V; 0 I] = exp(d [A I; 0 0])
//
// as a program of its operands with an exponential in place of an integration. x, b n x 1, A, E, V
// n x n; V = int_0^d exp(A s) ds (Van Loan, IEEE Trans. Automatic Control 23, 1978).
#pragma once

#include <optional>

#include "expr/program/program.h"

namespace gainsmith::numbers {

/// Its inputs are the operands in their order. None where the rate depends on the time, or is not
/// affine in the state x (n x 1) by its text.
std::optional<expr::Program> affine_flow_map(const expr::Instruction& flow_map);

}  // namespace gainsmith::numbers
