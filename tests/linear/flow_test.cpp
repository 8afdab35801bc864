#include "linear/flow.h"

#include <gtest/gtest.h>

#include <random>

#include "linear/proof.h"

namespace gainsmith::linear::linear_flows {
namespace {

using Eigen::Index;

Wide wide(std::initializer_list<std::initializer_list<double>> rows) {
  Wide matrix(static_cast<Index>(rows.size()), static_cast<Index>(rows.begin()->size()));
  Index i = 0;
  for (const auto& row : rows) {
    Index j = 0;
    for (const double value : row) matrix(i, j++) = Decimal100(value);
    ++i;
  }
  return matrix;
}

double largest(const Wide& matrix) {
  double most = 0;
  for (Index e = 0; e < matrix.size(); ++e)
    most = std::max(most, std::abs(static_cast<double>(matrix(e))));
  return most;
}

TEST(WideFlow, IsTheExponentialInAnyUnits) {
  // Of a nilpotent part, and of a stiff one in units that lie far apart.
  const WideFlow ramp(wide({{0, 1e6}, {0, 0}}), {}, 2);
  EXPECT_LT(largest(ramp(Decimal100(1.5)).E - wide({{1, 1.5e6}, {0, 1}})), 1e-90);
  const WideFlow decay(wide({{-30, 0}, {0, 2}}), {}, 3);
  const Wide E = decay(Decimal100(2.5)).E;
  EXPECT_LT(std::abs(static_cast<double>(E(0, 0) / exp(Decimal100(-75)) - Decimal100(1))), 1e-80);
  EXPECT_LT(std::abs(static_cast<double>(E(1, 1) / exp(Decimal100(5)) - Decimal100(1))), 1e-80);
}

TEST(WideFlow, IntegratesForms) {
  // int_0^s e^(2 a t) dt, and of t^2 along a ramp.
  const WideFlow decay(wide({{-3}}), {wide({{2}})}, 4);
  const Decimal100 s(3.5);
  const Decimal100 truth = (Decimal100(1) - exp(Decimal100(-6) * s)) / Decimal100(3);
  EXPECT_LT(std::abs(static_cast<double>(decay(s).W[0](0) - truth)), 1e-90);
  const WideFlow ramp(wide({{0, 1}, {0, 0}}), {wide({{1, 0}, {0, 0}})}, 4);
  EXPECT_LT(std::abs(static_cast<double>(ramp(Decimal100(3)).W[0](1, 1) - Decimal100(9))), 1e-90);
}

TEST(RankFactors, MultiplyToTheMatrix) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> value(-1, 1);
  for (Index rank = 0; rank <= 4; ++rank) {
    Wide left(5, rank), right(rank, 5);
    for (Index e = 0; e < left.size(); ++e) left(e) = Decimal100(value(random));
    for (Index e = 0; e < right.size(); ++e) right(e) = Decimal100(value(random) * 1e3);
    const Wide matrix = numbers::times<Decimal100>(left, right);
    const RankFactors factors = rank_factors(matrix);
    ASSERT_EQ(factors.D.rows(), rank);
    EXPECT_LE(largest(numbers::times<Decimal100>(factors.B, factors.D) - matrix), 1e-90);
  }
}

TEST(IsSemidefinite, IsDecidedExactly) {
  EXPECT_TRUE(is_semidefinite(wide({{1, 2}, {2, 4}})));
  EXPECT_TRUE(is_semidefinite(wide({{0, 0}, {0, 3}})));
  EXPECT_FALSE(is_semidefinite(wide({{1, 2}, {2, 4 - 1e-12}})));
  EXPECT_FALSE(is_semidefinite(wide({{0, 1e-9}, {1e-9, 3}})));
  EXPECT_FALSE(is_semidefinite(wide({{-1}})));
}

WideTable constant_factor(double from, double to) {
  return *make_wide_table(from, to,
                          [](const Decimal100&) { return std::vector<Decimal100>{Decimal100(1)}; });
}

TEST(LinearProof, NeedsMoreThanRounding) {
  const std::vector<FallingTerm> energy{{wide({{1, 0}, {0, 1}}), 0}};
  const WideTable one = constant_factor(0, 1);
  EXPECT_TRUE(falls_along_flows(energy, wide({{-0.1, 1}, {-1, -0.1}}), one));
  // What is negative in one direction and 0 in another is not told from what rises.
  EXPECT_FALSE(falls_along_flows(energy, wide({{-1, 1}, {1, -1}}), one));
  EXPECT_FALSE(falls_along_flows(energy, wide({{-1, 1}, {1, -1 - 1e-11}}), one));
  EXPECT_FALSE(falls_along_flows(energy, wide({{0.1, 1}, {-1, -0.1}}), one));
  EXPECT_TRUE(falls_at_jumps(energy, wide({{0.5, 0.5}, {-0.5, 0.5}}), one, {Decimal100(1)}));
  // A coordinate that keeps its value does not count.
  EXPECT_TRUE(falls_at_jumps(energy, wide({{1, 0}, {0, 0.5}}), one, {Decimal100(1)}));
  EXPECT_FALSE(falls_at_jumps(energy, wide({{1, 0.1}, {0, 0.5}}), one, {Decimal100(1)}));
}

TEST(LinearProof, FollowsFactorsOfTheTimer) {
  // v = e^(-2 tau) x^2 with x' = x: v' = 2 v + 2 v > 0; with e^(3 tau) it is 2 v - 3 v.
  const auto falls = [](double rate) {
    const auto factor = make_wide_table(0, 2, [&](const Decimal100& tau) {
      return std::vector<Decimal100>{exp(Decimal100(rate) * tau)};
    });
    return falls_along_flows({{wide({{1}}), 0}}, wide({{1}}), *factor);
  };
  EXPECT_FALSE(falls(-2));
  EXPECT_FALSE(falls(1.9));
  EXPECT_TRUE(falls(3));
}

TEST(LinearProof, FindsHowFastAValueMayGrow) {
  const Wide square = wide({{1, 0}, {0, 1}});
  // |x|^2 with x' = A x grows at the largest eigenvalue of A + A'.
  EXPECT_EQ(growth_along_flows(square, wide({{-1, 1}, {-1, -2}}), 1), 0);
  const auto growth = growth_along_flows(square, wide({{0.25, 1}, {-1, 0}}), 2);
  ASSERT_TRUE(growth);
  EXPECT_GE(*growth, 0.5);
  EXPECT_LE(*growth, 0.55);
  // Of x_1 alone x_2 makes anything.
  EXPECT_FALSE(growth_along_flows(wide({{1, 0}, {0, 0}}), wide({{-1, 1}, {0, -1}}), 1));
  EXPECT_EQ(growth_along_flows(wide({{1, 0}, {0, 0}}), wide({{-1, 0}, {1, 1}}), 1), 0);
}

}  // namespace
}  // namespace gainsmith::linear::linear_flows
