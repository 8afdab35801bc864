// The number type "exact affine form": matrices that are affine in the unknown scalars x_1 ... x_m,
//   M(x) = sum over i of x_i M_i,   x_0 = 1,
// whose coefficients are sparse and carry bounds of their errors. What an affine form
// (lmi/affine.h) is to a solver, this is to a check: nothing goes through double, and the
// coefficients of all unknowns come out of one evaluation.
#pragma once

#include <utility>
#include <vector>

#include "expr/program/number_type.h"
#include "lmi/unknowns.h"
#include "numbers/types/enclosed.h"

namespace gainsmith::verdict {

/// One element of a matrix: |true - mid| <= rad.
template <class S>
struct ExactElement {
  int row = 0;
  int column = 0;
  S mid{0};
  double rad = 0;

  numbers::Ball<S> ball() const { return {mid, rad}; }
};

/// The elements other than 0, in the order of columns, then rows.
template <class S>
using ExactElements = std::vector<ExactElement<S>>;

/// Of shape.rows x shape.cols elements. A constant is kept dense in `number`, and `terms` is empty.
template <class S>
struct ExactForm {
  expr::Shape shape;  ///< that of M(x)
  bool constant = true;
  numbers::Enclosed<S> number;  ///< of a constant
  /// (i, M_i) of what is not constant, in the order of i; zeros are left out.
  std::vector<std::pair<int, ExactElements<S>>> terms;
};

template <class S>
ExactForm<S> exact_constant(numbers::Enclosed<S> number);
/// The terms of any form, constant or not.
template <class S>
std::vector<std::pair<int, ExactElements<S>>> terms_of(const ExactForm<S>& form);
/// The unknown matrix itself.
template <class S>
ExactForm<S> exact_unknown(const lmi::Unknown& unknown);

/// Arithmetic under the contract of expr/program/number_type.h: the operations that AffineAlgebra
/// has for what has an unknown. EvaluationError for all others.
template <class S>
struct ExactAlgebra {
  using Value = ExactForm<S>;

  void apply(const expr::Instruction& instruction, expr::Operands<Value> operands,
             Value& out) const;
};

}  // namespace gainsmith::verdict
