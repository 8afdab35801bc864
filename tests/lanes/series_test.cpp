#include "lanes/series.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "lanes/variants.h"

namespace gainsmith::lanes {
namespace {

using numbers::ScalarGraph;
using numbers::ScalarOp;
constexpr std::uint32_t kAll = ~0U;

/// Values of all lanes.
using Values = std::vector<double>;
Values start(const std::vector<double>& of_lane_0, double apart = 0) {
  Values values;
  for (std::size_t k = 0; k < of_lane_0.size(); ++k)
    for (std::size_t l = 0; l < kLanes; ++l)
      values.push_back(of_lane_0[k] + apart * static_cast<double>(l));
  return values;
}

/// A function of the time, which is input 0, and of input 1, which rests.
struct FunctionOfTime {
  std::string name;
  std::function<int(ScalarGraph&, int, int)> node;
  std::function<double(double, double)> value;
  double from;  ///< a time beside which its series converges within 1
};

const std::vector<FunctionOfTime>& functions() {
  using G = ScalarGraph;
  static const std::vector<FunctionOfTime> all = {
      {"add", [](G& g, int t, int c) { return g.add(g.multiply(t, t), c); },
       [](double t, double c) { return t * t + c; }, 2},
      {"subtract", [](G& g, int t, int c) { return g.subtract(c, g.multiply(t, t)); },
       [](double t, double c) { return c - t * t; }, 2},
      {"multiply", [](G& g, int t, int c) { return g.multiply(g.add(t, c), g.multiply(t, t)); },
       [](double t, double c) { return (t + c) * t * t; }, 2},
      {"divide", [](G& g, int t, int c) { return g.divide(c, t); },
       [](double t, double c) { return c / t; }, 4},
      {"divide by still", [](G& g, int t, int c) { return g.divide(t, c); },
       [](double t, double c) { return t / c; }, 2},
      {"negate", [](G& g, int t, int) { return g.negate(t); }, [](double t, double) { return -t; },
       2},
      {"square root", [](G& g, int t, int c) { return g.apply(ScalarOp::sqrt, g.add(t, c)); },
       [](double t, double c) { return std::sqrt(t + c); }, 4},
      {"exp", [](G& g, int t, int c) { return g.apply(ScalarOp::exp, g.multiply(c, t)); },
       [](double t, double c) { return std::exp(c * t); }, 0.5},
      {"log", [](G& g, int t, int c) { return g.apply(ScalarOp::log, g.multiply(c, t)); },
       [](double t, double c) { return std::log(c * t); }, 4},
      {"power", [](G& g, int t, int c) { return g.apply(ScalarOp::power, t, c); },
       [](double t, double c) { return std::pow(t, c); }, 4},
      {"sin", [](G& g, int t, int c) { return g.apply(ScalarOp::sin, g.multiply(c, t)); },
       [](double t, double c) { return std::sin(c * t); }, 2},
      {"cos", [](G& g, int t, int c) { return g.apply(ScalarOp::cos, g.multiply(c, t)); },
       [](double t, double c) { return std::cos(c * t); }, 2},
      {"sin beside cos",
       [](G& g, int t, int) {
         return g.multiply(g.apply(ScalarOp::cos, t), g.apply(ScalarOp::sin, t));
       },
       [](double t, double) { return std::sin(2 * t) / 2; }, 2},
      {"tanh",
       [](G& g, int t, int) { return g.apply(ScalarOp::tanh, g.multiply(g.constant(0.25), t)); },
       [](double t, double) { return std::tanh(t / 4); }, 0.3},
      {"angle", [](G& g, int t, int c) { return g.apply(ScalarOp::angle, t, g.add(c, t)); },
       [](double t, double c) { return std::atan2(t, c + t); }, 4},
      {"abs", [](G& g, int t, int c) { return g.apply(ScalarOp::abs, g.subtract(c, t)); },
       [](double t, double c) { return std::abs(c - t); }, 2},
      {"sign", [](G& g, int t, int c) { return g.apply(ScalarOp::sign, g.subtract(c, t)); },
       [](double t, double c) { return t < c ? 1.0 : -1.0; }, 2},
      {"minimum",
       [](G& g, int t, int c) { return g.apply(ScalarOp::minimum, g.multiply(t, t), c); },
       [](double t, double c) { return std::min(t * t, c); }, 2},
      {"maximum",
       [](G& g, int t, int c) { return g.apply(ScalarOp::maximum, c, g.multiply(t, t)); },
       [](double t, double c) { return std::max(t * t, c); }, 0.7},
      {"where",
       [](G& g, int t, int c) { return g.where(true, g.subtract(t, c), c, g.multiply(t, t)); },
       [](double t, double c) { return t > c ? c : t * t; }, 1}};
  return all;
}

TEST(Series, AreThoseOfEveryFunction) {
  constexpr double c = 1.75, length = 0.25;
  for (const Variant* variant : variants())
    for (const FunctionOfTime& one : functions()) {
      ScalarGraph graph;
      const int t = graph.input(0), still = graph.input(1), rate = graph.constant(1);
      const auto code = SeriesCode::make(graph, 2, {0}, {rate}, {one.node(graph, t, still)});
      ASSERT_TRUE(code) << one.name;
      SeriesMachine machine(*code, *variant);
      Values values = start({one.from, c}, 0);
      for (std::size_t l = 0; l < kLanes; ++l) values[l] += 0.01 * static_cast<double>(l);
      machine.run(values.data(), kAll);
      std::array<double, kLanes> lengths{};
      lengths.fill(length);
      machine.follow(lengths.data(), kAll);
      for (std::size_t l = 0; l < kLanes; ++l) {
        EXPECT_EQ(lengths[l], length) << one.name;
        const auto along = machine.followed(0, l, length);
        for (const double share : {0.0, 0.3, 1.0}) {
          const double exact = one.value(values[l] + share * length, c);
          EXPECT_NEAR(along(share), exact, 2e-14 * (1 + std::abs(exact)) + along.error())
              << one.name << " " << l << " " << variant->name;
        }
        EXPECT_LT(along.error(), 1e-12) << one.name;
      }
    }
}

TEST(Series, FollowFlows) {
  // A pendulum and its energy, x' = x (1 - x), and x' = -x.
  ScalarGraph graph;
  const int q = graph.input(0), v = graph.input(1), x = graph.input(2), z = graph.input(3);
  const std::vector<int> rates = {v, graph.negate(graph.apply(ScalarOp::sin, q)),
                                  graph.multiply(x, graph.subtract(graph.constant(1), x)),
                                  graph.negate(z)};
  const int energy = graph.subtract(graph.multiply(graph.constant(0.5), graph.multiply(v, v)),
                                    graph.apply(ScalarOp::cos, q));
  const auto code = SeriesCode::make(graph, 4, {0, 1, 2, 3}, rates, {energy});
  ASSERT_TRUE(code);
  SeriesMachine machine(*code);
  Values values = start({0.5, 0.1, 0.2, 3}, 0.01), lengths(kLanes, 0.1);
  const Values first = values;
  for (int step = 0; step < 20; ++step) {
    machine.run(values.data(), kAll);
    machine.follow(lengths.data(), kAll);
    for (std::size_t l = 0; l < kLanes; ++l)
      EXPECT_NEAR(machine.followed(0, l, 0.1)(1), machine.followed(0, l, 0.1)(0), 1e-14);
    machine.values(lengths.data(), kOrder, kAll, values.data());
  }
  for (std::size_t l = 0; l < kLanes; ++l) {
    const double x0 = first[2 * kLanes + l], grown = x0 * std::exp(2.0);
    EXPECT_NEAR(values[2 * kLanes + l], grown / (1 - x0 + grown), 1e-13);
    EXPECT_NEAR(values[3 * kLanes + l], first[3 * kLanes + l] * std::exp(-2.0), 1e-13);
  }
}

TEST(Series, EndWhereAFlowIsAPolynomial) {
  ScalarGraph graph;
  const int v = graph.input(1), u = graph.input(2);
  const auto code = SeriesCode::make(graph, 3, {0, 1}, {v, u}, {graph.input(0)});
  ASSERT_TRUE(code);
  SeriesMachine machine(*code);
  const Values values = start({1, 2, -9.81});
  machine.run(values.data(), kAll);
  const auto along = machine.followed(0, 5, 3);
  EXPECT_EQ(along.coefficients().size(), 3U);
  EXPECT_EQ(along.error(), 0);
  EXPECT_NEAR(along(1), 1 + 3 * 2 - 9.81 * 4.5, 1e-14);
  Values lengths(kLanes, 3), last(kLanes), before(kLanes);
  machine.growth({1e-10, 1e-10}, lengths.data(), kAll, last.data(), before.data());
  EXPECT_EQ(last[7], 0);
  EXPECT_EQ(before[7], 0);
}

TEST(Series, TellHowFastTheirTermsFall) {
  ScalarGraph graph;
  const int x = graph.input(0);
  const auto code = SeriesCode::make(graph, 1, {0}, {graph.negate(x)}, {});
  SeriesMachine machine(*code);
  const Values values = start({2});
  machine.run(values.data(), kAll);
  Values lengths(kLanes, 0.5), last(kLanes), before(kLanes);
  machine.growth({0}, lengths.data(), kAll, last.data(), before.data());
  const double scale = 2 * (1 + 0.5 + 0.125);
  EXPECT_NEAR(last[3] * scale * std::tgamma(kOrder + 1), 2, 1e-13);
  EXPECT_NEAR(before[3] * scale * std::tgamma(kOrder), 2, 1e-13);
}

TEST(Series, GoUpToABranch) {
  // |1 - t| + |2 - t| of t from 0 on: to 1 first, then to 2.
  ScalarGraph graph;
  const int t = graph.input(0);
  const auto size = [&](double c) {
    return graph.apply(ScalarOp::abs, graph.subtract(graph.constant(c), t));
  };
  const auto code =
      SeriesCode::make(graph, 1, {0}, {graph.constant(1)}, {graph.add(size(2), size(1))});
  SeriesMachine machine(*code);
  const std::vector<std::pair<double, double>> steps = {{0, 3}, {1, 1}, {2, 1}};
  double at = 0;
  for (const auto& [time, value] : steps) {
    EXPECT_NEAR(at, time, 1e-14);
    const Values values = start({at});
    Values lengths(kLanes, 3);
    machine.run(values.data(), kAll);
    machine.follow(lengths.data(), kAll);
    EXPECT_NEAR(machine.followed(0, 9, lengths[9])(0), value, 1e-14);
    at += lengths[9];
  }
  EXPECT_NEAR(at, 5, 1e-14);
}

TEST(Series, AreTheSameBitsWithTheSameRounding) {
  const Variant *v3 = find_variant("v3"), *v4 = find_variant("v4");
  if (v3 == nullptr || v4 == nullptr) GTEST_SKIP() << "a machine without AVX-512";
  ScalarGraph graph;
  const int x = graph.input(0), y = graph.input(1);
  const std::vector<int> rates = {graph.apply(ScalarOp::sin, y),
                                  graph.divide(x, graph.apply(ScalarOp::exp, y))};
  const auto code = SeriesCode::make(graph, 2, {0, 1}, rates, {});
  const Values values = start({0.3, -0.7}, 0.1), lengths(kLanes, 0.2);
  Values ends[2];
  for (const Variant* one : {v3, v4}) {
    SeriesMachine machine(*code, *one);
    machine.run(values.data(), kAll);
    Values& end = ends[one == v4 ? 1 : 0];
    end.resize(2 * kLanes);
    machine.values(lengths.data(), kOrder, kAll, end.data());
  }
  EXPECT_EQ(std::memcmp(ends[0].data(), ends[1].data(), ends[0].size() * sizeof(double)), 0);
}

TEST(Series, AreNoneOfWhatHasNoRecurrence) {
  const auto has = [](const auto& rate_of) {
    ScalarGraph graph;
    const int x = graph.input(0);
    return SeriesCode::make(graph, 1, {0}, {rate_of(graph, x)}, {}).has_value();
  };
  EXPECT_FALSE(has([](ScalarGraph& g, int x) { return g.apply(ScalarOp::floor, x); }));
  EXPECT_FALSE(has([](ScalarGraph& g, int x) { return g.apply(ScalarOp::mod, x, g.constant(2)); }));
  EXPECT_FALSE(
      has([](ScalarGraph& g, int x) { return g.apply(ScalarOp::power, g.constant(2), x); }));
  // The branch of a flow may change on the way.
  EXPECT_FALSE(has([](ScalarGraph& g, int x) { return g.apply(ScalarOp::abs, x); }));
  EXPECT_TRUE(has([](ScalarGraph& g, int x) { return g.apply(ScalarOp::sin, x); }));
}

}  // namespace
}  // namespace gainsmith::lanes
