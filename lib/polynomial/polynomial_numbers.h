// The number type "polynomial": matrices of polynomials in the variables of `forall`, affine in the
// unknowns, without rounding.
//
// Sums, products, whole powers, quotients by numbers, blocks, parts, transposes, traces and
// jacobians of what moves are polynomials. Everything may be done to numbers that has a fraction
// (numbers/types/rational.h). All else throws EvaluationError with what makes a polynomial of it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "expr/program/number_type.h"
#include "numbers/matrix.h"
#include "numbers/types/rational.h"
#include "polynomial/polynomial.h"

template <>
struct Eigen::NumTraits<gainsmith::polynomial::Polynomial>
    : gainsmith::WideTraits<gainsmith::polynomial::Polynomial, 100> {};

namespace gainsmith::polynomial {

using PolynomialMatrix = numbers::MatrixOf<Polynomial>;

struct PolynomialNumbers {
  using Value = PolynomialMatrix;

  /// The names of the unknowns, from 1 on, for messages: not null where unknowns occur. The list
  /// must outlive this.
  const std::vector<std::string>* unknowns = nullptr;

  /// EvaluationError for a product of unknowns, a power above 100 and all that is no polynomial.
  void apply(const expr::Instruction& instruction, expr::Operands<Value> operands,
             Value& out) const;
};

using PolynomialValues = std::map<std::string, PolynomialMatrix, std::less<>>;

/// EvaluationError at its place for what is no polynomial, or has an input without a value.
PolynomialMatrix polynomial_value(const expr::Program& program, const PolynomialValues& values,
                                  const std::vector<std::string>& unknowns);

/// Polynomials of degree 0, without unknowns.
PolynomialMatrix polynomial_matrix(const numbers::RationalMatrix& numbers);

}  // namespace gainsmith::polynomial
