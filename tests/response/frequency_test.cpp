#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "response/margins.h"
#include "response/systems.h"

namespace gainsmith::response {
namespace {

using Complex = std::complex<double>;

class Frequency : public testing::TestWithParam<int> {};

TEST_P(Frequency, IsThatOfTheMatrices) {
  std::mt19937 random(static_cast<unsigned>(GetParam()));
  const double step = GetParam() % 2 == 0 ? 0 : 0.1;
  StateSpace system =
      random_system(random, 1 + GetParam() % 7, 1 + GetParam() % 3, 1 + GetParam() % 2, step);
  // In other units of the states.
  for (Eigen::Index i = 0; i < system.states(); ++i) {
    const double unit = std::ldexp(1.0, static_cast<int>(11 * i % 40 - 20));
    system.A.row(i) /= unit;
    system.A.col(i) *= unit;
    system.B.row(i) /= unit;
    system.C.col(i) *= unit;
  }
  const FrequencyResponse response(system);
  for (const double w : {0.0, 0.01, 0.7, 3.0, 29.0}) {
    const Complex s = step > 0 ? std::exp(Complex(0, w * step)) : Complex(0, w);
    ComplexMatrix M = -system.A.cast<Complex>();
    M.diagonal().array() += s;
    const ComplexMatrix expected =
        system.C.cast<Complex>() * M.partialPivLu().solve(system.B.cast<Complex>()) +
        system.D.cast<Complex>();
    EXPECT_LT((response.at(w) - expected).norm(), 1e-9 * (1 + expected.norm())) << w;
  }
}

TEST_P(Frequency, IsAsDenseAsItBends) {
  std::mt19937 random(static_cast<unsigned>(GetParam()) + 100);
  const StateSpace system = random_system(random, 2 + GetParam() % 6, 1, 1);
  const auto [low, high] = range_of(system);
  const Sweep all = sweep(system, low, high);
  EXPECT_EQ(all.frequency.front(), low);
  EXPECT_EQ(all.frequency.back(), high);
  EXPECT_LT(all.frequency.size(), 3000U);
  const FrequencyResponse response(system);
  for (std::size_t k = 0; k + 1 < all.frequency.size(); ++k) {
    ASSERT_LT(all.frequency[k], all.frequency[k + 1]);
    const double middle = std::sqrt(all.frequency[k] * all.frequency[k + 1]);
    const Complex between = all.response[k](0, 0) / 2.0 + all.response[k + 1](0, 0) / 2.0;
    if (all.frequency[k + 1] / all.frequency[k] < 1 + 1e-6) continue;
    EXPECT_LT(std::abs(response.at(middle)(0, 0) - between), 0.05 * std::abs(between) + 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Random, Frequency, testing::Range(0, 14));

TEST(Phase, OfIntegratorsBeginsBelowZero) {
  // 1/s^2 and 1/(s (s + 1)^2).
  const StateSpace twice{Matrix{{0, 0}, {1, 0}}, Matrix{{1}, {0}}, Matrix{{0, 1}}, Matrix{{0}}, 0};
  for (const double degrees : phase(sweep(twice, 0.1, 10), 0, 0)) EXPECT_NEAR(degrees, -180, 1e-9);
  const StateSpace lag{Matrix{{-2, -1, 0}, {1, 0, 0}, {0, 1, 0}}, Matrix{{1}, {0}, {0}},
                       Matrix{{0, 0, 1}}, Matrix{{0}}, 0};
  const Sweep all = sweep(lag, 1e-3, 1e3);
  const std::vector<double> degrees = phase(all, 0, 0);
  EXPECT_NEAR(degrees.front(), -90, 0.2);
  EXPECT_NEAR(degrees.back(), -270, 0.2);
  for (std::size_t k = 1; k < degrees.size(); ++k) EXPECT_LT(degrees[k], degrees[k - 1]);
}

TEST(Phase, BeginsAtTheAsymptoteOfItsIntegrators) {
  // 10 (s + 1)^2/s^3, -1/s and 1/s^2 - 1/s^3 = (s - 1)/s^3.
  const auto first = [](std::vector<double> numerator) {
    const StateSpace system{Matrix{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, Matrix{{1}, {0}, {0}},
                            Matrix{{numerator[0], numerator[1], numerator[2]}}, Matrix{{0}}, 0};
    return phase(sweep(system, 1e-3, 1e3), 0, 0);
  };
  EXPECT_NEAR(first({10, 20, 10}).front(), -270, 0.3);
  EXPECT_NEAR(first({10, 20, 10}).back(), -90, 0.3);
  EXPECT_NEAR(first({-1, 0, 0}).front(), 90, 0.3);
  EXPECT_NEAR(first({0, 1, -1}).front(), -90, 0.3);
}

/// k/(s (s + 1) (s + 2)), whose gain margin is 6/k at sqrt(2).
StateSpace loop(double k) {
  return {Matrix{{-3, -2, 0}, {1, 0, 0}, {0, 1, 0}}, Matrix{{1}, {0}, {0}}, Matrix{{0, 0, k}},
          Matrix{{0}}, 0};
}

TEST(MarginsOfLoops, AreThoseOfTheBook) {
  for (const double k : {0.5, 1.0, 5.0, 7.0}) {
    const Margins found = margins(loop(k));
    ASSERT_TRUE(found.gain && found.phase);
    EXPECT_NEAR(found.gain->value, 6 / k, 1e-12);
    EXPECT_NEAR(found.gain->frequency, std::numbers::sqrt2, 1e-12);
    EXPECT_EQ(found.stable, k < 6);
    const double w = found.phase->frequency;
    EXPECT_NEAR(k / (w * std::hypot(w, 1) * std::hypot(w, 2)), 1, 1e-12);
    const double phase = 90 - (std::atan(w) + std::atan(w / 2)) * 180 / std::numbers::pi;
    EXPECT_NEAR(found.phase->value, phase, 1e-9);
    if (k < 6) {
      EXPECT_NEAR(found.delay->value, phase * std::numbers::pi / 180 / w, 1e-10);
    }
  }
}

TEST(MarginsOfLoops, MayBeMissing) {
  const StateSpace small{Matrix{{-1}}, Matrix{{1}}, Matrix{{0.5}}, Matrix{{0}}, 0};
  const Margins found = margins(small);
  EXPECT_FALSE(found.gain || found.phase || found.delay);
  EXPECT_TRUE(found.stable);
}

TEST(MarginsOfLoops, AreNotThoseOfRounding) {
  // (1 - s)/(1 + s): its gain is 1 everywhere.
  const StateSpace all_pass{Matrix{{-1}}, Matrix{{1}}, Matrix{{2}}, Matrix{{-1}}, 0};
  EXPECT_FALSE(margins(all_pass).phase);
}

/// 1000/(s (s + 1)) and the like cross 1 far from their poles.
TEST(MarginsOfLoops, AreFoundBeyondPolesAndZeros) {
  for (const double k : {1e-4, 1e3, 1e9}) {
    const StateSpace system{Matrix{{-1, 0}, {1, 0}}, Matrix{{1}, {0}}, Matrix{{0, k}}, Matrix{{0}},
                            0};
    const Margins found = margins(system);
    ASSERT_TRUE(found.phase);
    const double w = found.phase->frequency;
    EXPECT_NEAR(w * std::hypot(w, 1) / k, 1, 1e-9);
  }
  // 8/(s + 1)^3 is at its margin.
  const StateSpace marginal{Matrix{{-3, -3, -1}, {1, 0, 0}, {0, 1, 0}}, Matrix{{1}, {0}, {0}},
                            Matrix{{0, 0, 8}}, Matrix{{0}}, 0};
  const Margins none = margins(marginal);
  ASSERT_TRUE(none.gain && none.phase && none.delay);
  EXPECT_NEAR(none.gain->value, 1, 1e-12);
  EXPECT_NEAR(none.phase->value, 0, 1e-9);
  EXPECT_NEAR(none.delay->value, 0, 1e-12);
}

TEST(MarginsOfLoops, AreAtTheEndsToo) {
  // -0.5/(s + 1) with a gain of 2 has a pole at 0; 1/(z + 0.5) with 0.5 one at -1.
  const StateSpace rest{Matrix{{-1}}, Matrix{{1}}, Matrix{{-0.5}}, Matrix{{0}}, 0};
  const Margins at_rest = margins(rest);
  ASSERT_TRUE(at_rest.gain);
  EXPECT_NEAR(at_rest.gain->value, 2, 1e-12);
  EXPECT_EQ(at_rest.gain->frequency, 0);
  const StateSpace sampled{Matrix{{-0.5}}, Matrix{{1}}, Matrix{{1}}, Matrix{{0}}, 0.1};
  const Margins at_end = margins(sampled);
  ASSERT_TRUE(at_end.gain);
  EXPECT_NEAR(at_end.gain->value, 0.5, 1e-12);
  EXPECT_FALSE(at_end.stable);
}

TEST(Modes, OfSampledSystems) {
  EXPECT_EQ(mode_of(0, 0, 0.1).damping, 1);
  const double angle = 0.3, size = std::exp(-0.1);
  const Mode mode = mode_of(size * std::cos(angle), size * std::sin(angle), 0.5);
  EXPECT_NEAR(mode.frequency, std::hypot(0.1, 0.3) / 0.5, 1e-12);
  EXPECT_NEAR(mode.damping, 0.1 / std::hypot(0.1, 0.3), 1e-12);
}

}  // namespace
}  // namespace gainsmith::response
