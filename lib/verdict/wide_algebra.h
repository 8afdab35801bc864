// Internal to this folder: factorisations in more digits than double.
#pragma once

#include <cmath>
#include <limits>
#include <optional>

#include "base/eigen_scalars.h"
#include "base/scalars.h"
#include "base/stop.h"
#include "numbers/dense/factor.h"
#include "numbers/matrix.h"

namespace gainsmith::verdict {

using numbers::MatrixOf;

/// A matrix of 100 digits.
using Wide = MatrixOf<Decimal100>;

/// |x| in double; what is below its range is 0.
inline double size_of(const Decimal100& x) { return std::abs(as<double>(x)); }

/// Every element rounded to S.
template <class S>
MatrixOf<S> narrow(const Wide& matrix) {
  return matrix.unaryExpr([](const Decimal100& x) { return as<S>(x); });
}

template <class S>
using VectorOf = Eigen::Matrix<S, Eigen::Dynamic, 1>;

/// Of one operation, for spend().
template <class S>
constexpr double work_of() {
  return std::is_same_v<S, DoubleDouble> ? kQuadWork : kWideWork;
}

/// Lower triangular L with M = L L'; none when M is not positive definite in S. n^3/6 operations.
template <class S>
std::optional<MatrixOf<S>> cholesky(const MatrixOf<S>& M) {
  const auto n = static_cast<double>(M.rows());
  spend(n * n * n / 6 * work_of<S>());
  MatrixOf<S> L = M;
  if (!numbers::factor_in_place<S>(L)) return std::nullopt;
  L.template triangularView<Eigen::StrictlyUpper>().setConstant(S(0));
  return L;
}

/// L^-1 of a lower triangular L, n x n, column by column.
template <class S>
MatrixOf<S> lower_inverse(const MatrixOf<S>& L) {
  const Eigen::Index n = L.rows();
  MatrixOf<S> inverse = MatrixOf<S>::Zero(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    inverse(j, j) = S(1) / L(j, j);
    for (Eigen::Index i = j + 1; i < n; ++i) {
      const S sum = L.row(i).segment(j, i - j).dot(inverse.col(j).segment(j, i - j));
      inverse(i, j) = -sum / L(i, i);
    }
  }
  return inverse;
}

/// Not below |value|.
template <class S>
double upper(const S& value) {
  using std::abs;
  if (value == S(0)) return 0;
  return static_cast<double>(as<double>(S(abs(value)))) * (1 + 1e-15) +
         std::numeric_limits<double>::denorm_min();
}

}  // namespace gainsmith::verdict
