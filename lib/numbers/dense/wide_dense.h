// Internal to numbers: decompositions over scalars beyond double. Eigen's are made for large
// matrices of doubles and take half a minute to compile for each scalar; these matrices are small.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/eigen_scalars.h"
#include "base/stop.h"
#include "numbers/dense/dense.h"
#include "numbers/types/ball.h"

namespace gainsmith::numbers {

/// The inverse by Gauss and Jordan with pivots in the column, in_better_units(), and the reciprocal
/// condition in the 1-norm: 0 when a pivot is 0. M must not be empty.
template <class S>
struct WideInverse {
  MatrixOf<S> matrix;
  S condition;
};

/// The 1-norm: the largest column sum of |M|.
template <class S>
S norm_1(const MatrixOf<S>& M) {
  return M.cwiseAbs().colwise().sum().maxCoeff();
}

template <class S>
WideInverse<S> inverse_by_gauss(const MatrixOf<S>& M) {
  using std::abs;
  const Eigen::Index n = M.rows();
  MatrixOf<S> both(n, 2 * n);
  both << M, MatrixOf<S>::Identity(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    check_stop();
    Eigen::Index pivot = j;
    for (Eigen::Index i = j + 1; i < n; ++i)
      if (abs(both(i, j)) > abs(both(pivot, j))) pivot = i;
    if (!(abs(both(pivot, j)) > S(0))) return {MatrixOf<S>::Zero(n, n), S(0)};
    both.row(j).swap(both.row(pivot));
    both.row(j) /= S(both(j, j));
    for (Eigen::Index i = 0; i < n; ++i)
      if (const S factor = both(i, j); i != j && factor != S(0))
        both.row(i) -= factor * both.row(j);
  }
  const MatrixOf<S> right = both.rightCols(n);
  return {right, S(1) / (norm_1(M) * norm_1(right))};
}

template <class S>
WideInverse<S> wide_inverse(const MatrixOf<S>& M) {
  return in_better_units(inverse_by_gauss<S>(M), M, inverse_by_gauss<S>,
                         [](const S& x, int exponent) { return times_power_of_two(x, exponent); });
}

/// M = U diag(s) V' with square orthogonal U and V. The decomposition in double, made sharp: where
/// it leaves a choice (a kernel, a signless vector) the columns are those of double, and so is
/// their order, also where two of the s are the same to double.
template <class S>
struct WideSvd {
  MatrixOf<S> U;
  Eigen::Matrix<S, Eigen::Dynamic, 1> s;
  MatrixOf<S> V;
};

/// The orthogonal matrix nearest to one that is nearly orthogonal, by the iteration of Newton and
/// Schulz, X <- X (3 I - X'X) / 2, which about squares |I - X'X| in each step.
template <class S>
MatrixOf<S> orthogonal(MatrixOf<S> X) {
  constexpr int kSteps = 5;  // 1e-15, 1e-30, 1e-60, 1e-120, 1e-240
  const MatrixOf<S> three = S(3) * MatrixOf<S>::Identity(X.cols(), X.cols());
  for (int k = 0; k < kSteps; ++k)
    X = times<S>(X, MatrixOf<S>((three - times<S>(X.transpose(), X)) * S(0.5)));
  return X;
}

/// Rotations of the columns of B, which V takes as well, until they are orthogonal (one-sided
/// Jacobi: Golub & Van Loan 8.6.3). Columns p, q with a = |p|^2, b = |q|^2, c = p'q are turned by
///   z = (b - a)/(2 c),  tan = sign(z)/(|z| + sqrt(1 + z^2)).
/// Columns below `rounding` are left alone, and those below `least` among themselves.
template <class S>
void rotate_columns(MatrixOf<S>& B, MatrixOf<S>& V, const S& least, const S& rounding) {
  using std::abs;
  using std::sqrt;
  constexpr int kMostSweeps = 60;
  const S tolerance = std::numeric_limits<S>::epsilon();
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    bool still = true;
    for (Eigen::Index p = 0; p < B.cols(); ++p)
      for (Eigen::Index q = p + 1; q < B.cols(); ++q) {
        check_stop();
        const S a = B.col(p).squaredNorm(), b = B.col(q).squaredNorm();
        const S c = B.col(p).dot(B.col(q));
        if (std::max(a, b) <= least * least || std::min(a, b) <= rounding * rounding) continue;
        if (!(abs(c) > tolerance * sqrt(a) * sqrt(b))) continue;
        still = false;
        const S zeta = (b - a) / (S(2) * c);
        const S t = (zeta < S(0) ? S(-1) : S(1)) / (abs(zeta) + sqrt(S(1) + zeta * zeta));
        const S cosine = S(1) / sqrt(S(1) + t * t), sine = cosine * t;
        for (MatrixOf<S>* both : {&B, &V}) {
          const MatrixOf<S> x = both->col(p), y = both->col(q);
          both->col(p) = cosine * x - sine * y;
          both->col(q) = sine * x + cosine * y;
        }
      }
    if (still) return;
  }
}

/// A V = B with orthogonal columns, s_i = |b_i|, u_i = b_i/s_i, where V starts as that of double.
/// M must be finite and not empty.
template <class S>
WideSvd<S> wide_svd(const MatrixOf<S>& M) {
  using std::sqrt;
  const double largest = M.unaryExpr([](const S& x) { return magnitude(x); }).maxCoeff();
  const int unit = largest > 0 && std::isfinite(largest) ? std::ilogb(largest) : 0;
  const MatrixOf<S> A = M.unaryExpr([&](const S& x) { return times_power_of_two(x, -unit); });
  const Svd start = full_svd(A.unaryExpr([](const S& x) { return static_cast<double>(x); }));
  MatrixOf<S> V = orthogonal<S>(start.V.template cast<S>());
  MatrixOf<S> B = times<S>(A, V);
  // What is 0 to double first goes to 0 by itself, without being mixed.
  constexpr double kNoise = 1e-12;
  const S rounding =
      S(static_cast<double>(M.size())) * std::numeric_limits<S>::epsilon() * S(start.s(0));
  rotate_columns<S>(B, V, S(kNoise * start.s(0)), rounding);
  rotate_columns<S>(B, V, rounding, rounding);
  WideSvd<S> result{start.U.template cast<S>(), Eigen::Matrix<S, Eigen::Dynamic, 1>(start.s.size()),
                    orthogonal<S>(V)};
  for (Eigen::Index i = 0; i < result.s.size(); ++i) {
    const S length = sqrt(B.col(i).squaredNorm());
    result.s(i) = times_power_of_two(length, unit);
    if (length > rounding) result.U.col(i) = B.col(i) / length;
  }
  // Gram and Schmidt, twice: the other columns beside those of the range.
  for (int twice = 0; twice < 2; ++twice)
    for (Eigen::Index j = 0; j < result.U.cols(); ++j) {
      for (Eigen::Index i = 0; i < j; ++i)
        result.U.col(j) -= result.U.col(i).dot(result.U.col(j)) * result.U.col(i);
      result.U.col(j) /= sqrt(result.U.col(j).squaredNorm());
    }
  return result;
}

}  // namespace gainsmith::numbers
