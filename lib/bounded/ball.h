// The number type "ball": a matrix and a bound of how far each element may be from the true one.
//
//   value = mid, |true - mid| <= rad element by element
//
// `mid` is computed in Scalar. `rad`, a double, grows by what an operation does to the bounds of
// its operands and by its own rounding (running error analysis; Higham, "Accuracy and Stability of
// Numerical Algorithms", ch. 3). u is unit_roundoff:
//
//   a + b       ra + rb + u |a + b|
//   A B         |A| RB + RA (|B| + RB) + (k + 1) u |A| |B|,  k terms
//   inv(A)      |R| ||X|| / (1 - ||R||),  X the computed inverse, R = I - X A with its own bound
//   expm(A)     ||RA|| exp(mu + ||RA||), mu the logarithmic 1-norm of A, and the rounding of 100
//               digits
//
// Where nothing is rounded the bound is 0: sums with 0, products with 0, zeros, selections. The
// bounds themselves are computed in double without directed rounding, so whoever compares widens
// them by kBoundSlack. Underflow below 2^-970 is not bounded here. Singular values and bases of
// ranges that are not exact have an infinite bound where none is known.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "base/eigen_scalars.h"
#include "base/scalars.h"
#include "bounded/tolerances.h"
#include "expr/number_type.h"
#include "numbers/matrix.h"
#include "numbers/real.h"

namespace gainsmith::bounded {

/// A bound of the relative error of +, -, *, / and sqrt in Scalar.
template <class Scalar>
constexpr double unit_roundoff();
template <>
constexpr double unit_roundoff<double>() {
  return 0x1p-53;
}
template <>
constexpr double unit_roundoff<DoubleDouble>() {
  return 0x1p-102;
}
template <>
constexpr double unit_roundoff<Decimal100>() {
  return 1e-98;
}

/// The radius where no bound is known.
constexpr double no_bound() { return std::numeric_limits<double>::infinity(); }
/// Sums of products above it, 2^-970, have lost no digits to the end of the range of double.
constexpr double full_precision_from() {
  return std::numeric_limits<double>::min() / std::numeric_limits<double>::epsilon();
}

/// The size of a number as a double.
inline double size_of(double value) { return std::abs(value); }
inline double size_of(const DoubleDouble& value) { return std::abs(value.hi()); }
template <class Derived>
numbers::Matrix sizes_of(const Eigen::MatrixBase<Derived>& matrix) {
  return matrix.unaryExpr([](const auto& value) { return size_of(value); });
}

template <class Scalar>
struct Ball {
  numbers::MatrixOf<Scalar> mid;
  numbers::Matrix rad;
};

/// The matrix of 100 digits as a ball; its radius is 0 where nothing is rounded.
template <class Scalar>
Ball<Scalar> ball_of(const numbers::MatrixOf<Decimal100>& exact);
/// A matrix without an error.
template <class Scalar>
Ball<Scalar> exact_ball(const numbers::Matrix& matrix);

template <class Scalar>
struct BallAlgebra {
  using Value = Ball<Scalar>;
  void apply(const expr::Instruction& instruction, expr::Operands<Value> operands,
             Value& out) const;
};

}  // namespace gainsmith::bounded
