// Roots of borders on a step: all of them, with sides that the function itself has.
#include "ode/roots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "base/number.h"
#include "hybrid/trajectory.h"
#include "ode/chebyshev.h"
#include "support/event_problem.h"
#include "support/input_error.h"

namespace gainsmith::simulate {
namespace {

using Eigen::VectorXd;
using numbers::Matrix;

ode::Found roots(const std::function<double(double)>& g, double from, double to,
                 bool strict = false) {
  return ode::find_roots({g, strict, 0}, from, to);
}

void expect_brackets(const ode::Found& found, const std::function<double(double)>& g,
                     const std::vector<double>& expected, double tolerance) {
  ASSERT_EQ(found.roots.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const ode::Root& root = found.roots[k];
    EXPECT_NEAR(root.right, expected[k], tolerance);
    EXPECT_LT(root.left, root.right);
    EXPECT_LE(root.right - root.left, 5e-16 * std::abs(root.right) + 1e-19);
    EXPECT_NE(g(root.left) >= 0, g(root.right) >= 0);
  }
}

TEST(Chebyshev, InterpolatesDerivesAndRestricts) {
  const VectorXd& x = ode::chebyshev::points(12);
  Matrix values(2, x.size());
  values.row(0) = x.array().sin().matrix().transpose();
  values.row(1) = (2 * x.array()).exp().matrix().transpose();
  const Matrix c = ode::chebyshev::coefficients(values);
  const Matrix slope = ode::chebyshev::derivative(c);
  const Matrix right = ode::chebyshev::part(c, 0.25, 1);
  for (const double at : {-1.0, -0.3, 0.0, 0.71, 1.0}) {
    EXPECT_NEAR(ode::chebyshev::at(c, at)(0), std::sin(at), 1e-12);
    EXPECT_NEAR(ode::chebyshev::at(c, at)(1), std::exp(2 * at), 1e-9);
    EXPECT_NEAR(ode::chebyshev::at(slope, at)(0), std::cos(at), 1e-10);
    EXPECT_NEAR(ode::chebyshev::at(right, at)(0), std::sin(0.625 + 0.375 * at), 1e-12);
  }
}

TEST(Borders, ThreeCrossingsInOneStep) {
  const auto g = [](double t) { return (t - 0.1) * (t - 0.5) * (t - 0.50001); };
  expect_brackets(roots(g, 0, 1), g, {0.1, 0.5, 0.50001}, 1e-10);
}

TEST(Borders, APairThatHardlyCrosses) {
  const auto g = [](double t) { return t * t - 2 * t + 1 - 1e-9; };
  const double half = std::sqrt(1e-9);
  const ode::Found found = roots(g, 0, 10);
  ASSERT_EQ(found.roots.size(), 2U);
  EXPECT_NEAR(found.roots[0].right, 1 - half, 1e-10);
  EXPECT_NEAR(found.roots[1].right, 1 + half, 1e-10);
  ASSERT_EQ(found.turns.size(), 1U);
  EXPECT_TRUE(found.turns[0].reached);
}

TEST(Borders, WhatComesNearWithoutReachingIsNoted) {
  const auto g = [](double t) { return (t - 1) * (t - 1) + 1e-11; };
  const ode::Found found = roots(g, 0, 3);
  EXPECT_TRUE(found.roots.empty());
  ASSERT_EQ(found.turns.size(), 1U);
  EXPECT_NEAR(found.turns[0].t, 1, 1e-5);
  EXPECT_NEAR(found.turns[0].value, 1e-11, 1e-12);
  const auto far = [](double t) { return (t - 1) * (t - 1) + 1e-8; };
  EXPECT_TRUE(roots(far, 0, 3).turns.empty());
}

TEST(Borders, ATouchIsReachedWhereTheValueSaysSo) {
  const auto g = [](double t) { return -(t - 1) * (t - 1); };  // exactly 0 at t = 1
  const ode::Found reached = roots(g, 0, 2);
  ASSERT_EQ(reached.roots.size(), 2U);
  EXPECT_EQ(reached.roots[0].right, 1);
  EXPECT_TRUE(roots(g, 0, 2, true).roots.empty());
}

TEST(Borders, CornersAreNoObstacle) {
  const auto g = [](double t) { return std::abs(t - 0.3) - 1e-7; };
  expect_brackets(roots(g, 0, 1), g, {0.3 - 1e-7, 0.3 + 1e-7}, 1e-15);
  const auto far = [](double t) { return std::max(std::abs(t - 0.3), 0.2) - 0.1; };
  int evaluations = 0;
  const auto counted = [&](double t) {
    ++evaluations;
    return far(t);
  };
  EXPECT_TRUE(roots(counted, 0, 1).roots.empty());
  EXPECT_LT(evaluations, 1000);
  const auto steps = [](double t) { return std::max({0.1 - t, t - 0.9, -0.05}); };
  expect_brackets(roots(steps, 0, 1), steps, {0.1, 0.9}, 1e-15);
}

TEST(Borders, RandomPolynomialsAndWavesHaveAllTheirRoots) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0, 4);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> at(1 + random() % 6);
    for (double& t : at) t = place(random);
    std::sort(at.begin(), at.end());
    const auto g = [&](double t) {
      double product = 1;
      for (const double root : at) product *= t - root;
      return product;
    };
    const ode::Found found = roots(g, 0, 4);
    ASSERT_EQ(found.roots.size(), at.size());
    for (std::size_t k = 0; k < at.size(); ++k) EXPECT_NEAR(found.roots[k].right, at[k], 1e-15 * 4);
  }
  const auto wave = [](double t) { return std::sin(40 * t) + 0.5; };
  std::vector<double> expected;
  for (int turn = 0; turn < 25; ++turn)
    for (const double twelfths : {7.0, 11.0})
      expected.push_back((twelfths / 6 + 2 * turn) * std::numbers::pi / 40);
  expect_brackets(roots(wave, 0, 4), wave, expected, 1e-14);
}

TEST(Borders, RoundingAloneCostsLittleAndMakesNothingUp) {
  int evaluations = 0;
  const ode::RootFunction border{[&](double t) {
                                   ++evaluations;
                                   return (1e3 + std::sin(1e5 * t) * 1e-14) - 1e3;
                                 },
                                 true, 1e-12};
  EXPECT_TRUE(ode::find_roots(border, 0, 1).roots.empty());
  EXPECT_LT(evaluations, 100);
}

TEST(Borders, LeavesZeroAtOnce) {
  const auto g = [](double t) { return t; };
  const ode::Found strict = roots(g, 0, 1, true);
  ASSERT_EQ(strict.roots.size(), 1U);
  EXPECT_EQ(strict.roots[0].left, 0);
  EXPECT_GT(g(strict.roots[0].right), 0);
  EXPECT_TRUE(roots(g, 0, 1).roots.empty());
}

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

TEST(Borders, WhatBranchesForLittleTimeIsCrossed) {
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

TEST(Borders, AnEquationOfWhatMovesIsRefused) {
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
TEST(Borders, AFlightThatDrownsInTheNoiseOfAStepEndsInTime) {
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
