// Products that grow fastest, against pairs whose joint spectral radius is known.
#include "numerics/matrix_products.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace gainsmith::numerics {
namespace {

Matrix matrix(double a, double b, double c, double d) {
  Matrix M(2, 2);
  M << a, b, c, d;
  return M;
}

/// rho(A_n ... A_1)^(1/n), from the definition.
double growth_of(const std::vector<Matrix>& factors, const std::vector<std::size_t>& order) {
  Matrix product = Matrix::Identity(factors[0].rows(), factors[0].cols());
  for (const std::size_t i : order) product = factors[i] * product;
  return std::pow(spectral_radius(product), 1.0 / static_cast<double>(order.size()));
}

TEST(MatrixProducts, TheGoldenPairTakesTurns) {
  const std::vector<Matrix> pair = {matrix(1, 1, 0, 1), matrix(1, 0, 1, 1)};
  const MatrixProduct found = fastest_product(pair);
  EXPECT_NEAR(found.growth, std::numbers::phi, 1e-12);
  ASSERT_EQ(found.factors.size(), 2U);
  EXPECT_NE(found.factors[0], found.factors[1]);
  EXPECT_NEAR(found.growth, growth_of(pair, found.factors), 1e-12);
}

/// Products of all other orders vanish, those of the same twice among them.
TEST(MatrixProducts, NilpotentFactorsGrowInTurnsAlone) {
  const std::vector<Matrix> pair = {matrix(0, 2, 0, 0), matrix(0, 0, 3, 0)};
  const MatrixProduct found = fastest_product(pair);
  EXPECT_NEAR(found.growth, std::sqrt(6), 1e-12);
  EXPECT_EQ(found.factors.size(), 2U);
}

/// Scaled permutations: of rho(ABC) = 8 and all else nilpotent, in one order only.
TEST(MatrixProducts, TheOrderOfThreeIsFound) {
  const auto unit = [](int i, int j) {
    Matrix M = Matrix::Zero(3, 3);
    M(i, j) = 2;
    return M;
  };
  const std::vector<Matrix> factors = {unit(1, 0), unit(2, 1), unit(0, 2)};
  const MatrixProduct found = fastest_product(factors);
  EXPECT_NEAR(found.growth, 2, 1e-12);
  EXPECT_EQ(found.factors.size(), 3U);
  EXPECT_NEAR(found.growth, growth_of(factors, found.factors), 1e-12);
}

/// Five turns by pi/10 lead from one axis to the other, from where B leads back; four and B, which
/// takes a little less, take a jump less.
TEST(MatrixProducts, ALongPeriodIsFound) {
  const double angle = std::numbers::pi / 10;
  const double c = std::cos(angle), s = std::sin(angle);
  const std::vector<Matrix> factors = {matrix(c, -s, s, c), matrix(0, 1.5, 0, 0)};
  const MatrixProduct found = fastest_product(factors);
  EXPECT_NEAR(found.growth, std::pow(1.5 * c, 1.0 / 5), 1e-9);
  EXPECT_EQ(found.factors.size(), 5U);
}

TEST(MatrixProducts, WhatShrinksInEveryOrderDoes) {
  const std::vector<Matrix> pair = {matrix(0.5, 0.2, 0, 0.6), matrix(0.7, 0, 0.1, 0.3)};
  const MatrixProduct found = fastest_product(pair);
  EXPECT_LT(found.growth, 1);
  EXPECT_GE(found.growth, 0.7);  // of the second alone
}

TEST(MatrixProducts, FewProductsAreEnoughWhereTheyAreMany) {
  std::vector<Matrix> factors(20, matrix(0.9, 0, 0, 0.8));
  factors[7] = matrix(1, 1, 0, 1);
  factors[13] = matrix(1, 0, 1, 1);
  ProductOptions options;
  options.most = 2000;
  EXPECT_NEAR(fastest_product(factors, options).growth, std::numbers::phi, 1e-12);
}

TEST(MatrixProducts, OfNothingThereIsNone) {
  const MatrixProduct found = fastest_product({Matrix(0, 0)});
  EXPECT_TRUE(found.factors.empty());
  EXPECT_EQ(found.growth, 0);
}

}  // namespace
}  // namespace gainsmith::numerics
