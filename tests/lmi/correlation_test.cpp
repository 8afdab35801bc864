#include "lmi/correlation.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <random>

#include "support/linear_algebra.h"

namespace gainsmith::lmi {
namespace {

using numbers::Matrix;
using numbers::Vector;

Matrix random_positive(int n, std::mt19937& generator) {
  std::normal_distribution<double> number;
  const Matrix root = Matrix::NullaryExpr(n, n, [&] { return number(generator); });
  return tests::product({root, root.transpose()}) + 1e-3 * Matrix::Identity(n, n);
}

TEST(CorrelationTest, DiagonalScalingsChangeNothing) {
  std::mt19937 generator(1);
  std::normal_distribution<double> number;
  for (int trial = 0; trial < 100; ++trial) {
    const int n = 1 + trial % 6;
    Matrix M = random_positive(n, generator);
    if (trial % 3 == 0) M(0, n - 1) = M(n - 1, 0) = 3 * std::sqrt(M(0, 0) * M(n - 1, n - 1));
    if (n == 1) M(0, 0) = 2;
    const double margin = correlation_margin(M);
    const Vector powers =
        Vector::NullaryExpr(n, [&] { return std::exp2(std::round(20 * number(generator))); });
    EXPECT_NEAR(correlation_margin(powers.asDiagonal() * M * powers.asDiagonal()), margin, 1e-14);
    const Vector any = Vector::NullaryExpr(n, [&] { return std::exp(10 * number(generator)); });
    EXPECT_NEAR(correlation_margin(any.asDiagonal() * M * any.asDiagonal()), margin, 1e-13);
  }
}

TEST(CorrelationTest, ItsSignIsThatOfTheMatrix) {
  std::mt19937 generator(2);
  for (int trial = 0; trial < 100; ++trial) {
    const int n = 2 + trial % 4;
    const Matrix M = random_positive(n, generator) - (trial % 5) * 0.2 * n * Matrix::Identity(n, n);
    const double least = tests::symmetric_eigenvalues(M)(0);
    if (std::abs(least) < 1e-9) continue;
    EXPECT_EQ(correlation_margin(M) > 0, least > 0);
    EXPECT_LE(correlation_margin(M), 1);
  }
}

TEST(CorrelationTest, OfOneNumberItIsOneOrNot) {
  for (const double positive : {1e-300, 1.0, 1e300})
    EXPECT_EQ(correlation_margin(Matrix::Constant(1, 1, positive)), 1);
  for (const double negative : {-1e-300, -1.0, -1e300})
    EXPECT_EQ(correlation_margin(Matrix::Constant(1, 1, negative)), -1);
  EXPECT_EQ(correlation_margin(Matrix::Zero(1, 1)), 0);
}

TEST(CorrelationTest, DiagonalElementsThatAreNotPositiveAreMeasuredByTheirRow) {
  Matrix M(3, 3);
  M << 4, 1, 0, 1, -2, 8, 0, 8, 1;
  EXPECT_EQ(correlation_margin(M), -0.25);
  M(1, 1) = 0;
  EXPECT_EQ(correlation_margin(M), 0);
  M(2, 2) = -16;
  EXPECT_EQ(correlation_margin(M), -1);
  EXPECT_EQ(correlation_margin(Matrix::Zero(3, 3)), 0);
}

TEST(CorrelationTest, WhatIsNoNumberIsNotPositive) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (int column = 0; column < 2; ++column) {
      Matrix M = Matrix::Identity(2, 2);
      M(1, column) = M(column, 1) = bad;
      EXPECT_EQ(correlation_margin(M), -1);
    }
}

/// No diagonal scaling makes the inverse condition larger than n times that of the correlation
/// (van der Sluis): with E the matrix in any units, lambda_min(E) / max E_ii <= n margin.
TEST(CorrelationTest, NoDiagonalScalingIsMuchBetter) {
  std::mt19937 generator(3);
  std::normal_distribution<double> number;
  for (int trial = 0; trial < 200; ++trial) {
    const int n = 2 + trial % 5;
    const Matrix M = random_positive(n, generator);
    const double margin = correlation_margin(M);
    const Vector s = Vector::NullaryExpr(n, [&] { return std::exp(number(generator)); });
    const Matrix E = s.asDiagonal() * M * s.asDiagonal();
    const Vector eigenvalues = tests::symmetric_eigenvalues(E);
    EXPECT_LE(eigenvalues(0) / eigenvalues(n - 1), n * margin);
    EXPECT_LE(eigenvalues(0) / E.diagonal().maxCoeff(), n * margin);
  }
}

}  // namespace
}  // namespace gainsmith::lmi
