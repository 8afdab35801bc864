// The arithmetic that a result is computed in, to be right when it is rounded to its own: double in
// 31 digits, 31 digits in 100.
#pragma once

#include <limits>
#include <type_traits>

#include "base/eigen_scalars.h"
#include "base/scalars.h"
#include "numerics/matrix.h"

namespace gainsmith::numerics {

/// The 50 digits that Decimal100 has beyond 100 are enough for itself.
template <class S>
using Working = std::conditional_t<std::is_same_v<S, double>, DoubleDouble, Decimal100>;

/// The relative rounding of a scalar, in its working arithmetic.
template <class S>
Working<S> rounding() {
  if constexpr (std::is_same_v<S, Decimal100>) return Decimal100("1e-100");
  return as<Working<S>>(std::numeric_limits<S>::epsilon());
}

/// M in its working arithmetic, which holds it exactly, and back, rounded once.
template <class S>
MatrixOf<Working<S>> widened(const MatrixOf<S>& M) {
  return M.unaryExpr([](const S& x) { return as<Working<S>>(x); });
}
template <class S>
MatrixOf<S> narrowed(const MatrixOf<Working<S>>& M) {
  return M.unaryExpr([](const Working<S>& x) { return as<S>(x); });
}

template <class W>
MatrixOf<W> symmetric_part(const MatrixOf<W>& M) {
  return (M + M.transpose()) * W(0.5);
}

}  // namespace gainsmith::numerics
