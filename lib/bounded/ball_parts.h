// Internal to bounded: what several operations of balls are made of.
#pragma once

#include <cmath>
#include <type_traits>

#include "bounded/ball.h"

namespace gainsmith::bounded::rules {

using Eigen::Index;
using numbers::MatrixOf;

template <class Scalar>
void shape_like(const expr::Instruction& instruction, Ball<Scalar>& out) {
  out.mid.resize(instruction.shape.rows, instruction.shape.cols);
  out.rad.resize(instruction.shape.rows, instruction.shape.cols);
}

template <class Scalar>
void multiply(const Ball<Scalar>& a, const Ball<Scalar>& b, Ball<Scalar>& out) {
  const Index inner = a.mid.cols();
  out.mid.resize(a.mid.rows(), b.mid.cols());
  out.rad.resize(a.mid.rows(), b.mid.cols());
  for (Index j = 0; j < b.mid.cols(); ++j)
    for (Index i = 0; i < a.mid.rows(); ++i) {
      Scalar sum(0);
      double bound = 0;
      double sizes = 0;
      for (Index k = 0; k < inner; ++k) {
        const double x = size_of(a.mid(i, k));
        const double y = size_of(b.mid(k, j));
        sum += a.mid(i, k) * b.mid(k, j);
        sizes += x * y;
        bound += x * b.rad(k, j) + a.rad(i, k) * (y + b.rad(k, j));
      }
      out.mid(i, j) = sum;
      out.rad(i, j) = bound + (static_cast<double>(inner) + 1) * unit_roundoff<Scalar>() * sizes;
    }
}

/// The instruction over 100 digits at the middles, rounded; its own rounding is in `rad`.
template <class Scalar>
void in_wide_digits(const expr::Instruction& instruction, const Ball<Scalar>& a,
                    Ball<Scalar>& out) {
  MatrixOf<Decimal100> operand =
      a.mid.unaryExpr([](const Scalar& value) { return as<Decimal100>(value); });
  const MatrixOf<Decimal100>* operands[] = {&operand};
  MatrixOf<Decimal100> result;
  numbers::Real<Decimal100>{}.apply(instruction, operands, result);
  out = ball_of<Scalar>(result);
}

/// e^A at the middle, with its own rounding: over 100 digits; for doubles over 31 while the error
/// of these stays far below that of a double.
template <class Scalar>
void exponential_of_middle(const expr::Instruction& instruction, const Ball<Scalar>& a,
                           Ball<Scalar>& out) {
  if constexpr (std::is_same_v<Scalar, double>) {
    const double norm = a.mid.size() == 0 ? 0 : a.mid.cwiseAbs().colwise().sum().maxCoeff();
    const double error = kExponentialError * std::exp(norm);
    if (error <= kSharper * unit_roundoff<double>()) {
      const MatrixOf<DoubleDouble> operand = a.mid.template cast<DoubleDouble>();
      const MatrixOf<DoubleDouble>* operands[] = {&operand};
      MatrixOf<DoubleDouble> result;
      numbers::Real<DoubleDouble>{}.apply(instruction, operands, result);
      out.mid = result.unaryExpr([](const DoubleDouble& x) { return as<double>(x); });
      out.rad = unit_roundoff<double>() * out.mid.cwiseAbs();
      out.rad.array() += error;
      return;
    }
  }
  in_wide_digits(instruction, a, out);
}

}  // namespace gainsmith::bounded::rules
