#include "flights/lane_terms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "lanes/machine.h"

namespace gainsmith::flights {
namespace {

using Made = std::function<int(LaneTerms&, int a, int b)>;

/// A term of two inputs at all pairs of some numbers.
void expect_values(const Made& made, const std::function<double(double, double)>& expected) {
  numbers::ScalarGraph graph;
  LaneTerms is(graph);
  const int result = made(is, graph.input(0), graph.input(1));
  const lanes::LaneCode code(graph, {{result}}, 2);
  lanes::LaneMachine machine(code);
  const double values[] = {-2, -1, 0, 1, 2};
  for (const double a : values)
    for (const double b : values) {
      std::fill_n(machine.input(0), lanes::kLanes, a);
      std::fill_n(machine.input(1), lanes::kLanes, b);
      machine.run();
      EXPECT_EQ(machine.faults(), 0U) << a << ", " << b;
      EXPECT_EQ(machine.result(0, 0)[5], expected(a, b)) << a << ", " << b;
    }
}

TEST(LaneTerms, DecideAsTruthsDo) {
  const auto tests = [](LaneTerms& is, int a, int b) {
    return std::pair(is.is_positive(a), is.is_at_least_0(b));
  };
  expect_values(
      [&](LaneTerms& is, int a, int b) {
        const auto [p, q] = tests(is, a, b);
        return is.both(p, q);
      },
      [](double a, double b) { return a > 0 && b >= 0 ? 1 : 0; });
  expect_values(
      [&](LaneTerms& is, int a, int b) {
        const auto [p, q] = tests(is, a, b);
        return is.either(is.no(p), is.no(q));
      },
      [](double a, double b) { return !(a > 0) || !(b >= 0) ? 1 : 0; });
  expect_values(
      [&](LaneTerms& is, int a, int b) {
        const auto [p, q] = tests(is, a, b);
        return is.pick(is.no(is.both(p, is.no(q))), a, b);
      },
      [](double a, double b) { return a > 0 && !(b >= 0) ? b : a; });
  expect_values([](LaneTerms& is, int a, int) { return is.is_equal(a, 1); },
                [](double a, double) { return a == 1 ? 1 : 0; });
  expect_values([](LaneTerms& is, int a, int b) { return is.quotient(a, b, 7); },
                [](double a, double b) { return b == 0 ? 7 : a / b; });
}

TEST(LaneTerms, ATestThatPicksIsNoOperation) {
  numbers::ScalarGraph graph;
  LaneTerms is(graph);
  const int a = graph.input(0), b = graph.input(1);
  const int test = is.no(is.is_positive(a));
  const int picked = is.pick(test, a, b);
  EXPECT_EQ(picked, graph.where(true, a, b, a));
  EXPECT_EQ(is.both(is.number(1), test), test);
  EXPECT_EQ(is.either(is.number(0), test), test);
  EXPECT_EQ(is.pick(is.number(0), a, b), b);
}

TEST(LaneTerms, WhatIsNoNumberIsNotPositive) {
  numbers::ScalarGraph graph;
  LaneTerms is(graph);
  const lanes::LaneCode code(
      graph, {{is.is_positive(graph.input(0)), is.is_at_least_0(graph.input(0))}}, 1);
  lanes::LaneMachine machine(code);
  std::fill_n(machine.input(0), lanes::kLanes, std::numeric_limits<double>::quiet_NaN());
  machine.run();
  EXPECT_EQ(machine.result(0, 0)[0], 0);
  EXPECT_EQ(machine.result(0, 1)[0], 0);
}

}  // namespace
}  // namespace gainsmith::flights
