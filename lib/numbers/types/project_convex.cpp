#include "numbers/types/project_convex.h"

#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/number.h"
#include "expr/program/evaluate.h"
#include "numerics/convex_projection.h"

namespace gainsmith::numbers {

namespace {

/// The body as functions of z, n x 1, with derivatives by the n elements of z and by q directions
/// in which what else it depends on moves: slopes are m x (n + q).
template <class W>
class ConvexBody {
 public:
  using M = MatrixOf<W>;

  /// `others`: of the operands from the third on, with q columns each or none.
  ConvexBody(const expr::Instruction& instruction, std::vector<Dual<W>> others, Eigen::Index q)
      : others_(std::move(others)), directions_(q), evaluator_(*instruction.body) {
    const Eigen::Index n = instruction.shape.rows;
    z_.slope = M::Identity(n, n + q);
    for (std::size_t k = 0; k < others_.size(); ++k) {
      Dual<W>& other = others_[k];
      if (other.moves()) {
        M slope = M::Zero(other.value.size(), n + q);
        slope.rightCols(q) = other.slope;
        other.slope = slope;
      }
      evaluator_.fix("operand " + std::to_string(k + 2), other);
    }
    evaluator_.set("the variable", z_);
  }
  ConvexBody(const ConvexBody&) = delete;
  ConvexBody& operator=(const ConvexBody&) = delete;

  /// NoProjection where c has no value at z, or no derivative in an element that is not below 0.
  numerics::Tangents<W> operator()(const M& z) {
    z_.value = z;
    const Dual<W>& c = value();
    numerics::Tangents<W> result{c.value, M::Zero(c.value.size(), z.size() + directions_)};
    if (!c.moves()) return result;
    for (Eigen::Index i = 0; i < c.value.size(); ++i) {
      if (c.slope.row(i).allFinite())
        result.slope.row(i) = c.slope.row(i);
      else if (c.value(i) >= W(0))
        throw numerics::NoProjection(
            (c.without ? "the " + expr::to_string(*c.without) + " has no derivative"
                       : std::string("the derivative is not a finite number")) +
            at_point());
    }
    return result;
  }

 private:
  /// A fault of the evaluation as NoProjection, with the point.
  const Dual<W>& value() {
    try {
      return evaluator_.run();
    } catch (const expr::EvaluationError& error) {
      throw numerics::NoProjection(error.message() + at_point());
    }
  }

  /// ", at [1; 2]"
  std::string at_point() const {
    std::string text;
    for (const W& element : z_.value.reshaped())
      text += (text.empty() ? ", at [" : "; ") + brief(static_cast<double>(element));
    return text + "]";
  }

  std::vector<Dual<W>> others_;
  Eigen::Index directions_;
  Dual<W> z_;
  expr::Evaluator<DualNumbers<W>> evaluator_;
};

}  // namespace

/// Operands: x, n x 1, P, n x n, then what else c depends on.
template <class Scalar>
MatrixOf<Scalar> project_convex(const expr::Instruction& instruction,
                                expr::Operands<MatrixOf<Scalar>> operands) {
  using W = numerics::Working<Scalar>;
  std::vector<Dual<W>> others;
  for (const MatrixOf<Scalar>* operand : operands.subspan(2))
    others.push_back(constant_dual<W>(numerics::widened<Scalar>(*operand)));
  ConvexBody<W> body(instruction, std::move(others), 0);
  return numerics::project_convex<Scalar>(*operands[0], *operands[1], std::ref(body)).point;
}

/// By the optimality conditions at the point (slope_of_projection of numerics). An operand whose
/// slope is not a number passes that on.
template <class Scalar>
void project_convex_slope(const expr::Instruction& instruction,
                          expr::Operands<Dual<Scalar>> operands, Dual<Scalar>& out) {
  using W = numerics::Working<Scalar>;
  const Eigen::Index q = out.slope.cols();
  for (const Dual<Scalar>* operand : operands)
    if (!operand->slope.allFinite()) {
      out.without = operand->without;
      out.slope.setConstant(std::numeric_limits<Scalar>::quiet_NaN());
      return;
    }
  std::vector<Dual<W>> others;
  for (const Dual<Scalar>* operand : operands.subspan(2))
    others.push_back(
        {numerics::widened<Scalar>(operand->value), numerics::widened<Scalar>(operand->slope), {}});
  ConvexBody<W> body(instruction, std::move(others), q);
  const auto slope_of = [&](const Dual<Scalar>& dual) -> MatrixOf<W> {
    if (!dual.moves()) return MatrixOf<W>::Zero(dual.value.size(), q);
    return numerics::widened<Scalar>(dual.slope);
  };
  const Dual<Scalar>& x = *operands[0];
  const Dual<Scalar>& P = *operands[1];
  const auto found = numerics::project_convex<Scalar>(x.value, P.value, std::ref(body));
  out.slope = numerics::narrowed<Scalar>(numerics::slope_of_projection<Scalar>(
      found, x.value, P.value, slope_of(x), slope_of(P), std::ref(body)));
}

#define GAINSMITH_PROJECTIONS(S)                                                                 \
  template MatrixOf<S> project_convex<S>(const expr::Instruction&, expr::Operands<MatrixOf<S>>); \
  template void project_convex_slope<S>(const expr::Instruction&, expr::Operands<Dual<S>>,       \
                                        Dual<S>&);
GAINSMITH_FOR_EACH_SCALAR(GAINSMITH_PROJECTIONS)
#undef GAINSMITH_PROJECTIONS

}  // namespace gainsmith::numbers
