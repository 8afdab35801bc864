// What tests compute on their own, by Eigen and in double: nothing shared with the code under test.
// Compiled once, since Eigen's decompositions and products take seconds in every source that
// instantiates them.
#pragma once

#include <Eigen/Core>
#include <initializer_list>

namespace gainsmith::tests {

/// Of a symmetric M, of which the lower triangle is read; ascending.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& M);

/// The l with det(A - l B) = 0, A symmetric, B > 0; ascending.
Eigen::VectorXd pencil_eigenvalues(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& A);

/// The largest real part of an eigenvalue.
double spectral_abscissa(const Eigen::MatrixXd& A);

/// Descending.
Eigen::VectorXd singular_values(const Eigen::MatrixXd& M);

/// x of A x = b, by elimination with full pivoting.
Eigen::VectorXd solve(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

Eigen::MatrixXd inverse(const Eigen::MatrixXd& M);

double determinant(const Eigen::MatrixXd& M);

/// e^A
Eigen::MatrixXd exponential(const Eigen::MatrixXd& A);

/// The lower triangular L of M = L L', M > 0.
Eigen::MatrixXd cholesky_factor(const Eigen::MatrixXd& M);

/// The orthogonal Q of M = Q R.
Eigen::MatrixXd orthogonal_factor(const Eigen::MatrixXd& M);

/// From left to right.
Eigen::MatrixXd product(std::initializer_list<Eigen::MatrixXd> factors);

/// M in T = double, DoubleDouble or Decimal100.
template <typename T>
Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> widened(const Eigen::MatrixXd& M);

}  // namespace gainsmith::tests
