// The number type "rational": exact values of what is made of decimals by rational operations, in
// fractions of whole numbers of any length (GMP). Fractions of more than 4000 bits are refused.
//
// What has no rational value in general - roots, exponentials, norms, pi - throws EvaluationError,
// also where it has one, but for exp, expm, sin, cos and tanh of 0. An inverse that does not exist
// throws as in every number type.
#pragma once

#include <map>
#include <string>

#include "expr/program/number_type.h"
#include "expr/program/program.h"
#include "numbers/types/ball.h"
#include "numerics/rational_matrix.h"

namespace gainsmith::numbers {

using numerics::RationalMatrix;

/// Operations whose results are no fractions, but for a few operands.
constexpr bool is_irrational(expr::Op op) {
  using enum expr::Op;
  return is_without_bounds(op) ||
         is_one_of(op, {real_power, log, sqrt, atan2, norm, pseudo_inverse, singular_values,
                        range_basis, kernel_basis, complement_basis, jacobian});
}

/// The rules of expr/program/number_type.h. EvaluationError where an operation has no fraction, or
/// one that is too long.
struct RationalNumbers {
  using Value = RationalMatrix;

  void apply(const expr::Instruction& instruction, expr::Operands<Value> operands,
             Value& out) const;
};

using RationalValues = std::map<std::string, RationalMatrix, std::less<>>;

/// EvaluationError where an operation of the program has no fractions. Said before it is computed:
/// what others lead to may be long.
void require_fractions(const expr::Program& program);

/// Evaluates once. EvaluationError when an operation or an input has no value here.
RationalMatrix rational_value(const expr::Program& program, const RationalValues& values);

/// x in 31 digits, with a bound of its rounding: radius 0 where 31 digits hold x.
Ball<DoubleDouble> ball_of(const Rational& x);

/// The bits of the longest numerator or denominator; 0 of an empty matrix.
std::size_t most_bits(const RationalMatrix& x);

/// (X + X') / 2.
RationalMatrix rational_symmetric_part(const RationalMatrix& x);

}  // namespace gainsmith::numbers
