// Smallest eigenvalues, as sharply as a step length needs them.
#pragma once

#include <Eigen/Core>

namespace gainsmith::sdp {

/// A lower bound of the smallest eigenvalue of the symmetric tridiagonal matrix, within a
/// thousandth of it; `enough` when all eigenvalues are above it. Bisection on the signs of the
/// pivots of T - s I (Givens 1954). enough < 0.
double smallest_of_tridiagonal(const Eigen::Ref<const Eigen::VectorXd>& diagonal,
                               const Eigen::Ref<const Eigen::VectorXd>& subdiagonal, double enough);

/// Lanczos with full reorthogonalisation on W = L^-1 D L^-T (Toh 2002): theta - |beta s| of the
/// smallest Ritz pair (theta, s), as soon as that is within a hundredth of theta or above `enough`.
/// A lower bound of the eigenvalue that theta has found. That is the smallest, or where the start
/// has little of its eigenvector one some percent above it: a step by this bound is to be checked.
/// The work space is kept between calls.
class Lanczos {
 public:
  explicit Lanczos(Eigen::Index n);

  using Matrix = Eigen::Ref<const Eigen::MatrixXd>;
  /// L is the lower triangle of `factor`; `converged` says whether the bound may be used.
  double lower_bound(const Matrix& factor, const Matrix& D, double enough, bool& converged);

 private:
  static constexpr Eigen::Index kSteps = 60;  ///< at most; then `converged` is false
  void apply(const Matrix& factor, const Matrix& D, Eigen::Index k);

  Eigen::MatrixXd basis_;
  Eigen::VectorXd image_, half_, alpha_, beta_;  ///< alpha, beta: Lanczos' tridiagonal matrix
};

}  // namespace gainsmith::sdp
