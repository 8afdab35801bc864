#include "bounded/ball.h"

#include "base/stop.h"
#include "bounded/ball_rules.h"

namespace gainsmith::bounded {

using Eigen::Index;
using numbers::Matrix;
using numbers::MatrixOf;

template <class Scalar>
Ball<Scalar> ball_of(const numbers::MatrixOf<Decimal100>& exact) {
  Ball<Scalar> ball{MatrixOf<Scalar>(exact.rows(), exact.cols()),
                    Matrix::Zero(exact.rows(), exact.cols())};
  for (Index e = 0; e < exact.size(); ++e) {
    ball.mid(e) = as<Scalar>(exact(e));
    if (as<Decimal100>(ball.mid(e)) != exact(e))
      ball.rad(e) = 2 * unit_roundoff<Scalar>() * size_of(ball.mid(e));
  }
  return ball;
}

template <class Scalar>
Ball<Scalar> exact_ball(const numbers::Matrix& matrix) {
  return {matrix.cast<Scalar>(), Matrix::Zero(matrix.rows(), matrix.cols())};
}

template <class Scalar>
void BallAlgebra<Scalar>::apply(const expr::Instruction& instruction,
                                expr::Operands<Value> operands, Value& out) const {
  check_stop();
  expr::dispatch(rules::BallRules<Scalar>{}, instruction, operands, out);
  using std::isfinite;
  for (Index e = 0; e < out.mid.size(); ++e)
    if (!isfinite(out.mid(e))) expr::fault::not_finite(instruction.op);
}

template struct BallAlgebra<double>;
template struct BallAlgebra<DoubleDouble>;
template Ball<double> ball_of<double>(const numbers::MatrixOf<Decimal100>&);
template Ball<DoubleDouble> ball_of<DoubleDouble>(const numbers::MatrixOf<Decimal100>&);
template Ball<double> exact_ball<double>(const numbers::Matrix&);
template Ball<DoubleDouble> exact_ball<DoubleDouble>(const numbers::Matrix&);

}  // namespace gainsmith::bounded
