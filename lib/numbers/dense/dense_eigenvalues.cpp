#include <Eigen/Eigenvalues>

#include "numbers/dense/dense.h"

namespace gainsmith::numbers {

double smallest_eigenvalue(const Matrix& M) {
  return symmetric_eigenvalues(0.5 * (M + M.transpose())).minCoeff();
}

Vector symmetric_eigenvalues(const Matrix& M) {
  return Eigen::SelfAdjointEigenSolver<Matrix>(M, Eigen::EigenvaluesOnly).eigenvalues();
}

struct SymmetricEigen::Solver : Eigen::SelfAdjointEigenSolver<Matrix> {};

SymmetricEigen::SymmetricEigen() : solver_(std::make_unique<Solver>()) {}
SymmetricEigen::SymmetricEigen(const Matrix& M) : SymmetricEigen() { compute(M); }
SymmetricEigen::SymmetricEigen(SymmetricEigen&&) noexcept = default;
SymmetricEigen& SymmetricEigen::operator=(SymmetricEigen&&) noexcept = default;
SymmetricEigen::~SymmetricEigen() = default;

void SymmetricEigen::compute(const Matrix& M) { solver_->compute(M); }
void SymmetricEigen::compute_values(const Matrix& M) {
  solver_->compute(M, Eigen::EigenvaluesOnly);
}

const Vector& SymmetricEigen::values() const { return solver_->eigenvalues(); }
const Matrix& SymmetricEigen::vectors() const { return solver_->eigenvectors(); }

ComplexVector eigenvalues(const Matrix& M) {
  return Eigen::EigenSolver<Matrix>(M, false).eigenvalues();
}

}  // namespace gainsmith::numbers
