#include "search/minimize.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <stdexcept>

#include "base/stop.h"
#include "search/nlopt.h"

namespace gainsmith::search {
namespace {

double rosenbrock(const Point& x) {
  return 100 * std::pow(x[1] - x[0] * x[0], 2) + std::pow(1 - x[0], 2);
}

TEST(Minimize, FindsTheBottomOfACurvedValley) {
  MinimizeOptions options;
  options.evaluations = 600;
  options.tolerance = 1e-7;
  const Minimum found = minimize([](const Point& x) { return rosenbrock(x); },
                                 {axis(-2, 2), axis(-1, 3)}, nlopt_search(), options);
  ASSERT_TRUE(found.point);
  EXPECT_NEAR((*found.point)[0], 1, 1e-3);
  EXPECT_NEAR((*found.point)[1], 1, 2e-3);
  EXPECT_TRUE(found.finished);
}

/// The minimum lies on the border of the feasible set: x + y >= 1 in logarithmic coordinates.
TEST(Minimize, StopsAtTheBoundaryOfWhatIsFeasible) {
  const Figure figure = [](const Point& x) -> std::optional<double> {
    if (x[0] + x[1] < 1) return std::nullopt;
    return x[0] * x[0] + 4 * x[1] * x[1];
  };
  const Minimum found =
      minimize(figure, {axis(1e-2, 10), axis(1e-2, 10)}, nlopt_search(), MinimizeOptions{});
  ASSERT_TRUE(found.point);
  EXPECT_GE((*found.point)[0] + (*found.point)[1], 1);
  EXPECT_NEAR(found.value, 0.8, 1e-2);
  EXPECT_LT(found.feasible, found.evaluations);
}

TEST(Minimize, OneScalarAndAMinimumAtAnEnd) {
  const Minimum inside = minimize([](const Point& x) { return std::cosh(x[0] - 0.3); },
                                  {axis(-5, 5)}, nlopt_search(), MinimizeOptions{});
  EXPECT_NEAR((*inside.point)[0], 0.3, 1e-3);
  const Minimum end = minimize([](const Point& x) { return x[0]; }, {axis(1e-3, 10)},
                               nlopt_search(), MinimizeOptions{});
  EXPECT_NEAR(end.value, 1e-3, 1e-6);
}

TEST(Minimize, TheDeeperOfTwoValleysIsFound) {
  const auto figure = [](const Point& x) {
    return std::min(std::pow(x[0] - 0.2, 2), std::pow(x[0] - 0.85, 2) - 0.001);
  };
  const Minimum found = minimize(figure, {axis(0, 1)}, nlopt_search(), MinimizeOptions{});
  EXPECT_NEAR((*found.point)[0], 0.85, 1e-3);
}

/// No cell is feasible: the violation leads there.
TEST(Minimize, TheViolationLeadsToAFeasiblePoint) {
  const auto distance = [](const Point& x) { return std::hypot(x[0] - 0.13, x[1] - 0.77); };
  const Figure figure = [&](const Point& x) -> std::optional<double> {
    if (distance(x) > 0.01) return std::nullopt;
    return x[0];
  };
  MinimizeOptions options;
  EXPECT_FALSE(minimize(figure, {axis(0, 1), axis(0, 1)}, nlopt_search(), options).point);
  options.violation = distance;
  const Minimum found = minimize(figure, {axis(0, 1), axis(0, 1)}, nlopt_search(), options);
  ASSERT_TRUE(found.point);
  EXPECT_LT(found.value, 0.125);
}

TEST(Minimize, ThreadsDoNotChangeTheResult) {
  const auto run = [](unsigned threads) {
    MinimizeOptions options;
    options.threads = threads;
    return minimize([](const Point& x) { return rosenbrock(x); }, {axis(-2, 2), axis(-1, 3)},
                    nlopt_search(), options);
  };
  const Minimum one = run(1);
  const Minimum four = run(4);
  EXPECT_EQ(one.point, four.point);
  EXPECT_EQ(one.value, four.value);
  EXPECT_EQ(one.evaluations, four.evaluations);
}

TEST(Minimize, KeepsToItsEvaluationsAndEndsWhenItIsStopped) {
  std::atomic<int> calls = 0;
  const Figure figure = [&](const Point& x) {
    ++calls;
    return rosenbrock(x);
  };
  for (const int most : {1, 7, 50}) {
    MinimizeOptions options;
    options.evaluations = most;
    calls = 0;
    const Minimum found = minimize(figure, {axis(-2, 2), axis(-1, 3)}, nlopt_search(), options);
    EXPECT_LE(calls, most);
    EXPECT_EQ(found.evaluations, calls);
    EXPECT_TRUE(found.point);
  }
  for (const int most : {3, 80}) {
    const Figure stopped = [&](const Point& x) {
      if (calls >= most) throw Stopped();
      return figure(x);
    };
    calls = 0;
    const Minimum cut = minimize(stopped, {axis(-2, 2), axis(-1, 3)}, nlopt_search(), {});
    EXPECT_FALSE(cut.finished);
    EXPECT_EQ(cut.evaluations, most);
    ASSERT_TRUE(cut.point);
    EXPECT_EQ(cut.value, rosenbrock(*cut.point));
  }
}

TEST(Minimize, AStartIsTriedAndAnExceptionComesThrough) {
  MinimizeOptions options;
  options.evaluations = 1;
  options.starts = {{0.25}};
  const auto found =
      minimize([](const Point& x) { return x[0]; }, {axis(0, 1)}, nlopt_search(), options);
  EXPECT_EQ(found.value, 0.25);
  int calls = 0;
  const Figure failing = [&](const Point&) -> std::optional<double> {
    if (++calls > 70) throw std::runtime_error("out of reach");
    return 1.0 / calls;
  };
  EXPECT_THROW(minimize(failing, {axis(0, 1)}, nlopt_search(), MinimizeOptions{}),
               std::runtime_error);
}

/// From the bottom of one valley to the deeper one at the other side of the box, by the same points
/// for the same seed.
TEST(GlobalSearch, LeavesTheValleyInWhichItStarts) {
  const auto searched = [](unsigned long seed) {
    std::vector<Point> tried;
    LocalSearchOptions options;
    options.evaluations = 400;
    nlopt_global_search(seed)(
        [&](const Point& x) {
          tried.push_back(x);
          return std::min(0.3 + std::hypot(x[0] - 0.1, x[1] - 0.1),
                          2 * std::hypot(x[0] - 0.8, x[1] - 0.7));
        },
        {0.1, 0.1}, options, [] { return true; });
    return tried;
  };
  const std::vector<Point> tried = searched(1);
  EXPECT_NEAR(static_cast<double>(tried.size()), 400, 10);
  EXPECT_EQ(tried.front(), (Point{0.1, 0.1}));
  double nearest = 1;
  for (const Point& x : tried)
    nearest = std::min(nearest, std::hypot(x[0] - 0.8, x[1] - 0.7));
  EXPECT_LT(nearest, 1e-2);
  EXPECT_EQ(searched(1), tried);
  EXPECT_NE(searched(2), tried);
}

}  // namespace
}  // namespace gainsmith::search
