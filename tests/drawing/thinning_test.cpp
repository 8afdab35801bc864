#include "drawing/thinning.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/random.h"

namespace gainsmith::drawing {
namespace {

struct Column {
  int least = 1 << 30;
  int greatest = -(1 << 30);
  int first = 0;
  int last = 0;
  std::size_t points = 0;
};

std::map<int, Column> columns_of(const std::vector<Polyline>& lines) {
  std::map<int, Column> columns;
  for (const Polyline& line : lines)
    for (const Point& point : line) {
      Column& column = columns[point.x / 10];
      column.least = std::min(column.least, point.y);
      column.greatest = std::max(column.greatest, point.y);
      if (column.points++ == 0) column.first = point.y;
      column.last = point.y;
    }
  return columns;
}

void expect_same_extremes(const std::vector<Polyline>& lines, const std::vector<Polyline>& kept) {
  const auto before = columns_of(lines), after = columns_of(kept);
  ASSERT_EQ(before.size(), after.size());
  for (const auto& [x, column] : before) {
    ASSERT_EQ(after.at(x).least, column.least) << x;
    ASSERT_EQ(after.at(x).greatest, column.greatest) << x;
    ASSERT_EQ(after.at(x).first, column.first) << x;
    ASSERT_EQ(after.at(x).last, column.last) << x;
  }
}

/// A walk over 200 columns, `points` of them a column on average; a new line with the probability
/// `breaks`.
std::vector<Polyline> walk(RandomStream& draw, double points, double breaks) {
  std::vector<Polyline> lines(1);
  int y = 500;
  double x = 0;
  while (x < 2000) {
    if (!lines.back().empty() && draw.uniform() < breaks) lines.emplace_back();
    y += static_cast<int>(std::lround(60 * (draw.uniform() - 0.5)));
    lines.back().push_back({static_cast<int>(x), y});
    x += 20 / points * draw.uniform();
  }
  return lines;
}

bool is_part_of(const Polyline& part, const Polyline& whole) {
  auto at = whole.begin();
  for (const Point& point : part) {
    at = std::find(at, whole.end(), point);
    if (at == whole.end()) return false;
    ++at;
  }
  return true;
}

TEST(Thinned, KeepsTheExtremesOfEachColumn) {
  RandomStream draw(1, 0);
  for (int k = 0; k < 50; ++k) {
    const auto lines = walk(draw, 1 + 60 * draw.uniform(), 0);
    const auto kept = thinned(lines);
    ASSERT_EQ(kept.size(), 1);
    expect_same_extremes(lines, kept);
    ASSERT_TRUE(is_part_of(kept[0], lines[0]));
    for (const auto& [x, column] : columns_of(kept)) ASSERT_LE(column.points, 4);
  }
}

TEST(Thinned, KeepsThemWhereLinesEnd) {
  RandomStream draw(2, 0);
  for (int k = 0; k < 50; ++k) {
    const auto lines = walk(draw, 1 + 60 * draw.uniform(), draw.uniform());
    const auto kept = thinned(lines);
    expect_same_extremes(lines, kept);
    for (const Polyline& line : kept) ASSERT_FALSE(line.empty());
    for (const auto& [x, column] : columns_of(kept)) ASSERT_LE(column.points, 16);
  }
}

TEST(Thinned, LeavesFewPointsAsTheyAre) {
  const std::vector<Polyline> lines = {{{0, 0}, {5, 7}, {30, 2}}, {{30, 9}, {80, 1}}, {{100, 3}}};
  EXPECT_EQ(thinned(lines), lines);
  EXPECT_TRUE(thinned({}).empty());
}

TEST(Thinned, LinesWithinAColumnKeepWhereTheyAre) {
  EXPECT_EQ(thinned({{{0, 0}, {51, 5}}, {{52, 90}, {53, 10}}, {{55, 4}, {90, 4}}}),
            (std::vector<Polyline>{{{0, 0}, {51, 5}}, {{52, 10}, {53, 90}}, {{55, 4}, {90, 4}}}));
}

TEST(Thinned, ChatteringShowsItsLevels) {
  std::vector<Polyline> lines(1000);
  for (int x = 0; x < 1000; ++x) lines[static_cast<std::size_t>(x)] = {{x, x % 2 == 0 ? 300 : 700}};
  for (const Polyline& line : thinned(lines))
    for (const Point& point : line) {
      ASSERT_EQ(line.front().y, point.y);
      ASSERT_TRUE(point.y == 300 || point.y == 700);
    }
}

/// How far upwards or downwards a point is from a line that is a function of x around it.
double distance(const Polyline& line, const Point& point) {
  double nearest = 1e9;
  for (std::size_t k = 0; k + 1 < line.size(); ++k) {
    const Point a = line[k], b = line[k + 1];
    if (point.x < a.x || point.x > b.x) continue;
    if (a.x == b.x) {
      const auto [low, high] = std::minmax(a.y, b.y);
      nearest = std::min(nearest, std::max({0.0, double(low - point.y), double(point.y - high)}));
    } else {
      const double y = a.y + double(b.y - a.y) * (point.x - a.x) / (b.x - a.x);
      nearest = std::min(nearest, std::abs(point.y - y));
    }
  }
  return nearest;
}

TEST(Coarser, StaysWithinItsTolerance) {
  RandomStream draw(3, 0);
  for (int k = 0; k < 200; ++k) {
    Polyline line;
    const double size = 1 + 300 * draw.uniform(), pitch = 10 + 400 * draw.uniform();
    const double noise = k % 4 == 0 ? 5 : 0, step = 1 + 10 * draw.uniform();
    double x = 0;
    while (x < 3000) {
      const double y = size * std::sin(x / pitch) + noise * draw.uniform();
      line.push_back({static_cast<int>(x), static_cast<int>(std::lround(y))});
      x += step;
    }
    const Polyline kept = coarser(line);
    ASSERT_TRUE(is_part_of(kept, line));
    ASSERT_EQ(kept.front(), line.front());
    ASSERT_EQ(kept.back(), line.back());
    // Along steep lines more upwards than across.
    const double steep = std::hypot(1, 1.5 * size / pitch + noise);
    for (const Point& point : line) ASSERT_LE(distance(kept, point), kShown * steep + 1e-9);
  }
}

TEST(Coarser, LeavesTheEndsOfStraightLines) {
  RandomStream draw(4, 0);
  for (int k = 0; k < 500; ++k) {
    const double slope = std::tan(3 * (draw.uniform() - 0.5));
    Polyline line;
    for (int x = 0; x <= 2000; x += 1 + static_cast<int>(20 * draw.uniform()))
      line.push_back({x, static_cast<int>(std::lround(slope * x))});
    ASSERT_LE(coarser(line).size(), 3) << slope;
  }
}

TEST(Coarser, UprightLinesKeepTheirEnds) {
  EXPECT_EQ(coarser({{5, 0}, {5, 3}, {5, 9}, {5, 4}, {5, 20}, {50, 20}}),
            (Polyline{{5, 0}, {5, 20}, {50, 20}}));
}

TEST(Coarser, OnePointStaysOne) {
  EXPECT_EQ(coarser({{3, 4}, {3, 4}, {3, 4}}), (Polyline{{3, 4}}));
  EXPECT_TRUE(coarser({}).empty());
}

TEST(Coarser, SmoothCurvesNeedFewPoints) {
  Polyline line;
  for (int x = 0; x < 8000; ++x)
    line.push_back({x, static_cast<int>(std::lround(1000 * std::sin(x / 400.0)))});
  EXPECT_LT(coarser(line).size(), 250);
}

double distance(const Point& point, const Point& from, const Point& to) {
  const double dx = to.x - from.x, dy = to.y - from.y, x = point.x - from.x, y = point.y - from.y;
  const double square = dx * dx + dy * dy;
  const double share = square > 0 ? std::clamp((x * dx + y * dy) / square, 0.0, 1.0) : 0.0;
  return std::hypot(x - share * dx, y - share * dy);
}

TEST(Simplified, PassesEachPointOfACurveInAnyDirection) {
  Polyline spiral;
  for (int k = 0; k < 5000; ++k) {
    const double angle = 0.01 * k, radius = 3000 * std::exp(-0.05 * angle);
    spiral.push_back({static_cast<int>(std::lround(4000 + radius * std::cos(angle))),
                      static_cast<int>(std::lround(4000 + radius * std::sin(angle)))});
  }
  ASSERT_EQ(simplified(spiral).size(), 1);
  const Polyline few = simplified(spiral).front();
  EXPECT_LT(few.size(), 1500);
  EXPECT_EQ(few.front(), spiral.front());
  EXPECT_EQ(few.back(), spiral.back());
  for (const Point& point : spiral) {
    double nearest = 1e9;
    for (std::size_t k = 1; k < few.size(); ++k)
      nearest = std::min(nearest, distance(point, few[k - 1], few[k]));
    ASSERT_LE(nearest, 3);
  }
}

TEST(Simplified, KeepsTheWayBack) {
  EXPECT_EQ(simplified({{0, 0}, {500, 0}, {1000, 0}, {400, 0}}),
            (std::vector<Polyline>{{{0, 0}, {1000, 0}, {400, 0}}}));
  EXPECT_TRUE(simplified({}).empty());
  EXPECT_EQ(simplified({{3, 4}}), (std::vector<Polyline>{{{3, 4}}}));
  EXPECT_EQ(simplified({{3, 4}, {3, 4}}), (std::vector<Polyline>{{{3, 4}}}));
}

std::size_t points_of(const std::vector<Polyline>& lines) {
  std::size_t points = 0;
  for (const Polyline& line : lines) points += line.size();
  return points;
}

TEST(Simplified, OfNoiseKeepsThousandsOfPoints) {
  RandomStream draw(1, 0);
  Polyline noise;
  for (int k = 0; k < 100000; ++k)
    noise.push_back(
        {static_cast<int>(8000 * draw.uniform()), static_cast<int>(3000 * draw.uniform())});
  EXPECT_LE(points_of(simplified(noise)), 50000);
  EXPECT_GE(points_of(simplified(noise)), 1000);
}

TEST(Simplified, OfAnOrbitThatReturnsIsDrawnOnce) {
  Polyline orbit;
  for (int k = 0; k < 300000; ++k)
    orbit.push_back({static_cast<int>(std::lround(4000 + 3000 * std::cos(0.01 * k))),
                     static_cast<int>(std::lround(2000 + 1500 * std::sin(0.01 * k)))});
  const auto parts = simplified(orbit);
  EXPECT_LT(points_of(parts), 20000);
  int left = 1 << 30, right = 0;
  for (const Polyline& part : parts)
    for (const Point& point : part) {
      left = std::min(left, point.x);
      right = std::max(right, point.x);
    }
  EXPECT_EQ(left, 1000);
  EXPECT_EQ(right, 7000);
}

}  // namespace
}  // namespace gainsmith::drawing
