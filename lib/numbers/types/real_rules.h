// Internal to numbers: the rules of Real, instantiated by one source a scalar.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

#include "base/stop.h"
#include "expr/program/number_type.h"
#include "numbers/dense/canonical.h"
#include "numbers/dense/householder.h"
#include "numbers/dense/spectrum.h"
#include "numbers/types/dual.h"
#include "numbers/types/extremum.h"
#include "numbers/types/field_rules.h"
#include "numbers/types/flow_map.h"
#include "numbers/types/project_convex.h"
#include "numbers/types/real.h"
#include "numbers/types/scalar_functions.h"
#include "numbers/types/shared_rules.h"
#include "numerics/projection.h"

namespace gainsmith::numbers {

/// What a scalar type needs beyond its arithmetic; specialised beside its instantiation.
///   struct Foundation<Scalar> {
///     static std::optional<Scalar> parse(const std::string& decimal);
///     static std::optional<Scalar> pi();
///     static Scalar least_condition();  // of a matrix that is inverted
///     static auto inverse(const MatrixOf<Scalar>&);  // and what follows as in dense.h
///     static auto singular_values(const MatrixOf<Scalar>&);
///     static auto full_svd(const MatrixOf<Scalar>&);
///     static MatrixOf<Scalar> exponential(const MatrixOf<Scalar>&);
///   };
template <class Scalar>
struct Foundation;

/// How many singular values are above `tolerance` times the largest one; 0 without values.
template <class Scalar>
int count_above(const Eigen::Matrix<Scalar, Eigen::Dynamic, 1>& values, const Scalar& tolerance) {
  if (values.size() == 0) return 0;
  const Scalar threshold = tolerance * values.maxCoeff();
  return static_cast<int>((values.array() > threshold).count());
}

/// max(rows, cols) * epsilon.
template <class Scalar>
Scalar rounding_of(const MatrixOf<Scalar>& matrix) {
  return Scalar(static_cast<double>(std::max(matrix.rows(), matrix.cols()))) *
         std::numeric_limits<Scalar>::epsilon();
}

template <class Scalar>
struct RealRules : FieldRules<Scalar> {
  using Field = FieldRules<Scalar>;
  using typename Field::At;
  using typename Field::Op;
  using typename Field::Value;
  template <Op op>
  using Is = expr::Is<op>;
  using Base = Foundation<Scalar>;
  using Field::columns;
  using Field::map;
  using Field::operator();

