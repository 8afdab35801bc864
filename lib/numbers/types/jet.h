// The number type "jet": a matrix function of one variable over a piece of its range, with its
// first two derivatives. Sums, products (Leibniz) and compositions
//   (f o x)' = f'(x) x',   (f o x)'' = f''(x) x'^2 + f'(x) x''
// of balls hold the derivatives of all points of the piece (Moore, Interval Analysis, 1966).
#pragma once

#include <array>
#include <memory>

#include "expr/program/number_type.h"
#include "numbers/types/enclosed.h"

namespace gainsmith::numbers {

/// Enclosures, over a piece [a, b] of the variable t, of all values f(t), f'(t), f''(t). Where f
/// has a kink f' holds the slopes of both sides, so that f(t) - f(s) is (t - s) times something in
/// it; where it jumps, or nobody knows, the radii are infinite.
struct Jet {
  /// factor(t) * matrix: an exponential of it has the derivatives factor' matrix e^(factor matrix).
  struct Ray {
    std::array<Ball<double>, 3> factor;
    Enclosed<double> matrix;
  };

  int order = 0;  ///< derivatives above it are 0 and not kept
  std::array<Enclosed<double>, 3> derivatives;
  std::shared_ptr<const Ray> ray;  ///< where the value is one

  const Enclosed<double>& value() const { return derivatives[0]; }
  /// The k-th derivative, 0 <= k <= 2.
  Enclosed<double> derivative(int k) const;
};

/// A value that does not depend on t, and t itself on [low, high]. Of several variables each has
/// its turn as t; the others are a constant between their ends.
Jet constant_jet(const Enclosed<double>& value);
Jet variable_jet(double low, double high);
Jet other_variable_jet(double low, double high);

/// Jet arithmetic (expr/program/number_type.h) on top of Enclosure<double>. An operation of a value
/// that does not move has its error bounds, and its faults; the projections are refused there and
/// here.
struct JetAlgebra {
  using Value = Jet;
  void apply(const expr::Instruction& instruction, expr::Operands<Jet> operands, Jet& out) const;
};

}  // namespace gainsmith::numbers
