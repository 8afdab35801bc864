// The rules that matrices over any ring, and over any ordered field, have alike.
#pragma once

#include <Eigen/Core>

#include "expr/program/number_type.h"
#include "numbers/dense/determinant.h"
#include "numbers/matrix.h"
#include "numbers/types/shared_rules.h"

namespace gainsmith::numbers {

/// Rules by +, - and * alone: of polynomials too.
template <class Scalar>
struct RingRules {
  using Value = MatrixOf<Scalar>;
  using At = expr::Step<Value>;
  using Op = expr::Op;
  template <Op op>
  using Is = expr::Is<op>;

  void operator()(Is<Op::zeros>, const At& at, Value& out) const {
    out.setZero(at.shape().rows, at.shape().cols);
  }
  void operator()(Is<Op::fill>, const At& at, Value& out) const {
    out.setConstant(at.shape().rows, at.shape().cols, at[0](0, 0));
  }
  void operator()(Is<Op::identity>, const At& at, Value& out) const {
    out = at[0](0, 0) * Value::Identity(at.shape().rows, at.shape().cols);
  }
  void operator()(Is<Op::add>, const At& at, Value& out) const { out = at[0] + at[1]; }
  void operator()(Is<Op::subtract>, const At& at, Value& out) const { out = at[0] - at[1]; }
  void operator()(Is<Op::negate>, const At& at, Value& out) const { out = -at[0]; }
  void operator()(Is<Op::scale>, const At& at, Value& out) const { out = at[0](0, 0) * at[1]; }
  void operator()(Is<Op::elementwise_product>, const At& at, Value& out) const {
    out = at[0].cwiseProduct(at[1]);
  }
  void operator()(Is<Op::transpose>, const At& at, Value& out) const { out = at[0].transpose(); }
  void operator()(Is<Op::blocks>, const At& at, Value& out) const {
    out.resize(at.shape().rows, at.shape().cols);
    for_each_block(at, [&](Eigen::Index row, Eigen::Index column, const Value& part) {
      out.block(row, column, part.rows(), part.cols()) = part;
    });
  }
  void operator()(Is<Op::index>, const At& at, Value& out) const {
    out = at[0].block(at.attribute(0), at.attribute(2), at.attribute(1) - at.attribute(0),
                      at.attribute(3) - at.attribute(2));
  }
  void operator()(Is<Op::trace>, const At& at, Value& out) const {
    out = Value::Constant(1, 1, at[0].trace());
  }
  void operator()(Is<Op::diagonal_matrix>, const At& at, Value& out) const {
    out = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>(at[0].reshaped()).asDiagonal();
  }
  void operator()(Is<Op::diagonal_of>, const At& at, Value& out) const { out = at[0].diagonal(); }

 protected:
  /// f(a, b) element by element.
  template <class Function>
  static void map(const Function& function, const At& at, Value& out) {
    out.resize(at.shape().rows, at.shape().cols);
    for (Eigen::Index i = 0; i < out.size(); ++i) out(i) = function(at[0](i), at[1](i));
  }
};

/// Division, comparisons and the determinant of an ordered field: reals and fractions.
template <class Scalar>
struct FieldRules : RingRules<Scalar> {
  using RingRules<Scalar>::operator();
  using typename RingRules<Scalar>::Value;
  using typename RingRules<Scalar>::At;
  using Op = expr::Op;
  template <Op op>
  using Is = expr::Is<op>;

  void operator()(Is<Op::divide>, const At& at, Value& out) const {
    const Scalar& by = at[1](0, 0);
    if (by == Scalar(0)) expr::fault::division_by_zero();
    out = at[0] / by;
  }
  void operator()(Is<Op::abs>, const At& at, Value& out) const { out = at[0].cwiseAbs(); }
  void operator()(Is<Op::minimum>, const At& at, Value& out) const { out = at[0].cwiseMin(at[1]); }
  void operator()(Is<Op::maximum>, const At& at, Value& out) const { out = at[0].cwiseMax(at[1]); }
  /// Element by element operand 1 where operand 0 is > 0, or >= 0 without attribute 0; else
  /// operand 2.
  void operator()(Is<Op::where>, const At& at, Value& out) const {
    out.resize(at.shape().rows, at.shape().cols);
    const bool strict = at.attribute(0) != 0;
    for (Eigen::Index i = 0; i < out.size(); ++i) {
      const Scalar& difference = at[0](i);
      const bool holds = strict ? difference > Scalar(0) : difference >= Scalar(0);
      out(i) = at[holds ? 1 : 2](i);
    }
  }
  void operator()(Is<Op::determinant>, const At& at, Value& out) const {
    const auto size = [](const Scalar& x) { return x < Scalar(0) ? Scalar(-x) : x; };
    out = Value::Constant(1, 1, determinant(columns(at[0]), Scalar(1), size));
  }

 protected:
  static Columns<Scalar> columns(const Value& a) {
    return columns_of<Scalar>(a.rows(), a.cols(),
                              [&](Eigen::Index i, Eigen::Index j) { return a(i, j); });
  }
};

}  // namespace gainsmith::numbers
