#include "gainsmith/level_curves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gainsmith::app {
namespace {

constexpr Window kWindow{{-2, -2}, {2, 2}};

TEST(LevelCurves, ACircleIsOneClosedCurveInsideTheWindow) {
  const LevelCurves found =
      zero_curves([](double x, double y) { return x * x + y * y - 1; }, kWindow);
  EXPECT_TRUE(found.inside);
  ASSERT_EQ(found.curves.size(), 1U);
  const auto& curve = found.curves.front();
  EXPECT_EQ(curve.front().x, curve.back().x);
  EXPECT_EQ(curve.front().y, curve.back().y);
  double length = 0;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    EXPECT_NEAR(std::hypot(curve[k].x, curve[k].y), 1, 2e-4);
    if (k > 0) length += std::hypot(curve[k].x - curve[k - 1].x, curve[k].y - curve[k - 1].y);
  }
  EXPECT_NEAR(length, 2 * 3.14159265, 5e-3);
}

TEST(LevelCurves, ACurveThatLeavesTheWindowIsNotInside) {
  const LevelCurves found = zero_curves([](double x, double y) { return y - x * x; }, kWindow);
  EXPECT_FALSE(found.inside);
  ASSERT_EQ(found.curves.size(), 1U);
  EXPECT_NEAR(found.curves.front().front().y, 2, 1e-3);
  EXPECT_NEAR(found.curves.front().back().y, 2, 1e-3);
}

TEST(LevelCurves, BranchesThatMeetInOneCellAreJoinedAsItsMiddleSays) {
  // Around the saddle of x*y the branches of x*y = c lie in the quadrants of the sign of c.
  for (const double c : {1e-7, -1e-7}) {
    const LevelCurves found =
        zero_curves([&](double x, double y) { return (x - 0.01) * (y - 0.01) - c; }, kWindow);
    ASSERT_EQ(found.curves.size(), 2U);
    for (const auto& curve : found.curves) {
      const PlanePoint first = curve.front(), last = curve.back();
      EXPECT_GT((first.x - 0.01) * (last.x - 0.01) + (first.y - 0.01) * (last.y - 0.01), -0.1);
    }
  }
}

TEST(LevelCurves, ThereIsNoneWhereThereIsNoValueOrNoZero) {
  EXPECT_TRUE(zero_curves([](double, double) { return 1.0; }, kWindow).curves.empty());
  EXPECT_FALSE(zero_curves([](double, double) { return 1.0; }, kWindow).inside);
  const auto half = [](double x, double y) {
    return x < 0 ? std::numeric_limits<double>::quiet_NaN() : x * x + y * y - 1;
  };
  const LevelCurves found = zero_curves(half, kWindow);
  EXPECT_FALSE(found.inside);
  for (const auto& curve : found.curves)
    for (const PlanePoint& point : curve) EXPECT_GE(point.x, 0);
}

}  // namespace
}  // namespace gainsmith::app
