#include "forall/minima.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace gainsmith::forall {
namespace {

TEST(MinimaTest, AllLocalMinimaWithBothEnds) {
  const Curve curve{[](double t) { return std::cos(3 * t); },
                    [](double t) { return -3 * std::sin(3 * t); }};
  const auto found = local_minima(curve, 0.2, 5.5);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_NEAR(found[0].at, std::numbers::pi / 3, 1e-12);
  EXPECT_NEAR(found[1].at, std::numbers::pi, 1e-12);
  EXPECT_NEAR(found[2].at, 5 * std::numbers::pi / 3, 1e-12);
  const auto rising = local_minima(curve, 1.2, 2.0);
  ASSERT_EQ(rising.size(), 1U);
  EXPECT_EQ(rising[0].at, 1.2);
}

/// A dip a hundred times narrower than the first pieces, on a slope that shows where to look.
TEST(MinimaTest, ANarrowDipBesideAKinkIsFound) {
  const double centre = 0.7312;
  const auto value = [&](double t) {
    return std::min(1.0, 200 * std::hypot(t - centre, 1e-3)) + 0.1 * t;
  };
  const Curve curve{value, [&](double t) { return (value(t + 1e-7) - value(t - 1e-7)) / 2e-7; }};
  double lowest = 10;
  for (const auto& found : local_minima(curve, 0, 1)) lowest = std::min(lowest, found.value);
  EXPECT_NEAR(lowest, value(centre), 1e-6);
}

TEST(MinimaTest, AMinimumOfTwoBranchesKeepsBoth) {
  // min((t - 1)^2, (t - 3)^2 - 0.1): two smooth minima and a kink between them.
  const auto value = [](double t) { return std::min((t - 1) * (t - 1), (t - 3) * (t - 3) - 0.1); };
  const auto slope = [&](double t) {
    return (t - 1) * (t - 1) < (t - 3) * (t - 3) - 0.1 ? 2 * (t - 1) : 2 * (t - 3);
  };
  const auto found = local_minima({value, slope}, 0, 4);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NEAR(found[0].at, 1, 1e-12);
  EXPECT_NEAR(found[1].at, 3, 1e-12);
}

TEST(MinimaTest, ASingleNumberIsItsOwnMinimum) {
  const Curve curve{[](double t) { return t * t; }, [](double t) { return 2 * t; }};
  const auto found = local_minima(curve, 2, 2);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].value, 4);
}

TEST(MinimaTest, TheBestOfABoxComesFirst) {
  const auto value = [](const std::vector<double>& t) {
    return std::sin(3 * t[0]) * std::cos(2 * t[1]) + 0.05 * t[0];
  };
  const auto found = local_minima(value, {0, 0}, {6, 3});
  ASSERT_FALSE(found.empty());
  double lowest = 10;
  for (int i = 0; i <= 600; ++i)
    for (int j = 0; j <= 600; ++j) lowest = std::min(lowest, value({i * 0.01, j * 0.005}));
  EXPECT_LE(found.front().value, lowest + 1e-12);
  EXPECT_NEAR(found.front().value, lowest, 1e-3);
}

/// The lowest values of the grid lie together; the lowest minimum of the function does not.
TEST(MinimaTest, ManyMinimaOfABox) {
  const auto value = [](const std::vector<double>& t) {
    return 1 + std::cos(40 * t[0]) * std::cos(30 * t[1]) + 0.1 * t[0] + 0.1 * t[1];
  };
  const auto found = local_minima(value, {0, 0}, {1, 1});
  EXPECT_LT(found.front().value, 0.00786);
}

}  // namespace
}  // namespace gainsmith::forall
