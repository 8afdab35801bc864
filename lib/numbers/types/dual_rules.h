// Internal to numbers: the slopes of DualNumbers, instantiated by one source a scalar.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "expr/program/evaluate.h"
#include "numbers/dense/determinant.h"
#include "numbers/dense/householder.h"
#include "numbers/graph/partial_graph.h"
#include "numbers/types/dual.h"
#include "numbers/types/flow_map_rules.h"
#include "numbers/types/project_convex.h"
#include "numbers/types/real_rules.h"
#include "numbers/types/tangent.h"

namespace gainsmith::numbers {

/// At least one operand moves; `out` has its value, and a slope of the right shape, all zero.
template <class Scalar>
struct DualRules {
  using Value = Dual<Scalar>;
  using M = MatrixOf<Scalar>;
  using At = expr::Step<Value>;
  using Op = expr::Op;
  using Base = Foundation<Scalar>;
  template <Op op>
  using Is = expr::Is<op>;

  template <Op op>
  requires expr::OneOf<op, Op::add, Op::subtract>
  void operator()(Is<op>, const At& at, Value& out) const {
    if (at[0].moves()) out.slope = at[0].slope;
    if (!at[1].moves()) return;
    if (op == Op::add) {
      out.slope += at[1].slope;
    } else {
      out.slope -= at[1].slope;
    }
  }
  void operator()(Is<Op::negate>, const At& at, Value& out) const { out.slope = -at[0].slope; }
  void operator()(Is<Op::blocks>, const At& at, Value& out) const {
    for_each_block(at, [&](Eigen::Index row, Eigen::Index column, const Value& part) {
      place(part, out, row, column);
    });
  }
  void operator()(Is<Op::index>, const At& at, Value& out) const {
    const Eigen::Index rows = out.value.rows(), height = at[0].value.rows();
    for (Eigen::Index j = 0; j < out.value.cols(); ++j)
      out.slope.middleRows(j * rows, rows) =
          at[0].slope.middleRows((at.attribute(2) + j) * height + at.attribute(0), rows);
  }
  /// Linear as well, direction by direction.
  template <Op op>
  requires expr::OneOf<op, Op::fill, Op::identity, Op::transpose, Op::trace, Op::diagonal_matrix,
                       Op::diagonal_of>
  void operator()(Is<op>, const At& at, Value& out) const {
    M slope, result;
    const M* operands[] = {&slope};
    each_direction(out, [&](Eigen::Index d) {
      slope = direction(at[0], d);
      expr::dispatch(RealRules<Scalar>{}, at.instruction, expr::Operands<M>(operands), result);
      return result;
    });
  }
  template <Op op>
  requires expr::OneOf<op, Op::constant, Op::zeros>
  void operator()(Is<op>, const At&, Value&) const {}