  void operator()(Is<Op::constant>, const At& at, Value& out) const {
    const std::string& text = at.instruction.text;
    const auto value = text == "pi" ? Base::pi() : Base::parse(text);
    if (!value) expr::fault::beyond_range(at.instruction);
    out = Value::Constant(1, 1, *value);
  }
  void operator()(Is<Op::multiply>, const At& at, Value& out) const { multiply(at[0], at[1], out); }
  void operator()(Is<Op::power>, const At& at, Value& out) const {
    const auto times = [](const Value& a, const Value& b) {
      Value product;
      multiply(a, b, product);
      return product;
    };
    const Eigen::Index n = at[0].rows();
    out = whole_power<Value>(Value::Identity(n, n), at[0], at.attribute(0), times);
  }
  void operator()(Is<Op::elementwise_quotient>, const At& at, Value& out) const {
    // Below so many roundings of 1 a cosine counts as 0, where tan has its poles.
    constexpr int kRoundings = 4;
    const Scalar least = at.attribute(0) == expr::kPoleWithinRounding
                             ? Scalar(kRoundings * std::numeric_limits<Scalar>::epsilon())
                             : Scalar(0);
    if ((at[1].array() <= least && at[1].array() >= -least).any()) expr::fault::division_by_zero();
    out = at[0].cwiseQuotient(at[1]);
  }
  void operator()(Is<Op::elementwise_power>, const At& at, Value& out) const {
    out = whole_power<Value>(Value::Ones(at[0].rows(), at[0].cols()), at[0], at.attribute(0),
                             numbers::elementwise_product<Scalar>);
  }
  void operator()(Is<Op::real_power>, const At& at, Value& out) const {
    using std::pow;
    map([](const Scalar& a, const Scalar& b) { return pow(a, b); }, at, out);
  }
  void operator()(Is<Op::exp>, const At& at, Value& out) const { out = at[0].array().exp(); }
  void operator()(Is<Op::log>, const At& at, Value& out) const {
    if (!(at[0].array() > Scalar(0)).all()) outside(Op::log, at[0]);
    out = at[0].array().log();
  }
  void operator()(Is<Op::sqrt>, const At& at, Value& out) const {
    if (!(at[0].array() >= Scalar(0)).all()) outside(Op::sqrt, at[0]);
    out = at[0].array().sqrt();
  }
  void operator()(Is<Op::sin>, const At& at, Value& out) const { out = at[0].array().sin(); }
  void operator()(Is<Op::cos>, const At& at, Value& out) const { out = at[0].array().cos(); }
  void operator()(Is<Op::tanh>, const At& at, Value& out) const { out = at[0].array().tanh(); }
  void operator()(Is<Op::sign>, const At& at, Value& out) const { out = at[0].array().sign(); }
  void operator()(Is<Op::floor>, const At& at, Value& out) const {
    using std::floor;
    out = at[0].unaryExpr([](const Scalar& x) { return Scalar(floor(x)); });
  }
  void operator()(Is<Op::mod>, const At& at, Value& out) const {
    if ((at[1].array() == Scalar(0)).any()) expr::fault::division_by_zero();
    map([](const Scalar& a, const Scalar& b) { return mod(a, b); }, at, out);
  }
  void operator()(Is<Op::atan2>, const At& at, Value& out) const {
    map([](const Scalar& y, const Scalar& x) { return angle(y, x); }, at, out);
  }
  /// The length of a row or column, the largest singular value of other matrices, 0 of empty ones.
  void operator()(Is<Op::norm>, const At& at, Value& out) const {
    const Value& a = at[0];
    Scalar norm(0);
    if (a.size() > 0)
      norm = a.rows() == 1 || a.cols() == 1 ? a.norm() : Base::singular_values(a).maxCoeff();
    out = Value::Constant(1, 1, norm);
  }
  /// `singular` where the reciprocal condition in the 1-norm is not above least_condition().
  void operator()(Is<Op::inverse>, const At& at, Value& out) const {
    out = at[0];
    if (out.size() == 0) return;
    auto found = Base::inverse(at[0]);
    if (!(found.condition > Base::least_condition())) expr::fault::singular(at.instruction);
    out = std::move(found.matrix);
  }
  /// Moore and Penrose: A+ = sum_{i <= rank} v_i u_i' / s_i, with singular values above
  /// rounding_of().
  void operator()(Is<Op::pseudo_inverse>, const At& at, Value& out) const {
    const Value& a = at[0];
    out = Value::Zero(a.cols(), a.rows());
    if (a.size() == 0) return;
    const int rank = count_above<Scalar>(Base::singular_values(a), rounding_of<Scalar>(a));
    if (rank == 0) return;
    const auto svd = Base::full_svd(a);
    for (int i = 0; i < rank; ++i) out += svd.V.col(i) / svd.s(i) * svd.U.col(i).transpose();
  }
  void operator()(Is<Op::matrix_exponential>, const At& at, Value& out) const {
    out = Base::exponential(at[0]);
  }
  void operator()(Is<Op::singular_values>, const At& at, Value& out) const {
    out = Base::singular_values(at[0]);
  }
  /// n x 2 (spectrum.h).
  void operator()(Is<Op::eigenvalues>, const At& at, Value& out) const {
    solve(at, [&] { out = real_eigenvalues<Scalar>(at[0]); });
  }
  template <Op op>
  requires expr::OneOf<op, Op::continuous_riccati, Op::discrete_riccati>
  void operator()(Is<op>, const At& at, Value& out) const {
    const Riccati equation = op == Op::continuous_riccati ? Riccati::continuous : Riccati::discrete;
    solve(at,
          [&] { out = stabilising_solution<Scalar>(equation, at[0], at[1], at[2], at[3], at[4]); });
  }
  /// Of the first left singular vectors. An empty matrix has no decomposition.
  void operator()(Is<Op::range_basis>, const At& at, Value& out) const {
    const int count = at.shape().cols;
    out = Value::Identity(at[0].rows(), count);
    if (count == 0 || count == at[0].rows()) return;
    const Value U = Base::full_svd(at[0]).U.leftCols(count);
    out = canonical_basis(canonical::Of::range, times<Scalar>(U, U.transpose()), count, at[0]);
  }
  /// Of the last right singular vectors.
  void operator()(Is<Op::kernel_basis>, const At& at, Value& out) const {
    const int count = at.shape().cols;
    const Eigen::Index n = at[0].cols();
    out = Value::Identity(n, count);
    if (count == 0 || count == n) return;
    const Value V = Base::full_svd(at[0]).V.leftCols(n - count);
    const Value P = Value::Identity(n, n) - times<Scalar>(V, V.transpose());
    out = canonical_basis(canonical::Of::kernel, P, count, at[0].transpose());
  }
  void operator()(Is<Op::project_polytope>, const At& at, Value& out) const {
    project(at, out,
            [&] { return numerics::project_polytope<Scalar>(at[0], at[1], at[2], at[3]); });
  }
  void operator()(Is<Op::project_ellipsoid>, const At& at, Value& out) const {
    project(at, out,
            [&] { return numerics::project_ellipsoid<Scalar>(at[0], at[1], at[2], at[3], at[4]); });
  }
  void operator()(Is<Op::project_affine>, const At& at, Value& out) const {
    project(at, out, [&] { return numerics::project_affine<Scalar>(at[0], at[1], at[2], at[3]); });
  }
  void operator()(Is<Op::project_convex>, const At& at, Value& out) const {
    solve(at, [&] { out = project_convex<Scalar>(at.instruction, at.operands); });
  }
  void operator()(Is<Op::complement_basis>, const At& at, Value& out) const {
    const auto basis =
        complement(columns(at[0]), static_cast<std::size_t>(at[0].rows()),
                   static_cast<std::size_t>(at.shape().cols), Scalar(1), PlainNumbers<Scalar>{});
    out.resize(at.shape().rows, at.shape().cols);
    for (Eigen::Index j = 0; j < out.cols(); ++j)
      for (Eigen::Index i = 0; i < out.rows(); ++i)
        out(i, j) = (*basis)[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)];
  }
  void operator()(Is<Op::jacobian>, const At& at, Value& out) const {
    out = jacobian<Scalar>(at.instruction, at.operands);
  }
  void operator()(Is<Op::flow_map>, const At& at, Value& out) const {
    out = flow_map<Scalar>(at.instruction, at.operands);
  }
  void operator()(Is<Op::extremum>, const At& at, Value& out) const {
    out = extremum<Scalar>(at.instruction, at.operands);
  }

