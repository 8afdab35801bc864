#include "numbers/dense/dense.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <random>

#include "numbers/dense/small_dense.h"
#include "support/linear_algebra.h"

namespace gainsmith::numbers {
namespace {

class Dense : public testing::TestWithParam<int> {
 protected:
  Dense() {
    std::uniform_real_distribution<double> element(-1, 1);
    M = Matrix(n, n);
    B = Matrix(n, 2);
    for (double& x : M.reshaped()) x = element(generator_);
    for (double& x : B.reshaped()) x = element(generator_);
    S = M + M.transpose();
    P = M * M.transpose() + Matrix::Identity(n, n);
  }

  const int n = GetParam();
  Matrix M, B, S, P;

 private:
  std::mt19937 generator_{static_cast<unsigned>(GetParam())};
};

TEST_P(Dense, SymmetricMatricesAreTheirEigenvectorsAndEigenvalues) {
  SymmetricEigen eigen(S);
  const Matrix V = eigen.vectors();
  EXPECT_LT((V * eigen.values().asDiagonal() * V.transpose() - S).norm(), 1e-12);
  EXPECT_LT((V.transpose() * V - Matrix::Identity(n, n)).norm(), 1e-12);
  EXPECT_TRUE(std::is_sorted(eigen.values().begin(), eigen.values().end()));
  EXPECT_LT((symmetric_eigenvalues(S) - eigen.values()).norm(), 1e-12);
  eigen.compute_values(P);
  EXPECT_NEAR(eigen.values().sum(), P.trace(), 1e-12 * P.trace());
  // Of (M + M')/2.
  EXPECT_NEAR(smallest_eigenvalue(M), 0.5 * symmetric_eigenvalues(S)(0), 1e-13);
}

TEST_P(Dense, CholeskyFactorsDefiniteMatricesOnly) {
  const Cholesky factor(P);
  ASSERT_TRUE(factor);
  const Matrix L = factor.lower();
  EXPECT_EQ(Matrix(L.triangularView<Eigen::Lower>()), L);
  EXPECT_LT((L * L.transpose() - P).norm(), 1e-12);
  EXPECT_LT((L * factor.lower_solve(B) - B).norm(), 1e-12);
  EXPECT_LT((P * factor.solve(B) - B).norm(), 1e-12);
  EXPECT_FALSE(Cholesky(P - 2 * P.trace() * Matrix::Identity(n, n)));
}

TEST_P(Dense, SingularValues) {
  const Svd svd = full_svd(B);
  Matrix diagonal = Matrix::Zero(n, 2);
  diagonal.diagonal() = svd.s;
  EXPECT_LT((svd.U * diagonal * svd.V.transpose() - B).norm(), 1e-12);
  EXPECT_LT((singular_values(B) - svd.s).norm(), 1e-12);
  EXPECT_LT(
      (svd.s.array().square().matrix().reverse() - symmetric_eigenvalues(B.transpose() * B)).norm(),
      1e-12);
}

/// With and without allocation, symmetric or not, in any unit.
TEST_P(Dense, SingularValuesOfSmallMatrices) {
  for (const double unit : {1.0, 1e-160, 1e160})
    for (const Matrix& A : {Matrix(unit * M), Matrix(unit * S), Matrix(unit * P), Matrix(unit * B),
                            Matrix(unit * B.transpose()), Matrix(unit * M * M.transpose())}) {
      Vector small(std::min(A.rows(), A.cols()));
      ASSERT_TRUE(small_singular_values(A, small.data()));
      const Vector expected = tests::singular_values(A / unit);
      EXPECT_LT((small / unit - expected).norm(), 1e-14 * expected(0));
      EXPECT_TRUE(std::is_sorted(small.begin(), small.end(), std::greater<>()));
    }
  Vector values(n);
  ASSERT_TRUE(small_singular_values(Matrix::Zero(n, n), values.data()));
  EXPECT_TRUE(values.isZero(0));
  ASSERT_TRUE(small_singular_values(-3 * Matrix::Identity(n, n), values.data()));
  EXPECT_EQ(values, Vector::Constant(n, 3));
}

TEST(SmallSingularValues, RefuseWhatTheyDoNotKnow) {
  Vector values(9);
  EXPECT_FALSE(small_singular_values(Matrix::Ones(9, 2), values.data()));
  EXPECT_FALSE(small_singular_values(Matrix::Constant(2, 2, NAN), values.data()));
  EXPECT_NEAR(singular_values(Matrix::Ones(9, 2))(0), std::sqrt(18), 1e-14);
}

TEST_P(Dense, InverseExponentialAndEigenvalues) {
  const Inverse inverted = inverse(P);
  EXPECT_LT((inverted.matrix * P - Matrix::Identity(n, n)).norm(), 1e-11);
  EXPECT_GT(inverted.condition, 0);
  EXPECT_LE(inverted.condition, 1);
  EXPECT_FALSE(inverse(Matrix::Ones(n, n)).condition > 1e-15);
  EXPECT_LT((exponential(M) * exponential(-M) - Matrix::Identity(n, n)).norm(), 1e-11);
  const ComplexVector lambda = eigenvalues(M);
  EXPECT_LT(std::abs(lambda.sum() - M.trace()), 1e-12);
  EXPECT_LT(std::abs(lambda.prod() - tests::determinant(M)), 1e-12);
  const ComplexMatrix Z = M + std::complex<double>(0, 3) * ComplexMatrix::Identity(n, n);
  EXPECT_LT((complex_inverse(Z) * Z - ComplexMatrix::Identity(n, n)).norm(), 1e-12);
}

TEST_P(Dense, InversesInAnyUnits) {
  // Well conditioned, with units that are not: to double 1 / condition is 1e-30 and less.
  const auto inverse_of = [](const Matrix& X) { return numbers::inverse(X).matrix; };
  const Matrix well = M + 4 * Matrix::Identity(n, n);
  Vector rows(n), columns(n);
  for (int i = 0; i < n; ++i) {
    rows(i) = std::ldexp(1.0, 37 * (i % 3) - 40);
    columns(i) = std::ldexp(1.0, 20 - 43 * (i % 2));
  }
  const Matrix X = rows.asDiagonal() * well * columns.asDiagonal();
  const Matrix found = columns.asDiagonal() * inverse_of(X) * rows.asDiagonal();
  EXPECT_LT((found - inverse_of(well)).norm(), 1e-13);
  EXPECT_GT(numbers::inverse(X).condition, 1e-4);
  // Symmetric but for a last place.
  Matrix almost = rows.asDiagonal() * P * rows.asDiagonal();
  almost(1, 0) = std::nextafter(almost(1, 0), 0);
  EXPECT_LT((rows.asDiagonal() * inverse_of(almost) * rows.asDiagonal() - inverse_of(P)).norm(),
            1e-12);
  // What is singular stays so.
  Matrix singular = X;
  singular.row(0) = singular.row(1) * 0.25;
  EXPECT_FALSE(numbers::inverse(singular).condition > 1e-15);
}

INSTANTIATE_TEST_SUITE_P(Sizes, Dense, testing::Values(2, 3, 7));

}  // namespace
}  // namespace gainsmith::numbers
