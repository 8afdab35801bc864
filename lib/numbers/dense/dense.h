// Decompositions of matrices of doubles by Eigen, compiled once: its headers for them stay out of
// the folders that use them. Symmetric matrices are read in their lower triangle.
#pragma once

#include <cmath>
#include <complex>
#include <limits>
#include <memory>

#include "numbers/matrix.h"
#include "numerics/balance.h"

namespace gainsmith::numbers {

using ComplexMatrix = MatrixOf<std::complex<double>>;
using ComplexVector = Eigen::VectorXcd;

/// lambda_min((M + M') / 2), M n x n, n > 0.
double smallest_eigenvalue(const Matrix& M);

/// All n eigenvalues of a symmetric M, in rising order.
Vector symmetric_eigenvalues(const Matrix& M);

/// M = V diag(lambda) V' with orthonormal V, eigenvalues in rising order. The memory is kept, for
/// families of matrices of one size.
class SymmetricEigen {
 public:
  SymmetricEigen();
  explicit SymmetricEigen(const Matrix& M);
  SymmetricEigen(SymmetricEigen&&) noexcept;
  SymmetricEigen& operator=(SymmetricEigen&&) noexcept;
  ~SymmetricEigen();

  /// Eigenvalues and vectors, or eigenvalues alone, of another M.
  void compute(const Matrix& M);
  void compute_values(const Matrix& M);

  const Vector& values() const;
  /// The columns of V; after compute() only.
  const Matrix& vectors() const;

 private:
  struct Solver;
  std::unique_ptr<Solver> solver_;
};

/// M = L L' with L lower triangular, M n x n, of which the lower triangle is read.
class Cholesky {
 public:
  explicit Cholesky(const Matrix& M);

  /// Whether M is positive definite; otherwise nothing else may be asked.
  explicit operator bool() const { return definite_; }
  Matrix lower() const;
  /// L^-1 B.
  Matrix lower_solve(const Matrix& B) const;
  /// M^-1 B.
  Matrix solve(const Matrix& B) const;

 private:
  Matrix packed_;  ///< L, and above the diagonal what M had there
  bool definite_ = false;
};

/// e^M, M n x n, in balanced units (numerics/balance.h): in units that are powers of two apart it
/// has the same digits. By scaling and squaring with Pade approximants (Higham, SIAM J. Matrix
/// Anal. Appl. 26, 2005).
Matrix exponential(const Matrix& M);

/// The min(rows, cols) singular values of any matrix, largest first; by Jacobi rotations.
Vector singular_values(const Matrix& M);

/// M = U diag(s) V' with square orthogonal U, V and s largest first. M must not be empty.
struct Svd {
  Matrix U;
  Vector s;
  Matrix V;
};
Svd full_svd(const Matrix& M);

/// The inverse by LU with pivots, and an estimate of the reciprocal condition in the 1-norm: not
/// above rounding, or NaN, when M is singular. Of a symmetric M with a diagonal > 0 both in units
/// in which the diagonal is near 1, of others in_better_units(). M must not be empty.
struct Inverse {
  Matrix matrix;
  double condition = 0;
};
Inverse inverse(const Matrix& M);

/// An inverse of M with its reciprocal condition: `plain`, or where half of the digits are lost,
/// that of M with balanced rows and columns, if that is better. invert(M) is the inverse of the one
/// type for both.
template <class Found, class S, class Invert, class Scale>
Found in_better_units(Found plain, const MatrixOf<S>& M, const Invert& invert, const Scale& scale) {
  using std::abs;
  using std::sqrt;
  if (plain.condition > sqrt(std::numeric_limits<S>::epsilon())) return plain;
  auto [rows, columns] =
      numerics::equilibrium(M.unaryExpr([](const S& x) { return static_cast<double>(abs(x)); }));
  Found found = invert(numerics::in_units(M, rows, columns, scale));
  for (auto* units : {&rows, &columns})
    for (int& unit : *units) unit = -unit;
  found.matrix = numerics::in_units(found.matrix, columns, rows, scale);
  return found.condition > plain.condition ? found : plain;
}

/// Of a square matrix, in no order, by the real Schur form.
ComplexVector eigenvalues(const Matrix& M);

/// By LU with pivots. Not finite where M is singular.
ComplexMatrix complex_inverse(const ComplexMatrix& M);

}  // namespace gainsmith::numbers
