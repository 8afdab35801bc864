// The derivatives of functions of numbers, compiled from the texts of their rows NUMBERS in
// operations.def. All that differentiates by formulas reads them here: programs (derivative.h),
// graphs of numbers and dual numbers (numbers/graph/partial_graph.h).
#pragma once

#include <cstddef>
#include <vector>

#include "expr/program/assembly.h"
#include "expr/program/operations.h"

namespace gainsmith::expr {

/// d f(a_0, a_1)/d a_k of an operation that has_derivatives(): a program over the 1 x 1 inputs "0"
/// and "1", its operands. It is compiled once.
const Program& partial_derivative(Op op, std::size_t k);

/// Adds it element by element: `operands` are those of the function `like`, all of its shape. Where
/// the result is.
int add_partial_derivative(Assembly& assembly, const Instruction& like, std::size_t k,
                           const std::vector<int>& operands);

}  // namespace gainsmith::expr
