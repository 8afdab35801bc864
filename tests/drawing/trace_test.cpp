#include "drawing/trace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/random.h"
#include "drawing/extremes.h"

namespace gainsmith::drawing {
namespace {

/// 100 x 100 pixels for times from 0 to 10 and values from 0 to 1.
Trace traced(const Curve& curve) {
  return trace(curve, {false, 0, 10, {}, {}, 0}, {false, 0, 1, {}, {}, 0}, {0, 0, 100, 100});
}

Curve curve(std::vector<double> t, std::vector<double> value, std::vector<std::size_t> jumps = {}) {
  return {"", std::move(t), std::move(value), std::move(jumps), false, 0};
}

TEST(Trace, FlowsAreLinesAndJumpsAreBetween) {
  const Trace found = traced(curve({0, 2, 2, 5}, {0, 0.5, 0.2, 0.2}, {1}));
  EXPECT_EQ(found.flows,
            (std::vector<Polyline>{{{0, 1000}, {200, 500}}, {{200, 800}, {500, 800}}}));
  ASSERT_EQ(found.jumps.size(), 1);
  EXPECT_EQ(found.jumps[0].before, (Point{200, 500}));
  EXPECT_EQ(found.jumps[0].after, (Point{200, 800}));
  EXPECT_TRUE(found.dots.empty());
}

TEST(Trace, JumpsInARowAreAllThere) {
  const Trace found = traced(curve({0, 2, 2, 2, 2, 5}, {0, 0.5, 0.2, 0.9, 0.1, 0.2}, {1, 2, 3}));
  EXPECT_EQ(found.flows,
            (std::vector<Polyline>{{{0, 1000}, {200, 500}}, {{200, 900}, {500, 800}}}));
  EXPECT_EQ(found.dots, (Polyline{{200, 100}, {200, 800}}));
  ASSERT_EQ(found.jumps.size(), 3);
  EXPECT_EQ(found.jumps[2].before, (Point{200, 100}));
}

TEST(Trace, WhatDoesNotJumpGoesOn) {
  const Trace found = traced(curve({0, 2, 2, 5}, {0, 0.5, 0.5, 0.2}, {1}));
  EXPECT_EQ(found.flows, (std::vector<Polyline>{{{0, 1000}, {200, 500}, {500, 800}}}));
  EXPECT_TRUE(found.jumps.empty());
}

TEST(Trace, ValuesThatAreNotFiniteLeaveGaps) {
  for (const double value : {nan, infinite, -infinite}) {
    const Trace found = traced(curve({0, 1, 2, 3, 4, 5, 6}, {0, 0.1, value, 0.3, value, 0.5, 0.6}));
    EXPECT_EQ(found.flows,
              (std::vector<Polyline>{{{0, 1000}, {100, 900}}, {{500, 500}, {600, 400}}}));
    EXPECT_EQ(found.dots, (Polyline{{300, 700}}));
  }
  EXPECT_EQ(traced(curve({0, nan, 2, 3}, {0.5, 0.5, 0.5, 0.5})).flows.size(), 1);
}

TEST(Trace, JumpsToAGapAreNotDrawn) {
  const Trace found = traced(curve({0, 2, 2, 5, 5, 6}, {0, 0.5, nan, 0.2, 0.7, 0.7}, {1, 3}));
  EXPECT_EQ(found.flows.size(), 2);
  EXPECT_EQ(found.jumps.size(), 1);
}

TEST(Trace, OneSampleIsADot) {
  const Trace found = traced(curve({5}, {0.5}));
  EXPECT_TRUE(found.flows.empty());
  EXPECT_EQ(found.dots, (Polyline{{500, 500}}));
  EXPECT_TRUE(traced(curve({}, {})).dots.empty());
}

TEST(Trace, JumpsThatLeadNowhereAreIgnored) {
  EXPECT_EQ(traced(curve({0, 5}, {0, 0.5}, {1, 7})).flows.size(), 1);
}

TEST(Trace, OfALogarithmicAxisLeavesOutWhatIsNotPositive) {
  const Axis decades{true, -2, 0, {}, {}, 0};
  const Trace found = trace(curve({0, 1, 2, 3, 4, 5}, {1, 0.1, 0, -1, 0.1, 0.01}),
                            {false, 0, 10, {}, {}, 0}, decades, {0, 0, 100, 100});
  EXPECT_EQ(found.flows, (std::vector<Polyline>{{{0, 0}, {100, 500}}, {{400, 500}, {500, 1000}}}));
}

/// A sawtooth with noise: `jumps` teeth of `samples` samples each, with gaps now and then.
Curve teeth(RandomStream& draw, std::size_t jumps, std::size_t samples) {
  Curve made;
  double t = 0;
  const double step = 10.0 / static_cast<double>(jumps * samples);
  for (std::size_t j = 0; j < jumps; ++j) {
    if (j > 0) made.jumps.push_back(made.t.size() - 1);
    for (std::size_t k = 0; k < samples; ++k) {
      made.t.push_back(std::min(t, 10.0));
      made.value.push_back(draw.uniform() < 0.001 ? nan
                                                  : draw.uniform() * static_cast<double>(k) /
                                                        static_cast<double>(samples));
      if (k + 1 < samples) t += step;
    }
  }
  return made;
}

TEST(Trace, OfAnyCurveStaysInItsBoxWithAFewThousandPoints) {
  RandomStream draw(1, 0);
  const Box box{50, 20, 800, 300};
  for (const std::size_t jumps : {1, 40, 3000, 50000}) {
    const Curve dense = teeth(draw, jumps, 200000 / jumps);
    const Trace found = trace(dense, {false, 0, 10, {}, {}, 0}, {false, 0, 1, {}, {}, 0}, box);
    std::size_t points = found.dots.size() + 2 * found.jumps.size();
    int least = 1 << 30;
    for (const Polyline& line : found.flows) {
      points += line.size();
      ASSERT_GE(line.size(), 2);
      for (const Point& point : line) {
        ASSERT_TRUE(point.x >= 500 && point.x <= 8500 && point.y >= 200 && point.y <= 3200);
        least = std::min(least, point.y);
      }
    }
    EXPECT_LT(points, 9000) << jumps;
    double greatest = 0;
    for (const double value : dense.value)
      if (std::isfinite(value)) greatest = std::max(greatest, value);
    EXPECT_EQ(least, std::lround(3200 - 3000 * greatest)) << jumps;
  }
}

TEST(Trace, ManyJumpsOfAColumnAreOneVerticalThatHoldsThem) {
  RandomStream draw(2, 0);
  const Curve dense = teeth(draw, 20000, 3);
  const Trace found = traced(dense);
  EXPECT_LE(found.jumps.size(), 101);
  for (const std::size_t k : dense.jumps) {
    const double from = dense.value[k], to = dense.value[k + 1];
    if (!std::isfinite(from) || !std::isfinite(to) || std::abs(from - to) < 0.01) continue;
    const int column = static_cast<int>(std::lround(100 * dense.t[k])) / 10;
    const auto vertical =
        std::find_if(found.jumps.begin(), found.jumps.end(),
                     [&](const JumpTrace& jump) { return jump.before.x / 10 == column; });
    ASSERT_NE(vertical, found.jumps.end());
    const auto [low, high] = std::minmax(vertical->before.y, vertical->after.y);
    ASSERT_LE(low, std::lround(1000 - 1000 * std::max(from, to)));
    ASSERT_GE(high, std::lround(1000 - 1000 * std::min(from, to)));
  }
}

TEST(TraceInPlane, GoesInAnyDirectionAndJumpsAcross) {
  const Trace found =
      trace_in_plane(curve({2, 8, 4, 6, 5}, {0, 0, 0.5, 1, 1}, {2}), {false, 0, 10, {}, {}, 0},
                     {false, 0, 1, {}, {}, 0}, {0, 0, 100, 100});
  EXPECT_EQ(found.flows,
            (std::vector<Polyline>{{{200, 1000}, {800, 1000}, {400, 500}}, {{600, 0}, {500, 0}}}));
  ASSERT_EQ(found.jumps.size(), 1);
  EXPECT_EQ(found.jumps[0].before, (Point{400, 500}));
  EXPECT_EQ(found.jumps[0].after, (Point{600, 0}));
}

TEST(TraceInPlane, JumpsThatRepeatAreOne) {
  Curve cycle;
  for (int k = 0; k < 100; ++k) {
    cycle.t.insert(cycle.t.end(), {1, 9});
    cycle.value.insert(cycle.value.end(), {0.2, 0.2});
    cycle.jumps.push_back(static_cast<std::size_t>(2 * k + 1));
  }
  EXPECT_EQ(
      trace_in_plane(cycle, {false, 0, 10, {}, {}, 0}, {false, 0, 1, {}, {}, 0}, {0, 0, 100, 100})
          .jumps.size(),
      1);
}

}  // namespace
}  // namespace gainsmith::drawing
