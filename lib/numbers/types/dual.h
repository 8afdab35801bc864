// The number type "dual": a matrix with its derivatives in several directions.
//
//   f(x + e) = value + slope e + ...,  slope: elements of the value x directions
//
// Values are those of Real, bit for bit. Where a function has a corner the slope is that of the
// branch that the value takes: abs of 0 rises, max and min of equal ones take the first, the
// spectral norm the first pair of singular vectors. sign and floor are level everywhere.
//
// Where there is no derivative - the norm and the root of 0, singular values that are equal or 0,
// orth and null, pinv without full rank - the elements of the slope are not numbers, and `without`
// is the operation. They may still be left behind by index, max or where.
#pragma once

#include <memory>
#include <optional>

#include "expr/program/number_type.h"
#include "numbers/matrix.h"

namespace gainsmith::numbers {

template <class Scalar>
struct Dual {
  MatrixOf<Scalar> value;
  MatrixOf<Scalar> slope;  ///< elements column by column; without columns: it does not move
  std::optional<expr::Op> without;

  Eigen::Index rows() const { return value.rows(); }
  Eigen::Index cols() const { return value.cols(); }
  bool moves() const { return slope.cols() > 0; }
};

template <class Scalar>
Dual<Scalar> constant_dual(const MatrixOf<Scalar>& value);
/// Each element moves in a direction of its own.
template <class Scalar>
Dual<Scalar> variable_dual(const MatrixOf<Scalar>& value);

/// Dual arithmetic (expr/program/number_type.h). All values that move have as many directions.
template <class Scalar>
struct DualNumbers {
  using Value = Dual<Scalar>;
  void apply(const expr::Instruction& instruction, expr::Operands<Value> operands,
             Value& out) const;
};

/// The value of Op::jacobian. EvaluationError when there is no derivative, which names the
/// operation without.
template <class Scalar>
MatrixOf<Scalar> jacobian(const expr::Instruction& instruction,
                          expr::Operands<MatrixOf<Scalar>> operands);

/// The same again and again, of one instruction, which must outlive it.
template <class Scalar>
class JacobianEvaluator {
 public:
  explicit JacobianEvaluator(const expr::Instruction& instruction);
  JacobianEvaluator(JacobianEvaluator&&) noexcept;
  JacobianEvaluator& operator=(JacobianEvaluator&&) noexcept;
  ~JacobianEvaluator();

  MatrixOf<Scalar> operator()(expr::Operands<MatrixOf<Scalar>> operands);

 private:
  struct Kept;
  std::unique_ptr<Kept> kept_;
};

extern template class JacobianEvaluator<double>;
extern template Dual<double> constant_dual<double>(const Matrix&);
extern template Dual<double> variable_dual<double>(const Matrix&);
extern template struct DualNumbers<double>;
extern template Matrix jacobian<double>(const expr::Instruction&, expr::Operands<Matrix>);

}  // namespace gainsmith::numbers
