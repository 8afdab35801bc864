#include "numbers/dense/definite.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "numbers/dense/dense.h"

namespace gainsmith::numbers {
namespace {

template <class S>
Enclosed<S> within(const Matrix& mid, double radius = 0) {
  return {mid.cast<S>(), Matrix::Constant(mid.rows(), mid.cols(), radius)};
}

class RandomMatrices {
 public:
  Matrix matrix(int rows, int cols) {
    return Matrix::NullaryExpr(rows, cols, [&] { return normal_(generator_); });
  }
  Matrix orthogonal(int n) { return full_svd(matrix(n, n)).U; }

 private:
  std::mt19937 generator_{5};
  std::normal_distribution<double> normal_;
};

template <class S>
class DefiniteOf : public testing::Test {};
using Scalars = testing::Types<double, DoubleDouble, Decimal100>;
TYPED_TEST_SUITE(DefiniteOf, Scalars);

/// Q diag(least, ...) Q' with other eigenvalues in [0.5, 1.5], in units over 12 decades.
TYPED_TEST(DefiniteOf, RandomMatricesOfAKnownSmallestEigenvalue) {
  RandomMatrices random;
  for (int trial = 0; trial < 40; ++trial) {
    const int n = 1 + trial % 7;
    for (const double least : {1e-2, 1e-6, 1e-11, -1e-11, -1e-6, -1e-2}) {
      const Matrix Q = random.orthogonal(n);
      Vector values = Vector::Ones(n) + 0.5 * random.matrix(n, 1).array().tanh().matrix();
      values(0) = least;
      Matrix M = Q * values.asDiagonal() * Q.transpose();
      M = (0.5 * (M + M.transpose())).eval();
      for (int i = 0; i < n; ++i) {
        const double unit = std::ldexp(1.0, (i * 13) % 41 - 20);
        M.row(i) *= unit;
        M.col(i) *= unit;
      }
      const Definite found = definite(within<TypeParam>(M));
      EXPECT_EQ(found.sign, least > 0 ? Sign::positive : Sign::negative) << least << " " << n;
      if (found.sign == Sign::negative) {
        EXPECT_LT(found.direction.dot(M * found.direction), 0);
      }
    }
  }
}

/// The threshold is the radius: with |F| <= r all I + F are positive definite when n r < 1, and the
/// one with -r everywhere is not when n r >= 1.
TYPED_TEST(DefiniteOf, RadiiCount) {
  for (const int n : {1, 2, 5}) {
    const Matrix I = Matrix::Identity(n, n);
    EXPECT_EQ(definite(within<TypeParam>(I, 0.999 / n)).sign, Sign::positive) << n;
    EXPECT_EQ(definite(within<TypeParam>(I, 1.001 / n)).sign, Sign::open) << n;
    EXPECT_TRUE(
        is_positive_definite(within<TypeParam>(I, 0.5 / n), Matrix::Constant(n, n, 0.49 / n)));
    EXPECT_FALSE(
        is_positive_definite(within<TypeParam>(I, 0.5 / n), Matrix::Constant(n, n, 0.51 / n)));
    EXPECT_EQ(definite(within<TypeParam>(I, kNothingKnown)).sign, Sign::open) << n;
    EXPECT_EQ(definite(within<TypeParam>(-I, 0.5)).sign, Sign::negative) << n;
  }
}

/// Hilbert's matrices are positive definite, with condition e^(3.5 n). Elements 1/(i+j-1) rounded
/// to S have a radius, so that few digits end somewhere; integers do not: the inverse is whole.
TYPED_TEST(DefiniteOf, HilbertMatricesUntilTheDigitsEnd) {
  const int enough = std::is_same_v<TypeParam, double> ? 9 : 15;
  for (int n = 1; n <= 25; ++n) {
    Enclosed<TypeParam> H;
    H.resize(n, n);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        H.set(j * n + i,
              Ball<TypeParam>{TypeParam(1), 0} / Ball<TypeParam>{TypeParam(i + j + 1), 0});
    const Sign sign = definite(H).sign;
    if (n <= enough) {
      EXPECT_EQ(sign, Sign::positive) << n;
    } else {
      EXPECT_TRUE(sign == Sign::positive || sign == Sign::open) << n;
    }
  }
}

TYPED_TEST(DefiniteOf, TouchingZeroIsNotPositiveAndNotNegative) {
  EXPECT_EQ(definite(within<TypeParam>(Matrix{{0.0}})).sign, Sign::not_positive);
  EXPECT_EQ(definite(within<TypeParam>(Matrix{{1, 0}, {0, 0}})).sign, Sign::not_positive);
  EXPECT_EQ(definite(within<TypeParam>(Matrix{{0, 1e-9}, {1e-9, 3}})).sign, Sign::negative);
  EXPECT_NE(definite(within<TypeParam>(Matrix{{1, 1}, {1, 1}})).sign, Sign::positive);
  EXPECT_NE(definite(within<TypeParam>(Matrix{{1, 1}, {1, 1}})).sign, Sign::negative);
  // The symmetric part counts.
  EXPECT_EQ(definite(within<TypeParam>(Matrix{{1, 5}, {-5, 1}})).sign, Sign::positive);
  EXPECT_EQ(definite(within<TypeParam>(Matrix(0, 0))).sign, Sign::positive);
}

TEST(Definite, MarginIsTheSameInAllUnits) {
  RandomMatrices random;
  for (int trial = 0; trial < 30; ++trial) {
    const int n = 1 + trial % 6;
    const Matrix X = random.matrix(n, n);
    const Matrix M = X * X.transpose() + 0.1 * Matrix::Identity(n, n);
    const double expected = margin(M);
    EXPECT_GT(expected, 0);
    EXPECT_LE(expected, 1 + 1e-15);
    Vector units(n);
    for (int i = 0; i < n; ++i) units(i) = std::pow(10.0, 3 * random.matrix(1, 1)(0));
    EXPECT_NEAR(margin(units.asDiagonal() * M * units.asDiagonal()), expected, 1e-12);
    // Against the definition: the largest t with M - t diag(M) >= 0.
    const Matrix D = M.diagonal().asDiagonal();
    EXPECT_GT(smallest_eigenvalue(M - (expected - 1e-9) * D), 0);
    EXPECT_LT(smallest_eigenvalue(M - (expected + 1e-9) * D), 0);
  }
  EXPECT_EQ(margin(Matrix{{3.0}}), 1);
  EXPECT_EQ(margin(Matrix{{0, 1}, {1, 2}}), 0);
  EXPECT_EQ(margin(Matrix{{-2, 1}, {1, 2}}), -1);
  EXPECT_NEAR(margin(Matrix{{4, 6}, {6, 1}}), -2, 1e-12);
}

}  // namespace
}  // namespace gainsmith::numbers
