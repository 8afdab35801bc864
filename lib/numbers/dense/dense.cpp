#include "numbers/dense/dense.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include "numbers/dense/small_dense.h"
#include "numerics/balance.h"

namespace gainsmith::numbers {

Cholesky::Cholesky(const Matrix& M) {
  const Eigen::LLT<Matrix> factor(M);
  packed_ = factor.matrixLLT();
  // What is not a number passes the factorisation's own test.
  definite_ = factor.info() == Eigen::Success && (packed_.diagonal().array() > 0).all();
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

namespace {

double scale(double x, int exponent) { return std::ldexp(x, exponent); }

}  // namespace

Matrix exponential(const Matrix& M) {
  if (M.size() == 0) return M;
  std::vector<int> units = numerics::balance(M.cwiseAbs());
  const Matrix B = numerics::in_units(M, units, scale);
  const Matrix result = B.exp();
  for (int& unit : units) unit = -unit;
  return numerics::in_units(result, units, scale);
}

Vector singular_values(const Matrix& M) {
  if (M.size() == 0) return Vector::Zero(0);
  Vector small(std::min(M.rows(), M.cols()));
  if (small_singular_values(M, small.data())) return small;
  return Eigen::JacobiSVD<Matrix>(M).singularValues();
}

Svd full_svd(const Matrix& M) {
  const Eigen::JacobiSVD<Matrix> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

namespace {

Inverse inverse_by_lu(const Matrix& M) {
  const Eigen::PartialPivLU<Matrix> lu(M);
  Inverse found{lu.inverse(), 0};
  // The estimate passes over a pivot that is 0.
  if (found.matrix.allFinite()) found.condition = lu.rcond();
  return found;
}

}  // namespace

/// M^-1 = D (D M D)^-1 D with D of powers of two (symmetric_units).
Inverse inverse(const Matrix& M) {
  const auto d = symmetric_units<Vector>(M);
  Inverse plain = inverse_by_lu(d.asDiagonal() * M * d.asDiagonal());
  plain.matrix = d.asDiagonal() * plain.matrix * d.asDiagonal();
  return in_better_units(std::move(plain), M, inverse_by_lu, scale);
}

ComplexMatrix complex_inverse(const ComplexMatrix& M) {
  return Eigen::PartialPivLU<ComplexMatrix>(M).inverse();
}

}  // namespace gainsmith::numbers