 private:
  /// Of the subspace of M with the projector P, n x n (canonical.h): n x k; 0 without a pivot.
  static Value canonical_basis(canonical::Of of, const Value& P, int k, const Value& M) {
    const auto is_zero = [&](Eigen::Index i) { return (M.row(i).array() == Scalar(0)).all(); };
    const auto basis = canonical::basis(
        canonical::projector(of, P.rows(), k, P, is_zero, Scalar(1)), k, Scalar(canonical::kLead));
    Value B = Value::Zero(P.rows(), k);
    if (basis) canonical::for_each_element(*basis, [&](auto i, auto j, auto& x) { B(i, j) = x; });
    return B;
  }

  /// compute(), whose NoProjection or NoSolution becomes the EvaluationError of the operation.
  template <class Compute>
  static void solve(const At& at, const Compute& compute) {
    for (const Value* operand : at.operands)
      if (!operand->allFinite()) expr::fault::not_finite(at.instruction.op);
    try {
      compute();
    } catch (const numerics::NoProjection& why) {
      expr::fault::without_result(at.instruction.op, why.what());
    } catch (const NoSolution& why) {
      expr::fault::without_result(at.instruction.op, why.what());
    }
  }

  template <class Nearest>
  static void project(const At& at, Value& out, const Nearest& nearest) {
    solve(at, [&] { out = nearest().point; });
  }

  /// Small products, by far the most frequent here, and those of other scalars than double are
  /// faster without the blocking of large ones.
  static void multiply(const Value& a, const Value& b, Value& out) {
    constexpr Eigen::Index kSmall = 16;
    if constexpr (std::is_same_v<Scalar, double>)
      if (std::max({a.rows(), a.cols(), b.cols()}) > kSmall) {
        out.noalias() = a * b;
        return;
      }
    out.noalias() = a.lazyProduct(b);
  }

  [[noreturn]] static void outside(Op op, const Value& value) {
    expr::fault::outside_domain(op, static_cast<double>(value.minCoeff()));
  }
};

template <class Scalar>
void Real<Scalar>::apply(const expr::Instruction& instruction, expr::Operands<Value> operands,
                         Value& out) const {
  if constexpr (!std::is_same_v<Scalar, double>) check_stop();
  expr::dispatch(RealRules<Scalar>{}, instruction, operands, out);
  if (!is_finite<Scalar>(out)) expr::fault::not_finite(instruction.op);
}

template <class Scalar>
MatrixOf<Scalar> evaluate(const expr::Program& program, const ValuesOf<Scalar>& values) {
  return evaluate_once<Real<Scalar>>(program, values);
}

}  // namespace gainsmith::numbers
