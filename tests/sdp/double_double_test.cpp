#include "sdp/double_double.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gainsmith::sdp {
namespace {

constexpr double kUnit = 0x1p-100;

TEST(DoubleDouble, KeepsWhatDoubleLoses) {
  const DoubleDouble one(1), tiny(0x1p-80);
  EXPECT_EQ(((one + tiny) - one).hi(), 0x1p-80);
  EXPECT_EQ(((one + tiny) * (one - tiny) - one).hi(), -0x1p-160 * 0);
}

TEST(DoubleDouble, DividesAndTakesRoots) {
  const DoubleDouble third = DoubleDouble(1) / DoubleDouble(3);
  EXPECT_LT(std::abs((third * 3.0 - DoubleDouble(1)).hi()), kUnit);
  const DoubleDouble root = sqrt(DoubleDouble(2));
  EXPECT_LT(std::abs((root * root - DoubleDouble(2)).hi()), 4 * kUnit);
  EXPECT_EQ(sqrt(DoubleDouble(0)).hi(), 0);
}

TEST(DoubleDouble, OrdersByBothHalves) {
  const DoubleDouble a(1), b(1, 0x1p-80);
  EXPECT_TRUE(a < b);
  EXPECT_TRUE(b > a);
  EXPECT_TRUE(a <= a);
  EXPECT_FALSE(a == b);
  EXPECT_EQ(abs(-b), b);
}

}  // namespace
}  // namespace gainsmith::sdp
