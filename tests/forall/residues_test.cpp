#include "forall/residues.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <random>

#include "expr/program/evaluate.h"
#include "support/linear_algebra.h"

namespace gainsmith::forall {
namespace {

numbers::Matrix sum(const std::vector<std::pair<Atom, numbers::Matrix>>& terms, Eigen::Index n,
                    double t) {
  numbers::Matrix result = numbers::Matrix::Zero(n, n);
  for (const auto& [atom, matrix] : terms) result += evaluate(atom, t) * matrix;
  return result;
}

void expect_exponential(const numbers::Matrix& F, double low, double high) {
  const auto terms = residue_expansion(F, low, high);
  for (int i = 0; i <= 10; ++i) {
    const double t = low + (high - low) * i / 10;
    const numbers::Matrix exact = tests::exponential(F * t);
    EXPECT_LT((sum(terms, F.rows(), t) - exact).norm(), 1e-10 * exact.norm()) << F << "\n" << t;
  }
}

TEST(ResiduesTest, RandomMatrices) {
  std::mt19937 generator(3);
  std::normal_distribution<double> number;
  for (int trial = 0; trial < 60; ++trial) {
    const int n = 1 + trial % 6;
    expect_exponential(numbers::Matrix::NullaryExpr(n, n, [&] { return number(generator); }), -0.5,
                       2);
  }
}

/// Jordan blocks in random coordinates: real ones, complex ones, and several of one eigenvalue.
TEST(ResiduesTest, RepeatedEigenvalues) {
  std::mt19937 generator(4);
  std::normal_distribution<double> number;
  numbers::Matrix real(4, 4);
  real << -0.5, 1, 0, 0, 0, -0.5, 1, 0, 0, 0, -0.5, 0, 0, 0, 0, -0.5;
  numbers::Matrix complex(4, 4);
  complex << -0.2, 2, 1, 0, -2, -0.2, 0, 1, 0, 0, -0.2, 2, 0, 0, -2, -0.2;
  for (const numbers::Matrix& form : {real, complex}) {
    expect_exponential(form, 0, 3);
    for (int trial = 0; trial < 10; ++trial) {
      numbers::Matrix T = numbers::Matrix::NullaryExpr(4, 4, [&] { return number(generator); });
      T += 3 * numbers::Matrix::Identity(4, 4);
      expect_exponential(tests::product({T, form, tests::inverse(T)}), 0, 2);
    }
  }
}

TEST(ResiduesTest, AnIntegratorChainIsAPolynomial) {
  numbers::Matrix F = numbers::Matrix::Zero(3, 3);
  F(0, 1) = 1;
  F(1, 2) = 1;
  const auto terms = residue_expansion(F, 0, 5);
  ASSERT_EQ(terms.size(), 3U);
  for (int j = 0; j < 3; ++j) {
    EXPECT_EQ(terms[static_cast<std::size_t>(j)].first, (Atom{j, 0, 0, false}));
  }
  EXPECT_NEAR(terms[2].second(0, 2), 0.5, 1e-14);
}

/// Only the functions that enter, and nothing that rounding made.
TEST(ResiduesTest, ARotationHasItsCosineAndSineOnly) {
  numbers::Matrix F(4, 4);
  F << 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 0, -2, 0, 0, 2, 0;
  const auto terms = residue_expansion(F, 0.1, 1.4);
  ASSERT_EQ(terms.size(), 4U);
  for (const auto& [atom, matrix] : terms) {
    EXPECT_EQ(atom.rate, 0);
    EXPECT_EQ((matrix.array() != 0).count(), 2) << matrix;
  }
}

/// Other units of states and time by powers of two change no digit, whichever states hang together.
TEST(ResiduesTest, UnitsByPowersOfTwoChangeNoDigit) {
  std::mt19937 generator(5);
  std::normal_distribution<double> number;
  std::uniform_int_distribution<int> power(-12, 12);
  std::bernoulli_distribution present(0.4);
  for (int trial = 0; trial < 60; ++trial) {
    const int n = 2 + trial % 4;
    const numbers::Matrix F = numbers::Matrix::NullaryExpr(
        n, n, [&] { return present(generator) ? number(generator) : 0.0; });
    numbers::Vector unit(n);
    for (double& u : unit) u = std::ldexp(1.0, power(generator));
    const double second = std::ldexp(1.0, power(generator));
    const numbers::Matrix scaled =
        second * unit.asDiagonal() * F * unit.cwiseInverse().asDiagonal();
    const auto own = residue_expansion(F, 0, 1);
    const auto other = residue_expansion(scaled, 0, 1 / second);
    ASSERT_EQ(own.size(), other.size()) << F;
    for (std::size_t i = 0; i < own.size(); ++i) {
      EXPECT_EQ(own[i].first.rate * second, other[i].first.rate);
      const double times = std::pow(second, own[i].first.power);
      const numbers::Matrix expected =
          times * unit.asDiagonal() * own[i].second * unit.cwiseInverse().asDiagonal();
      EXPECT_EQ(expected, other[i].second) << F;
    }
  }
}

TEST(ResiduesTest, CloseEigenvaluesThatDifferAreRefused) {
  numbers::Matrix F(2, 2);
  F << 1, 1, 0, 1.00003;
  EXPECT_THROW(residue_expansion(F, 0, 10), expr::EvaluationError);
}

}  // namespace
}  // namespace gainsmith::forall
