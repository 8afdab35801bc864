#include "numbers/dense/small_dense.h"

#include <Eigen/LU>
#include <Eigen/SVD>

namespace gainsmith::numbers {

namespace {

/// Rows and columns that are kept on the stack.
constexpr int kLargest = 8;
constexpr double kPlain = 0x1p25;  ///< a condition at which inverse() tries no other units

using Small =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kLargest, kLargest>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kLargest, 1>;

/// The 1-norm: the largest column sum of |M|.
double norm_1(const Small& M) { return M.cwiseAbs().colwise().sum().maxCoeff(); }

bool is_small(const Matrix& M) {
  return M.rows() <= kLargest && M.cols() <= kLargest && M.size() > 0 && M.allFinite();
}

}  // namespace

/// As inverse() of dense.h, with the condition |A| |A^-1| in the 1-norm, which is not estimated.
bool small_inverse(const Matrix& M, double* out) {
  if (!is_small(M)) return false;
  const auto d = symmetric_units<SmallVector>(M);
  const Small A = d.asDiagonal() * M * d.asDiagonal();
  const Small X = Eigen::PartialPivLU<Small>(A).inverse();
  if (!X.allFinite() || norm_1(A) * norm_1(X) >= kPlain) return false;
  Eigen::Map<Matrix>(out, M.rows(), M.cols()) = d.asDiagonal() * X * d.asDiagonal();
  return true;
}

bool small_singular_values(const Matrix& M, double* out) {
  if (!is_small(M)) return false;
  const Eigen::JacobiSVD<Small> svd(M);
  Eigen::Map<Vector>(out, svd.singularValues().size()) = svd.singularValues();
  return true;
}

bool small_singular_slopes(const Matrix& M, const Matrix& dM, double* out) {
  if (!is_small(M)) return false;
  const Eigen::JacobiSVD<Small> svd(M, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Small rates = svd.matrixU().transpose() * Small(dM) * svd.matrixV();
  for (Eigen::Index k = 0; k < rates.rows(); ++k)
    out[k] = svd.singularValues()[k] == 0 ? 0 : rates(k, k);
  return true;
}

}  // namespace gainsmith::numbers
