#include "response/peak.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "response/sweep.h"
#include "response/systems.h"

namespace gainsmith::response {
namespace {

void expect_bracket(const Peak& found, double value) {
  ASSERT_TRUE(found.low && found.high);
  EXPECT_LE(*found.low, value * (1 + 1e-14));
  EXPECT_GE(*found.high, value);
  EXPECT_GT(*found.low, value * (1 - 1e-6));
  EXPECT_LT(*found.high, value * (1 + 1e-4));
}

TEST(Peaks, OfOscillatorsHaveAFormula) {
  for (const double damping : {0.5, 0.1, 1e-2, 1e-4, 1e-6})
    for (const double w : {1e-3, 1.0, 1e5}) {
      SCOPED_TRACE(testing::Message() << "damping " << damping << ", w " << w);
      const auto found = peak(oscillator(w, damping));
      ASSERT_TRUE(found);
      expect_bracket(*found, 1 / (2 * damping * std::sqrt(1 - damping * damping)));
      EXPECT_NEAR(found->frequency / w, std::sqrt(1 - 2 * damping * damping), 1e-6);
    }
}

TEST(Peaks, MayBeAtTheEnds) {
  const StateSpace low{Matrix{{-2}}, Matrix{{1}}, Matrix{{6}}, Matrix{{0}}, 0};
  expect_bracket(*peak(low), 3);
  EXPECT_EQ(peak(low)->frequency, 0);
  // (2 s + 1)/(s + 1): 2 beyond all frequencies.
  const StateSpace high{Matrix{{-1}}, Matrix{{1}}, Matrix{{-1}}, Matrix{{2}}, 0};
  expect_bracket(*peak(high), 2);
  EXPECT_EQ(peak(high)->frequency, std::numeric_limits<double>::infinity());
  const StateSpace still{Matrix(0, 0), Matrix(0, 2), Matrix(1, 0), Matrix{{3, 4}}, 0};
  expect_bracket(*peak(still), 5);
  // No input reaches the state.
  const StateSpace unreached{Matrix{{-1}}, Matrix{{0}}, Matrix{{1}}, Matrix{{2}}, 0};
  expect_bracket(*peak(unreached), 2);
  // 1/(z + 0.5): 2 at half of the sampling frequency.
  const StateSpace sampled{Matrix{{-0.5}}, Matrix{{1}}, Matrix{{1}}, Matrix{{0}}, 0.1};
  expect_bracket(*peak(sampled), 2);
  EXPECT_NEAR(peak(sampled)->frequency, 10 * std::numbers::pi, 1e-9);
}

TEST(Peaks, NeedStability) {
  EXPECT_FALSE(peak({Matrix{{0}}, Matrix{{1}}, Matrix{{1}}, Matrix{{0}}, 0}));
  EXPECT_FALSE(peak({Matrix{{0.1}}, Matrix{{1}}, Matrix{{1}}, Matrix{{0}}, 0}));
  EXPECT_FALSE(peak({Matrix{{-1}}, Matrix{{1}}, Matrix{{1}}, Matrix{{0}}, 1}));
}

/// Two resonances, the higher one a needle far from the other.
TEST(Peaks, AreTheHighestOfSeveral) {
  const StateSpace wide = oscillator(1, 0.05), needle = oscillator(1000, 1e-5);
  StateSpace both;
  both.A = Matrix::Zero(4, 4);
  both.A.topLeftCorner(2, 2) = wide.A;
  both.A.bottomRightCorner(2, 2) = needle.A;
  both.B.resize(4, 1);
  both.B << wide.B, needle.B;
  both.C.resize(1, 4);
  both.C << wide.C, 1e-3 * needle.C;
  both.D = Matrix{{0}};
  const auto found = peak(both);
  ASSERT_TRUE(found && found->low && found->high);
  EXPECT_NEAR(found->value, 50, 0.01);
  EXPECT_NEAR(found->frequency, 1000, 1e-3);
}

class RandomPeaks : public testing::TestWithParam<int> {};

TEST_P(RandomPeaks, AreAboveAllThatASweepMeets) {
  std::mt19937 random(static_cast<unsigned>(GetParam()));
  const double step = GetParam() % 3 == 2 ? 0.2 : 0;
  const StateSpace system =
      random_system(random, 1 + GetParam() % 8, 1 + GetParam() % 3, 1 + GetParam() % 2, step);
  const auto found = peak(system);
  ASSERT_TRUE(found && found->low && found->high);
  EXPECT_LE(*found->low, *found->high);
  EXPECT_LT(*found->high, *found->low * (1 + 1e-5));
  const auto [low, high] = range_of(system);
  const Sweep all = sweep(system, low, high);
  for (const ComplexMatrix& response : all.response) EXPECT_LE(gains_of(response)(0), *found->high);
}

INSTANTIATE_TEST_SUITE_P(Random, RandomPeaks, testing::Range(0, 24));

}  // namespace
}  // namespace gainsmith::response