  void operator()(Is<Op::multiply>, const At& at, Value& out) const {
    if (is_zero(at[0]) || is_zero(at[1])) return rest(out);
    if (at[0].value.size() == 1 && at[1].value.size() == 1) {
      along(at[0], out, at[1].value);
      return along(at[1], out, at[0].value);
    }
    each_direction(out, [&](Eigen::Index d) { return product_slope(at[0], at[1], d); });
  }
  void operator()(Is<Op::scale>, const At& at, Value& out) const {
    if (is_zero(at[0]) || is_zero(at[1])) return rest(out);
    if (at[1].moves()) out.slope = at[0].value(0) * at[1].slope;
    if (at[0].moves()) out.slope += times<Scalar>(M(at[1].value.reshaped()), at[0].slope);
  }
  void operator()(Is<Op::divide>, const At& at, Value& out) const {
    if (at[0].moves()) out.slope = at[0].slope;
    if (at[1].moves()) out.slope -= times<Scalar>(M(out.value.reshaped()), at[1].slope);
    out.slope /= at[1].value(0);
  }
  void operator()(Is<Op::elementwise_product>, const At& at, Value& out) const {
    if (is_zero(at[0]) || is_zero(at[1])) return rest(out);
    along(at[0], out, at[1].value);
    along(at[1], out, at[0].value);
  }
  void operator()(Is<Op::elementwise_quotient>, const At& at, Value& out) const {
    const M inverse = at[1].value.cwiseInverse();
    along(at[0], out, inverse);
    along(at[1], out, M(-out.value.cwiseProduct(inverse)));
  }
  void operator()(Is<Op::power>, const At& at, Value& out) const {
    const Eigen::Index n = at[0].value.rows();
    const Value one{M::Identity(n, n), M::Zero(n * n, out.slope.cols()), {}};
    out.slope = whole_power(one, at[0], at.attribute(0), product).slope;
  }
  void operator()(Is<Op::elementwise_power>, const At& at, Value& out) const {
    const int k = at.attribute(0);
    if (k == 0) return rest(out);
    const M& x = at[0].value;
    const M power =
        whole_power<M>(M::Ones(x.rows(), x.cols()), x, k - 1, numbers::elementwise_product<Scalar>);
    along(at[0], out, M(Scalar(k) * power));
  }
  /// (A^-1)' = -A^-1 A' A^-1.
  void operator()(Is<Op::inverse>, const At& at, Value& out) const {
    const M& R = out.value;
    each_direction(out, [&](Eigen::Index d) -> M {
      return -times<Scalar>(times<Scalar>(R, direction(at[0], d)), R);
    });
  }
  /// (A+)' = -A+ A' A+ + A+ A+' A'' (I - A A+) + (I - A+ A) A'' A+' A+ with A'' the transpose of A'
  /// (Golub and Pereyra 1973).
  void operator()(Is<Op::pseudo_inverse>, const At& at, Value& out) const {
    const M& A = at[0].value;
    const M& P = out.value;
    if (A.size() == 0) return;
    const auto rank = count_above<Scalar>(Base::singular_values(A), rounding_of<Scalar>(A));
    if (rank < std::min(A.rows(), A.cols())) return no_slope(at[0], out, Op::pseudo_inverse);
    const M turned = P.transpose();
    const M left = M::Identity(A.rows(), A.rows()) - times<Scalar>(A, P);
    const M right = M::Identity(A.cols(), A.cols()) - times<Scalar>(P, A);
    each_direction(out, [&](Eigen::Index d) -> M {
      const M slope = direction(at[0], d);
      const M mirrored = slope.transpose();
      const M one = times<Scalar>(times<Scalar>(P, slope), P);
      const M two = times<Scalar>(times<Scalar>(times<Scalar>(P, turned), mirrored), left);
      const M three = times<Scalar>(times<Scalar>(right, mirrored), times<Scalar>(turned, P));
      return two + three - one;
    });
  }
  /// exp([A, A'; 0, A]) = [e^A, (e^A)'; 0, e^A].
  void operator()(Is<Op::matrix_exponential>, const At& at, Value& out) const {
    const Eigen::Index n = at[0].value.rows();
    M both = M::Zero(2 * n, 2 * n);
    both.topLeftCorner(n, n) = both.bottomRightCorner(n, n) = at[0].value;
    each_direction(out, [&](Eigen::Index d) -> M {
      both.topRightCorner(n, n) = direction(at[0], d);
      return Base::exponential(both).topRightCorner(n, n);
    });
  }

  /// By the texts of the table.
  template <Op op>
  requires(expr::has_derivatives(op)) void operator()(Is<op>, const At& at, Value& out) const {
    for (std::size_t k = 0; k < at.operands.size(); ++k) {
      if (!at[k].moves()) continue;
      const PartialGraph& partial = partial_graph(op, k);
      M factor(out.value.rows(), out.value.cols());
      for (Eigen::Index i = 0; i < factor.size(); ++i)
        factor(i) = value_of(partial, at[0].value(i), at[at.operands.size() - 1].value(i));
      along(at[k], out, factor, op);
    }
  }
  template <Op op>
  requires expr::OneOf<op, Op::minimum, Op::maximum>
  void operator()(Is<op>, const At& at, Value& out) const {
    choose(at, out, [&](Eigen::Index i) -> std::size_t {
      const Scalar& a = at[0].value(i);
      const Scalar& b = at[1].value(i);
      return op == Op::maximum ? (a < b ? 1 : 0) : (b < a ? 1 : 0);
    });
  }
  void operator()(Is<Op::where>, const At& at, Value& out) const {
    const bool strict = at.attribute(0) != 0;
    choose(at, out, [&](Eigen::Index i) -> std::size_t {
      const Scalar& d = at[0].value(i);
      return (strict ? d > Scalar(0) : d >= Scalar(0)) ? 1 : 2;
    });
  }

