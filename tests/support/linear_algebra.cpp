#include "support/linear_algebra.h"

#include <Eigen/Dense>
#include <unsupported/Eigen/MatrixFunctions>

#include "base/eigen_scalars.h"

namespace gainsmith::tests {

using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

VectorXd symmetric_eigenvalues(const MatrixXd& M) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(M).eigenvalues();
}

VectorXd pencil_eigenvalues(const MatrixXd& A, const MatrixXd& B) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(A, B).eigenvalues();
}

VectorXcd eigenvalues(const MatrixXd& A) { return A.eigenvalues(); }

double spectral_abscissa(const MatrixXd& A) { return eigenvalues(A).real().maxCoeff(); }

VectorXd singular_values(const MatrixXd& M) {
  return Eigen::JacobiSVD<MatrixXd>(M).singularValues();
}

VectorXd solve(const MatrixXd& A, const VectorXd& b) { return A.fullPivLu().solve(b); }

MatrixXd inverse(const MatrixXd& M) { return M.inverse(); }

double determinant(const MatrixXd& M) { return M.determinant(); }

MatrixXd exponential(const MatrixXd& A) { return A.exp(); }

MatrixXd cholesky_factor(const MatrixXd& M) { return M.llt().matrixL(); }

MatrixXd orthogonal_factor(const MatrixXd& M) { return M.householderQr().householderQ(); }

MatrixXd product(std::initializer_list<MatrixXd> factors) {
  MatrixXd result = *factors.begin();
  for (const MatrixXd* next = factors.begin() + 1; next != factors.end(); ++next)
    result = result * *next;
  return result;
}

template <typename T>
Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> widened(const MatrixXd& M) {
  return M.cast<T>();
}
#define GAINSMITH_INSTANTIATE(T) \
  template Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> widened<T>(const MatrixXd&);
GAINSMITH_FOR_EACH_SCALAR(GAINSMITH_INSTANTIATE)
#undef GAINSMITH_INSTANTIATE

}  // namespace gainsmith::tests
