// The number type "real": one matrix of real scalars a value. For double, and for the scalars of
// base/scalars.h (31 and 100 decimal digits). Errors are not bounded: enclosure.h does that. The
// rules are in real_rules.h, instantiated by one source a scalar.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>

#include "expr/binding/scope.h"
#include "expr/program/evaluate.h"
#include "expr/program/program.h"
#include "numbers/matrix.h"

namespace gainsmith::numbers {

/// EvaluationError for a singular inverse (its reciprocal condition in the 1-norm is about epsilon;
/// for double 1e-15), a division by zero, the logarithm or root of a negative number, and any
/// result that is not finite. Decimals are rounded to the scalar from their text.
template <class Scalar>
struct Real {
  using Value = MatrixOf<Scalar>;

  void apply(const expr::Instruction& instruction, expr::Operands<Value> operands,
             Value& out) const;
};

using RealAlgebra = Real<double>;

/// Matrices by the names of inputs: data, parameters, gains, values of unknowns.
template <class Scalar>
using ValuesOf = std::map<std::string, MatrixOf<Scalar>, std::less<>>;
using Values = ValuesOf<double>;

/// Evaluates once. EvaluationError when an operation fails; std::logic_error when an input has no
/// value.
template <class Scalar>
MatrixOf<Scalar> evaluate(const expr::Program& program, const ValuesOf<Scalar>& values);
Matrix evaluate(const expr::Program& program, const Values& values);

/// rows x columns.
inline expr::Shape shape_of(const Matrix& matrix) {
  return {static_cast<int>(matrix.rows()), static_cast<int>(matrix.cols())};
}

/// What binding asks of values, from values in double.
class KnownDoubles : public expr::KnownValues {
 public:
  explicit KnownDoubles(Values values) : values_(std::move(values)) {}

  double number(const expr::Program& program) const override;
  int rank(const expr::Program& matrix, const expr::Program* tolerance) const override;
  std::vector<int> units(const expr::Program& A, const expr::Program& C) const override;
  std::vector<double> output_gain(const expr::Program& A, const expr::Program& B,
                                  const expr::Program& C, bool discrete) const override;

 private:
  Values values_;
};

/// The number of singular values above tolerance * the largest one; tolerance < 0 means
/// max(rows, cols) * 2^-52. 0 of an empty matrix.
int numerical_rank(const Matrix& matrix, double tolerance = -1);

extern template struct Real<double>;
extern template Matrix evaluate<double>(const expr::Program&, const Values&);

}  // namespace gainsmith::numbers
