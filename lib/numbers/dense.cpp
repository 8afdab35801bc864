#include "numbers/dense.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <unsupported/Eigen/MatrixFunctions>

namespace gainsmith::numbers {

Cholesky::Cholesky(const Matrix& M) {
  const Eigen::LLT<Matrix> factor(M);
  packed_ = factor.matrixLLT();
  definite_ = factor.info() == Eigen::Success;
}

Matrix Cholesky::lower() const { return packed_.triangularView<Eigen::Lower>(); }

Matrix Cholesky::lower_solve(const Matrix& B) const {
  return packed_.triangularView<Eigen::Lower>().solve(B);
}

Matrix Cholesky::solve(const Matrix& B) const {
  Matrix result = B;
  packed_.triangularView<Eigen::Lower>().solveInPlace(result);
  packed_.adjoint().triangularView<Eigen::Upper>().solveInPlace(result);
  return result;
}

Matrix exponential(const Matrix& M) { return M.size() == 0 ? M : Matrix(M.exp()); }

Vector singular_values(const Matrix& M) {
  if (M.size() == 0) return Vector::Zero(0);
  return Eigen::JacobiSVD<Matrix>(M).singularValues();
}

Svd full_svd(const Matrix& M) {
  const Eigen::JacobiSVD<Matrix> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

Inverse inverse(const Matrix& M) {
  const Eigen::PartialPivLU<Matrix> lu(M);
  return {lu.inverse(), lu.rcond()};
}

ComplexMatrix complex_inverse(const ComplexMatrix& M) { return M.inverse(); }

}  // namespace gainsmith::numbers
