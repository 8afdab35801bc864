#include "sdp/core/extreme.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace gainsmith::sdp {
namespace {

/// How sharp the bound must be, relative to the eigenvalue.
constexpr double kSharpness = 0.01, kTridiagonalSharpness = 0.001;
/// Ritz values are checked from this step on, every few steps.
constexpr Eigen::Index kFirstCheck = 8, kBetweenChecks = 4;

/// Are all eigenvalues of T above `shift`? By the signs of the pivots of T - s I,
///   d_1 = a_1 - s,   d_i = a_i - s - b_{i-1}^2 / d_{i-1}
/// with a the diagonal and b the subdiagonal (Sylvester's law of inertia).
bool all_above(const Eigen::Ref<const Eigen::VectorXd>& diagonal,
               const Eigen::Ref<const Eigen::VectorXd>& subdiagonal, double shift) {
  double pivot = diagonal[0] - shift;
  for (Eigen::Index i = 1; i < diagonal.size(); ++i) {
    if (!(pivot > 0)) return false;
    pivot = diagonal[i] - shift - subdiagonal[i - 1] * subdiagonal[i - 1] / pivot;
  }
  return pivot > 0;
}

}  // namespace

double smallest_of_tridiagonal(const Eigen::Ref<const Eigen::VectorXd>& diagonal,
                               const Eigen::Ref<const Eigen::VectorXd>& subdiagonal,
                               double enough) {
  if (all_above(diagonal, subdiagonal, enough)) return enough;
  // The smallest eigenvalue is in (low, high]: first by doubling, then by halving.
  double high = enough, low = 2 * enough;
  while (!all_above(diagonal, subdiagonal, low) && std::isfinite(low)) {
    high = low;
    low *= 2;
  }
  while (high - low > kTridiagonalSharpness * std::abs(low)) {
    const double middle = 0.5 * (low + high);
    (all_above(diagonal, subdiagonal, middle) ? low : high) = middle;
  }
  return low;
}

Lanczos::Lanczos(Eigen::Index n)
    : basis_(n, std::min(kSteps, n) + 1),
      image_(n),
      half_(n),
      alpha_(Eigen::VectorXd::Zero(kSteps + 1)),
      beta_(Eigen::VectorXd::Zero(kSteps + 1)) {}

void Lanczos::apply(const Matrix& factor, const Matrix& D, Eigen::Index k) {
  half_ = basis_.col(k);
  factor.triangularView<Eigen::Lower>().transpose().solveInPlace(half_);
  image_.noalias() = D.selfadjointView<Eigen::Lower>() * half_;
  factor.triangularView<Eigen::Lower>().solveInPlace(image_);
}

double Lanczos::lower_bound(const Matrix& factor, const Matrix& D, double enough, bool& converged) {
  converged = false;
  const Eigen::Index n = basis_.rows(), steps = basis_.cols() - 1;
  // A start that no eigenvector of a structured problem is orthogonal to.
  for (Eigen::Index i = 0; i < n; ++i)
    basis_(i, 0) = 1 + 0.5 * std::sin(1.7 * static_cast<double>(i) + 0.3);
  basis_.col(0).normalize();
  double bound = 0;
  for (Eigen::Index k = 0; k < steps; ++k) {
    apply(factor, D, k);
    alpha_[k] = image_.dot(basis_.col(k));
    // Gram and Schmidt against all of the basis, twice: once would leave rounding along it.
    for (int pass = 0; pass < 2; ++pass) {
      half_.head(k + 1).noalias() = basis_.leftCols(k + 1).transpose() * image_;
      image_.noalias() -= basis_.leftCols(k + 1) * half_.head(k + 1);
    }
    beta_[k] = image_.norm();
    const bool exhausted = beta_[k] <= 1e-14 * std::abs(alpha_[0]) + 1e-300 || k + 1 == n;
    if (exhausted || (k + 1 >= kFirstCheck && (k + 1) % kBetweenChecks == 0)) {
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(k + 1);
      ritz.computeFromTridiagonal(alpha_.head(k + 1), beta_.head(k), Eigen::ComputeEigenvectors);
      const double theta = ritz.eigenvalues()[0];
      const double residual = exhausted ? 0 : std::abs(beta_[k] * ritz.eigenvectors()(k, 0));
      bound = theta - residual;
      converged = residual <= kSharpness * std::abs(theta) || bound >= enough;
      if (converged || exhausted) return bound;
    }
    basis_.col(k + 1) = image_ / beta_[k];
  }
  return bound;
}

}  // namespace gainsmith::sdp
