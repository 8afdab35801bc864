// The number type "degree": how a value depends on the inputs that move, found from the text of the
// program and not from samples of it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "expr/program/number_type.h"

namespace gainsmith::numbers {

/// 0: constant; 1: affine; 2: not known to be affine.
using Degree = int;
constexpr Degree kNotAffine = 2;

/// Sums keep the largest degree, products add degrees, every other function of a moving value is
/// not affine. A constant has degree 0 and no operation fails.
struct DegreeAlgebra {
  using Value = Degree;
  void apply(const expr::Instruction& instruction, expr::Operands<Degree> operands,
             Degree& out) const;
};

/// The degree of each instruction, where the inputs named by `moves` have degree 1 and the others
/// 0. A call is constant when its argument is, and not affine otherwise.
std::vector<Degree> degrees(const expr::Program& program,
                            const std::function<bool(const std::string&)>& moves);

}  // namespace gainsmith::numbers