  /// Of a vector x'dx / |x|; of a matrix u' dA v, with the first singular vectors.
  void operator()(Is<Op::norm>, const At& at, Value& out) const {
    const M& A = at[0].value;
    if (A.size() == 0) return;
    if (out.value(0) == Scalar(0)) return no_slope(at[0], out, Op::norm);
    M by = A;
    if (A.rows() != 1 && A.cols() != 1) {
      const auto svd = Base::full_svd(A);
      by = svd.U.col(0) * svd.V.col(0).transpose();
    } else {
      by = A / out.value(0);
    }
    out.slope = times<Scalar>(M(by.reshaped().transpose()), at[0].slope);
  }
  void operator()(Is<Op::singular_values>, const At& at, Value& out) const {
    const M& A = at[0].value;
    if (A.size() == 0) return;
    const auto svd = Base::full_svd(A);
    const Scalar close = rounding_of<Scalar>(A) * svd.s(0);
    const Eigen::Index count = out.value.size();
    for (Eigen::Index i = 0; i < count; ++i) {
      const M by = svd.U.col(i) * svd.V.col(i).transpose();
      out.slope.row(i) = times<Scalar>(M(by.reshaped().transpose()), at[0].slope);
      const bool tied = (i > 0 && svd.s(i - 1) - svd.s(i) <= close) ||
                        (i + 1 < count && svd.s(i) - svd.s(i + 1) <= close) || svd.s(i) <= close;
      if (!tied) continue;
      out.slope.row(i).setConstant(std::numeric_limits<Scalar>::quiet_NaN());
      out.without = Op::singular_values;
    }
  }
  template <Op op>
  requires expr::OneOf<op, Op::range_basis, Op::kernel_basis, Op::jacobian, Op::extremum,
                       Op::project_polytope, Op::project_ellipsoid, Op::project_affine,
                       Op::eigenvalues, Op::continuous_riccati, Op::discrete_riccati>
  void operator()(Is<op>, const At& at, Value& out) const {
    for (const Value* operand : at.operands) no_slope(*operand, out, op);
  }
  void operator()(Is<Op::project_convex>, const At& at, Value& out) const {
    project_convex_slope<Scalar>(at.instruction, at.operands, out);
  }
  /// By the variational equation.
  void operator()(Is<Op::flow_map>, const At& at, Value& out) const {
    flow_map_slope<Scalar>(at.instruction, at.operands, out);
  }
  void operator()(Is<Op::determinant>, const At& at, Value& out) const {
    const auto size = [](const Tangent<Scalar>& x) {
      return x.value < Scalar(0) ? Scalar(-x.value) : x.value;
    };
    each_direction(out, [&](Eigen::Index d) {
      const Tangent<Scalar> one{Scalar(1), Scalar(0)};
      return M::Constant(1, 1, determinant(tangents(at[0], d), one, size).slope).eval();
    });
  }
  void operator()(Is<Op::complement_basis>, const At& at, Value& out) const {
    const M& A = at[0].value;
    each_direction(out, [&](Eigen::Index d) -> M {
      const auto basis = complement(tangents(at[0], d), static_cast<std::size_t>(A.rows()),
                                    static_cast<std::size_t>(out.value.cols()),
                                    Tangent<Scalar>{Scalar(1), {}}, TangentNumbers<Scalar>{});
      M result(out.value.rows(), out.value.cols());
      for (Eigen::Index j = 0; j < result.cols(); ++j)
        for (Eigen::Index i = 0; i < result.rows(); ++i)
          result(i, j) = (*basis)[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)].slope;
      return result;
    });
    if (!out.slope.allFinite()) out.without = Op::complement_basis;
  }

 private:
  /// A constant 0: products with it do not move, so that sqrt(0*t) has a derivative at 0.
  static bool is_zero(const Value& x) { return !x.moves() && (x.value.array() == Scalar(0)).all(); }
  static void rest(Value& out) { out.slope.resize(out.value.size(), 0); }
  /// The slope of x in one direction, in the shape of x.
  static M direction(const Value& x, Eigen::Index d) {
    if (!x.moves()) return M::Zero(x.value.rows(), x.value.cols());
    return x.slope.col(d).reshaped(x.value.rows(), x.value.cols());
  }
  static Columns<Tangent<Scalar>> tangents(const Value& x, Eigen::Index d) {
    const M slope = direction(x, d);
    return columns_of<Tangent<Scalar>>(slope.rows(), slope.cols(),
                                       [&](Eigen::Index i, Eigen::Index j) {
                                         return Tangent<Scalar>{x.value(i, j), slope(i, j)};
                                       });
  }
  /// The slope of a block whose first element is at (row, column).
  static void place(const Value& x, Value& out, Eigen::Index row, Eigen::Index column) {
    if (!x.moves()) return;
    const Eigen::Index rows = x.value.rows();
    for (Eigen::Index j = 0; j < x.value.cols(); ++j)
      out.slope.middleRows((column + j) * out.value.rows() + row, rows) =
          x.slope.middleRows(j * rows, rows);
  }
  template <class Slope>
  static void each_direction(Value& out, const Slope& slope) {
    for (Eigen::Index d = 0; d < out.slope.cols(); ++d) {
      const M one = slope(d);
      out.slope.col(d) = one.reshaped();
    }
  }
  static M product_slope(const Value& a, const Value& b, Eigen::Index d) {
    M slope = M::Zero(a.value.rows(), b.value.cols());
    if (a.moves()) slope = slope + times<Scalar>(direction(a, d), b.value);
    if (b.moves()) slope = slope + times<Scalar>(a.value, direction(b, d));
    return slope;
  }
  static Value product(const Value& a, const Value& b) {
    Value out{times<Scalar>(a.value, b.value), a.slope, {}};
    each_direction(out, [&](Eigen::Index d) { return product_slope(a, b, d); });
    return out;
  }
  /// Adds factor times the slope of x, element by element. A factor that is not finite, which `op`
  /// says, is that of a value without a derivative, even where x has the slope 0 at this point:
  /// sqrt(t^2) has none at 0.
  static void along(const Value& x, Value& out, const M& factor, Op op = Op::multiply) {
    using std::isfinite;
    if (!x.moves()) return;
    for (Eigen::Index i = 0; i < factor.size(); ++i) {
      if (isfinite(factor(i))) {
        out.slope.row(i) += factor(i) * x.slope.row(i);
      } else {
        out.slope.row(i).setConstant(std::numeric_limits<Scalar>::quiet_NaN());
        out.without = op;
      }
    }
  }
  static void no_slope(const Value& x, Value& out, Op op) {
    if (!x.moves()) return;
    out.slope.setConstant(std::numeric_limits<Scalar>::quiet_NaN());
    out.without = op;
  }
  /// Each element has the slope of the operand which(element).
  template <class Which>
  static void choose(const At& at, Value& out, const Which& which) {
    for (Eigen::Index i = 0; i < out.slope.rows(); ++i) {
      const Value& from = at[which(i)];
      if (from.moves()) out.slope.row(i) = from.slope.row(i);
    }
  }
};

