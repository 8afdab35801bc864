// Zero crossings of event functions in runs: all of them, where texts branch and next to jumps too.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/number.h"
#include "hybrid/trajectory.h"
#include "support/event_problem.h"
#include "support/input_error.h"

namespace gainsmith::simulate {
namespace {

using numbers::Matrix;

/// Each event of a text with the times at which it comes, x = t.
std::vector<double> times_of(const tests::EventProblem::Map& texts,
                             tests::EventProblem::EventKind kind) {
  tests::EventProblem problem;
  problem.state("x", {1, 1}, "0").state("n", {1, 1}, "0").flow("x", "1");
  for (const auto& [name, text] : texts) {
    problem.crossing(kind, name, text);
    problem.jump(name, {{"n", "n + 1"}});
  }
  const hybrid::System system = problem.system();
  hybrid::Scenario scenario;
  scenario.horizon = 3.5;
  std::vector<double> times;
  for (const hybrid::JumpPoint& jump : tests::jumps_of(Simulator(system, scenario).run(1, 0)))
    times.push_back(jump.t);
  return times;
}

TEST(ZeroCrossings, WhatBranchesForLittleTimeIsCrossed) {
  using EventKind = tests::EventProblem::EventKind;
  struct Case {
    std::string text;
    EventKind kind;
    std::vector<double> times;
  };
  const std::vector<Case> cases = {
      {"where(x > 1.26, where(x < 1.2601, 1, -1), -1)", EventKind::rises, {1.26}},
      {"where(x > 1.26, where(x < 1.2601, 1, -1), -1)", EventKind::falls, {1.2601}},
      {"max(0, 1 - abs(x - 1.2345)/0.001) - 0.5", EventKind::crosses, {1.234, 1.235}},
      {"sign(x - 1) - sign(x - 1.0001) - 1.5", EventKind::rises, {1}},
      {"floor(x + 0.0005) - floor(x) - 0.5", EventKind::falls, {1, 2, 3}},
      {"norm([x - 1; 0]) - 1e-14", EventKind::falls, {1 - 1e-14}},
      {"mod(x, 0.7) - 0.6999", EventKind::rises, {0.6999, 1.3999, 2.0999, 2.7999, 3.4999}},
      {"where(x > 1, 2 - x, -1)", EventKind::crosses, {1, 2}}};
  for (const Case& one : cases) {
    const std::vector<double> times = times_of({{"e", one.text}}, one.kind);
    ASSERT_EQ(times.size(), one.times.size()) << one.text;
    for (std::size_t k = 0; k < times.size(); ++k)
      EXPECT_NEAR(times[k], one.times[k], 1e-12) << one.text;
  }
}

/// Of a matrix exponential no bounds over a step are known: some of its points decide.
TEST(ZeroCrossings, WhatHasNoBoundsIsSearchedWhereItComesNear) {
  using EventKind = tests::EventProblem::EventKind;
  const std::string slow = "trace(expm([0, x; -x, 0])) - 1";          // 2 cos(x) - 1
  const std::string fast = "trace(expm([0, 40*x; -40*x, 0])) - 1.9";  // 2 cos(40 x) - 1.9
  const std::vector<double> one = times_of({{"e", slow}}, EventKind::falls);
  ASSERT_EQ(one.size(), 1U);
  EXPECT_NEAR(one.front(), std::acos(0.5), 1e-12);
  std::vector<double> expected;
  for (int turn = 1; turn <= 22; ++turn)
    expected.push_back((2 * std::numbers::pi * turn - std::acos(0.95)) / 40);
  const std::vector<double> many = times_of({{"e", fast}}, EventKind::rises);
  ASSERT_EQ(many.size(), expected.size());
  for (std::size_t k = 0; k < many.size(); ++k) EXPECT_NEAR(many[k], expected[k], 1e-12);
  EXPECT_TRUE(
      times_of({{"e", "trace(expm([0, 40*x; -40*x, 0])) - 2.1"}}, EventKind::crosses).empty());
}

TEST(ZeroCrossings, AnEquationOfWhatMovesIsRefused) {
  const auto system_of = [](const std::string& condition) {
    tests::EventProblem problem;
    problem.state("x", {1, 1}, "0").state("n", {1, 1}, "0").mode("q", "0").flow("x", "1");
    problem.when("e", condition).jump("e", {{"n", "n + 1"}});
    return problem.system();
  };
  const auto error = tests::input_error([&] { system_of("x == 1 and q == 0"); });
  EXPECT_NE(error.message().find("is met in passing, as x moves"), std::string::npos)
      << error.message();
  EXPECT_NO_THROW(system_of("x >= 1 and q == 0"));
  EXPECT_NO_THROW(system_of("sign(x - 1) == 1 and n == 0"));
  EXPECT_NO_THROW(system_of("x != 1 and x > 0"));
}

/// A ball that an impact leaves with v lands 2 v/g later, in no time beside a step.
TEST(ZeroCrossings, AFlightThatDrownsInTheNoiseOfAStepEndsInTime) {
  for (const double v : {1e-4, 2.517520062181401e-8, 3e-10, 1e-12}) {
    tests::EventProblem problem;
    problem.state("x", {}, "5").state("v", {}, "0").flow("x", "v").flow("v", "-9.81");
    problem.state("n", {}, "0").when("hit", "x <= 0 and v < 0");
    problem.jump("hit", {{"x", "n*1e5"}, {"v", brief(v, 17) + "*(1 - n)"}, {"n", "1"}});
    const hybrid::System system = problem.system();
    const hybrid::Scenario scenario = hybrid::make_scenario(4, system);
    const hybrid::Trajectory run = Simulator(system, scenario).run(1, 0);
    const auto jumps = tests::jumps_of(run);
    ASSERT_EQ(jumps.size(), 2U) << v;
    EXPECT_NEAR(jumps[1].t - jumps[0].t, 2 * v / 9.81, 2e-13 + 1e-6 * v) << v;
  }
}

TEST(DenseStep, ItsBeginningIsTheSamePolynomial) {
  hybrid::DenseStep step{2, 4, Matrix{{1, 2, 3, 4}, {0, 1, 0, -1}}};
  const hybrid::DenseStep first = step.until(2.7);
  EXPECT_EQ(first.to, 2.7);
  for (const double t : {2.0, 2.2, 2.55, 2.7})
    EXPECT_LT((first(t) - step(t)).cwiseAbs().maxCoeff(), 1e-14);
}

}  // namespace
}  // namespace gainsmith::simulate
