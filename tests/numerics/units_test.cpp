// Units of states, and of rows and columns, as powers of two.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

#include "numerics/balance.h"

namespace gainsmith::numerics {
namespace {

double scaled(double x, int exponent) { return std::ldexp(x, exponent); }

/// A plant with zeros, and the same in other units of its states.
struct Units : testing::TestWithParam<unsigned> {
  Units() : A(4, 4), C(2, 4), exponents(4) {
    std::mt19937 generator(GetParam());
    std::uniform_real_distribution<double> element(-3, 3);
    for (Matrix* M : {&A, &C})
      for (double& x : M->reshaped()) x = element(generator) > 1 ? 0 : element(generator);
    std::uniform_int_distribution<int> exponent(-30, 30);
    for (int& one : exponents) one = exponent(generator);
  }
  Matrix A, C;
  std::vector<int> exponents;
  const std::vector<int> outputs{0, 0};
};

TEST_P(Units, ThePlantInThemDoesNotDependOnThoseItWasGivenIn) {
  const std::vector<int> S = units(A.cwiseAbs(), C.cwiseAbs());
  const Matrix other_A = in_units(A, exponents, scaled);
  const Matrix other_C = in_units(C, outputs, exponents, scaled);
  const std::vector<int> T = units(other_A.cwiseAbs(), other_C.cwiseAbs());
  // States that no output leads to have units beside those of the first one of them.
  std::vector<bool> seen(4);
  for (int k = 0; k < 4; ++k)
    for (Eigen::Index j = 0; j < 4; ++j) {
      bool leads = !C.col(j).isZero();
      for (Eigen::Index i = 0; i < 4; ++i)
        leads = leads || (seen[static_cast<std::size_t>(i)] && (A(i, j) != 0 || A(j, i) != 0));
      if (leads) seen[static_cast<std::size_t>(j)] = true;
    }
  for (std::size_t i = 0; i < 4; ++i)
    if (seen[i]) {
      EXPECT_EQ(S[i], exponents[i] + T[i]);
    }
  EXPECT_EQ(in_units(A, S, scaled), in_units(other_A, T, scaled));
}

TEST_P(Units, RowsAndColumnsOfAMatrixTheSame) {
  const auto [rows, columns] = equilibrium(A.cwiseAbs());
  const Matrix other = in_units(A, exponents, {3, -20, 7, 11}, scaled);
  const auto [other_rows, other_columns] = equilibrium(other.cwiseAbs());
  EXPECT_EQ(in_units(A, rows, columns, scaled), in_units(other, other_rows, other_columns, scaled));
}

INSTANTIATE_TEST_SUITE_P(Plants, Units, testing::Range(1U, 41U));

TEST(UnitsOf, APlantMakeItSmall) {
  // Pressure in Pa beside flow in m3/s and a leak.
  const Matrix A{{1, 1e9, 0}, {1e-9, 0.9, 0.5}, {0, 0, 1}};
  const Matrix C{{1, 0, 0}};
  const Matrix B = in_units(A, units(A, C), scaled);
  EXPECT_LT(B.maxCoeff(), 4);
  EXPECT_GT(B(0, 1), 0.25);
  EXPECT_GT(B(1, 0), 0.25);
  EXPECT_EQ(units(A * std::numeric_limits<double>::infinity(), C), (std::vector<int>{0, 0, 0}));
}

}  // namespace
}  // namespace gainsmith::numerics