template <class Scalar>
Dual<Scalar> constant_dual(const MatrixOf<Scalar>& value) {
  return {value, MatrixOf<Scalar>(value.size(), 0), {}};
}

template <class Scalar>
Dual<Scalar> variable_dual(const MatrixOf<Scalar>& value) {
  return {value, MatrixOf<Scalar>::Identity(value.size(), value.size()), {}};
}

template <class Scalar>
void DualNumbers<Scalar>::apply(const expr::Instruction& instruction,
                                expr::Operands<Value> operands, Value& out) const {
  std::vector<const MatrixOf<Scalar>*> values;
  values.reserve(operands.size());
  Eigen::Index directions = 0;
  out.without.reset();
  for (const Value* operand : operands) {
    values.push_back(&operand->value);
    directions = std::max(directions, operand->slope.cols());
    if (operand->without && !out.without) out.without = operand->without;
  }
  Real<Scalar>{}.apply(instruction, values, out.value);
  out.slope.setZero(out.value.size(), directions);
  if (directions > 0) expr::dispatch(DualRules<Scalar>{}, instruction, operands, out);
}

template <class Scalar>
struct JacobianEvaluator<Scalar>::Kept {
  explicit Kept(const expr::Instruction& instruction)
      : evaluator(*instruction.body), inputs(instruction.operands.size()) {
    for (std::size_t k = 0; k < inputs.size(); ++k) evaluator.set(k, inputs[k]);
  }

  expr::Evaluator<DualNumbers<Scalar>> evaluator;
  std::vector<Dual<Scalar>> inputs;
};

template <class Scalar>
JacobianEvaluator<Scalar>::JacobianEvaluator(const expr::Instruction& instruction)
    : kept_(std::make_unique<Kept>(instruction)) {}
template <class Scalar>
JacobianEvaluator<Scalar>::JacobianEvaluator(JacobianEvaluator&&) noexcept = default;
template <class Scalar>
JacobianEvaluator<Scalar>& JacobianEvaluator<Scalar>::operator=(JacobianEvaluator&&) noexcept =
    default;
template <class Scalar>
JacobianEvaluator<Scalar>::~JacobianEvaluator() = default;

template <class Scalar>
MatrixOf<Scalar> JacobianEvaluator<Scalar>::operator()(expr::Operands<MatrixOf<Scalar>> operands) {
  for (std::size_t k = 0; k < operands.size(); ++k)
    kept_->inputs[k] =
        k == 0 ? variable_dual<Scalar>(*operands[k]) : constant_dual<Scalar>(*operands[k]);
  const Dual<Scalar>& result = kept_->evaluator.run();
  if (!result.moves()) return MatrixOf<Scalar>::Zero(result.value.size(), operands[0]->size());
  if (!result.slope.allFinite())
    throw expr::EvaluationError(
        result.without ? "jacobian: the " + expr::to_string(*result.without) +
                             " has no derivative at this point"
                       : std::string("jacobian: the derivative is not a finite number"));
  return result.slope;
}

template <class Scalar>
MatrixOf<Scalar> jacobian(const expr::Instruction& instruction,
                          expr::Operands<MatrixOf<Scalar>> operands) {
  return JacobianEvaluator<Scalar>(instruction)(operands);
}

}  // namespace gainsmith::numbers
