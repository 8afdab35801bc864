#include "forall/midpoints.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/random.h"
#include "forall/variables.h"

namespace gainsmith::forall {
namespace {

using testing::imposed_at;
using testing::interval;
using testing::number;
using testing::times_of;

TEST(MidpointsTest, WideGapsHaveTheirMiddle) {
  const Domain domain = {interval("tau", 0, 10)};
  // Equidistant they would be 2.5 apart: the gap from 8 to 9 is narrow.
  const auto found = midpoints(imposed_at({8, 0, 10, 4, 9}), domain);
  EXPECT_EQ(times_of(found), (std::vector<double>{2, 6}));
  EXPECT_EQ(found[0].label, "tau = 2");
  EXPECT_TRUE(midpoints(imposed_at({3}), domain).empty());
  EXPECT_TRUE(midpoints(imposed_at({}), domain).empty());
}

/// Whatever the points: new ones lie between, the widest gap is halved, and so on to any density.
TEST(MidpointsTest, TheWidestGapIsHalved) {
  const Domain domain = {interval("tau", 0, 1)};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random(0x902, seed);
    Imposed imposed = imposed_at({0, 1});
    for (int k = 0; k < 12; ++k)
      add_point(imposed, domain, extended({}, "tau", random.uniform() * random.uniform()));
    const auto widest = [&] {
      std::vector<double> times = times_of(imposed.points);
      std::sort(times.begin(), times.end());
      double gap = 0;
      for (std::size_t k = 1; k < times.size(); ++k) gap = std::max(gap, times[k] - times[k - 1]);
      return gap;
    };
    const double before = widest();
    const std::size_t points = imposed.points.size();
    for (const Point& point : midpoints(imposed, domain))
      EXPECT_TRUE(add_point(imposed, domain, point)) << point.label;
    EXPECT_GT(imposed.points.size(), points);
    EXPECT_LT(imposed.points.size(), 2 * points);
    // A gap that was not halved is at most half of the mean one, and the widest at least that.
    EXPECT_LE(widest(), before / 2 * (1 + 1e-12)) << seed;
  }
}

TEST(MidpointsTest, ElementsOfSetsAreApart) {
  const Domain domain = {testing::set("k", {number(7), number(8)}), interval("tau", 0, 10)};
  const std::vector<Point> elements = combinations(domain, model::Over::set);
  Imposed imposed;
  for (const double tau : {0.0, 4.0}) imposed.points.push_back(extended(elements[0], "tau", tau));
  for (const double tau : {1.0, 7.0}) imposed.points.push_back(extended(elements[1], "tau", tau));
  const auto found = midpoints(imposed, domain);
  EXPECT_EQ(times_of(found), (std::vector<double>{2, 4}));
  EXPECT_EQ(found[1].label, "k = 2, tau = 4");
  EXPECT_EQ(found[1].values.at("k")(0, 0), 8);
}

TEST(MidpointsTest, BoxesOfIntervalsHaveNone) {
  const Domain domain = {interval("s", 0, 1), interval("t", 0, 1)};
  Imposed imposed;
  imposed.points = first_points(domain);
  EXPECT_TRUE(midpoints(imposed, domain).empty());
}

}  // namespace
}  // namespace gainsmith::forall
