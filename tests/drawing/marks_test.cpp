#include "drawing/marks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace gainsmith::drawing {
namespace {

const Box kBox{100, 10, 200, 50};

std::ptrdiff_t count(const std::vector<double>& times) {
  const std::string drawn = marks(times, linear_axis({0, 10, false}, 0, 5), kBox);
  return std::count(drawn.begin(), drawn.end(), 'M');
}

TEST(Marks, StandAtTheirTimesAtTheLowerEdge) {
  const std::string drawn = marks({0, 5, 10}, linear_axis({0, 10, false}, 0, 5), kBox);
  for (const char* tick : {"M100,60v-5", "M200,60v-5", "M300,60v-5"})
    EXPECT_NE(drawn.find(tick), std::string::npos) << drawn;
}

TEST(Marks, OfManyOnlyThoseThatCanBeTold) {
  std::vector<double> many;
  for (int k = 0; k <= 100000; ++k) many.push_back(k * 1e-4);
  EXPECT_LE(count(many), 67);
  EXPECT_GE(count(many), 50);
  EXPECT_EQ(count({1, 1, 1, 9}), 2);
}

TEST(Marks, NoneWithoutTimesThatTheAxisShows) {
  EXPECT_EQ(count({}), 0);
  EXPECT_EQ(count({-1, 11, std::numeric_limits<double>::quiet_NaN()}), 0);
}

}  // namespace
}  // namespace gainsmith::drawing
