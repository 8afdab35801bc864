#include "numerics/matrix_products.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gainsmith::numerics {

namespace {

/// A product, and the least norm of its beginnings, by the number of their factors.
struct Branch {
  Matrix product;
  double least = 0;
  std::vector<std::size_t> factors;
};

double root(double value, std::size_t degree) {
  return std::pow(value, 1.0 / static_cast<double>(degree));
}

/// The spectral norm, sqrt(lambda_max(A'A)).
double norm(const Matrix& A) {
  const Matrix square = A.transpose() * A;
  return std::sqrt(
      std::max(0.0, Eigen::SelfAdjointEigenSolver<Matrix>(square, Eigen::EigenvaluesOnly)
                        .eigenvalues()
                        .maxCoeff()));
}

/// The factors in coordinates T x in which norms tell more of what products do: T A_i T^-1, with
/// T'T = P after 60 steps of the power iteration P <- n S/tr S + 1e-9 I, S = sum A_i' P A_i. The
/// factors themselves where P is not definite.
std::vector<Matrix> in_common_norm(const std::vector<Matrix>& factors) {
  constexpr int kSteps = 60;
  constexpr double kRegular = 1e-9;  // P stays positive definite
  const Eigen::Index n = factors.front().rows();
  Matrix P = Matrix::Identity(n, n);
  for (int step = 0; step < kSteps; ++step) {
    Matrix next = Matrix::Zero(n, n);
    for (const Matrix& A : factors) next += A.transpose() * P * A;
    const double size = next.trace();
    if (!(size > 0) || !std::isfinite(size)) break;
    P = next * (static_cast<double>(n) / size) + kRegular * Matrix::Identity(n, n);
  }
  const Eigen::LLT<Matrix> llt(P);
  if (llt.info() != Eigen::Success) return factors;
  const Matrix T = llt.matrixU();
  std::vector<Matrix> result;
  for (const Matrix& A : factors)
    result.push_back(llt.matrixL().solve((T * A).transpose()).transpose());  // T A inv(T), T = L'
  return result;
}

/// Keeps the `most` branches whose least norm is largest.
void bound_branches(std::vector<Branch>& branches, std::size_t most) {
  if (branches.size() <= most) return;
  std::stable_sort(branches.begin(), branches.end(),
                   [](const Branch& a, const Branch& b) { return a.least > b.least; });
  branches.resize(most);
}

}  // namespace

double spectral_radius(const Matrix& A) {
  if (A.size() == 0 || !A.allFinite()) return 0;
  return A.eigenvalues().cwiseAbs().maxCoeff();
}

MatrixProduct fastest_product(const std::vector<Matrix>& factors, const ProductOptions& options) {
  constexpr double kClearly = 1e-9;  // relative; less is rounding
  MatrixProduct best;
  if (factors.front().size() == 0) return best;
  const std::vector<Matrix> scaled = in_common_norm(factors);
  std::vector<Branch> branches = {{Matrix::Identity(factors.front().rows(), factors.front().cols()),
                                   std::numeric_limits<double>::infinity(),
                                   {}}};
  std::size_t formed = 0;
  for (std::size_t length = 1; length <= options.longest && !branches.empty(); ++length) {
    const std::size_t left = (options.most - formed) / scaled.size();
    bound_branches(branches, std::max<std::size_t>(1, left / (options.longest - length + 1)));
    std::vector<Branch> longer;
    for (const Branch& branch : branches)
      for (std::size_t i = 0; i < scaled.size() && formed < options.most; ++i, ++formed) {
        Branch next{scaled[i] * branch.product, branch.least, branch.factors};
        next.factors.push_back(i);
        const double growth = root(spectral_radius(next.product), length);
        if (growth > best.growth * (1 + kClearly)) best = {next.factors, growth};
        next.least = std::min(next.least, root(norm(next.product), length));
        if (next.least > 1) longer.push_back(std::move(next));
      }
    // Those that the best so far excludes.
    std::erase_if(longer, [&](const Branch& branch) {
      return branch.least <= std::max(1.0, best.growth * (1 + kClearly));
    });
    branches = std::move(longer);
  }
  return best;
}

}  // namespace gainsmith::numerics
