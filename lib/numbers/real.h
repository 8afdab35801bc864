// The number type double: one matrix of doubles a value.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <utility>

#include "expr/evaluate.h"
#include "expr/program.h"
#include "expr/scope.h"
#include "numbers/matrix.h"

namespace gainsmith::numbers {

struct RealAlgebra {
  using Value = Matrix;

  /// EvaluationError for a singular inverse (reciprocal condition below 1e-15), a division by zero,
  /// the logarithm or root of a negative number, and any result that is not finite.
  void apply(const expr::Instruction& instruction, std::span<const Matrix* const> operands,
             Matrix& out) const;
};

/// Named matrices: data, parameters, gains, values of unknowns.
using Values = std::map<std::string, Matrix, std::less<>>;

/// Evaluates once. InputError when an operation fails; std::logic_error when an input has no value.
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

 private:
  Values values_;
};

/// The number of singular values above tolerance * the largest one; tolerance < 0 stands for
/// max(rows, cols) * 2^-52.
int numerical_rank(const Matrix& matrix, double tolerance = -1);

}  // namespace gainsmith::numbers
