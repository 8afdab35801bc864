#include "search/axis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace gainsmith::search {
namespace {

TEST(Axis, IsLogarithmicOverTwoDecadesOfPositiveNumbers) {
  EXPECT_TRUE(axis(1e-3, 10).logarithmic);
  EXPECT_TRUE(axis(1, 100).logarithmic);
  EXPECT_FALSE(axis(1, 99).logarithmic);
  EXPECT_FALSE(axis(0, 1000).logarithmic);
  EXPECT_FALSE(axis(-1, 1000).logarithmic);
}

TEST(Axis, ItsEndsAreExactAndFractionsComeBack) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const Axis& a : {axis(1e-3, 10), axis(0.1, 0.3), axis(-5, 7), axis(1e-300, 1e300)}) {
    EXPECT_EQ(a.at(0), a.low);
    EXPECT_EQ(a.at(1), a.high);
    EXPECT_EQ(a.at(-1), a.low);
    EXPECT_EQ(a.at(2), a.high);
    for (int i = 0; i < 100; ++i) {
      const double fraction = uniform(random);
      const double value = a.at(fraction);
      EXPECT_GE(value, a.low);
      EXPECT_LE(value, a.high);
      EXPECT_NEAR(a.fraction(value), fraction, 1e-12);
    }
  }
  EXPECT_EQ((Axis{2, 2, false}.fraction(2)), 0);
}

TEST(Axis, PointsRunFromEndToEnd) {
  EXPECT_EQ(points_on(axis(0, 1), 5), (std::vector<double>{0, 0.25, 0.5, 0.75, 1}));
  EXPECT_EQ(points_on(axis(0, 1), 2), (std::vector<double>{0, 1}));
  EXPECT_EQ(points_on(axis(0, 1), 1), (std::vector<double>{0.5}));
  const auto points = points_on(axis(1e-2, 1e2), 5);
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_NEAR(points[i], std::pow(10.0, static_cast<double>(i) - 2), 1e-12 * points[i]);
}

TEST(Axis, TheLastAxisOfAGridRunsFastest) {
  EXPECT_EQ(grid({{1, 2}, {3, 4, 5}}),
            (std::vector<std::vector<double>>{{1, 3}, {1, 4}, {1, 5}, {2, 3}, {2, 4}, {2, 5}}));
  EXPECT_EQ(grid({}).size(), 1U);
  EXPECT_TRUE(grid({{1}, {}}).empty());
}

}  // namespace
}  // namespace gainsmith::search
