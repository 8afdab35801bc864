// Roots of functions of time on a step: all of them, with sides that the function itself has.
#include "ode/roots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "ode/chebyshev.h"
#include "ode/step_range.h"

namespace gainsmith::ode {
namespace {

using Eigen::VectorXd;
using numbers::Matrix;

Found roots(const std::function<double(double)>& g, double from, double to, bool strict = false) {
  return find_roots({g, strict, 0}, from, to);
}

void expect_brackets(const Found& found, const std::function<double(double)>& g,
                     const std::vector<double>& expected, double tolerance) {
  ASSERT_EQ(found.roots.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const Root& root = found.roots[k];
    EXPECT_NEAR(root.right, expected[k], tolerance);
    EXPECT_LT(root.left, root.right);
    EXPECT_LE(root.right - root.left, 5e-16 * std::abs(root.right) + 1e-19);
    EXPECT_NE(g(root.left) >= 0, g(root.right) >= 0);
  }
}

/// A short step late in a run: its times are rounded, which is no corner of g.
TEST(Roots, OfAShortStepLateInARunTakeFewPoints) {
  const double from = 5.25;
  for (const double length : {1e-4, 1e-6, 1e-8, 1e-10}) {
    const double to = from + length;
    int points = 0;
    const auto g = [&](double t) {
      ++points;
      const double share = (t - from) / (to - from);
      return share * (0.75 - share);
    };
    const Found found = find_roots({g, true, 0}, from, to);
    EXPECT_LE(points, 200) << length;
    EXPECT_TRUE(found.whole);
    ASSERT_FALSE(found.roots.empty()) << length;
    EXPECT_NEAR((found.roots.back().right - from) / length, 0.75, 1e-15 / length * 8) << length;
  }
}

/// To the last bit: where an event is, and the state at it, come from series of some variables and of
/// all.
TEST(Chebyshev, AValueDoesNotDependOnItsNeighbours) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int k = 0; k < 200; ++k) {
    const Matrix all = Matrix::NullaryExpr(43, 3 + k % 9, [&] { return any(random); });
    const double x = any(random);
    const VectorXd values = chebyshev::at(all, x);
    for (const Eigen::Index row : {0, 7, 31, 35, 40, 42})
      EXPECT_EQ(chebyshev::at(all.row(row), x)(0), values(row)) << row;
  }
}

TEST(Chebyshev, InterpolatesDerivesAndRestricts) {
  const VectorXd& x = chebyshev::points(12);
  Matrix values(2, x.size());
  values.row(0) = x.array().sin().matrix().transpose();
  values.row(1) = (2 * x.array()).exp().matrix().transpose();
  const Matrix c = chebyshev::coefficients(values);
  const Matrix slope = chebyshev::derivative(c);
  const Matrix right = chebyshev::part(c, 0.25, 1);
  for (const double at : {-1.0, -0.3, 0.0, 0.71, 1.0}) {
    EXPECT_NEAR(chebyshev::at(c, at)(0), std::sin(at), 1e-12);
    EXPECT_NEAR(chebyshev::at(c, at)(1), std::exp(2 * at), 1e-9);
    EXPECT_NEAR(chebyshev::at(slope, at)(0), std::cos(at), 1e-10);
    EXPECT_NEAR(chebyshev::at(right, at)(0), std::sin(0.625 + 0.375 * at), 1e-12);
  }
}

TEST(Roots, ThreeCrossingsInOneStep) {
  const auto g = [](double t) { return (t - 0.1) * (t - 0.5) * (t - 0.50001); };
  expect_brackets(roots(g, 0, 1), g, {0.1, 0.5, 0.50001}, 1e-10);
}

TEST(Roots, APairThatHardlyCrosses) {
  const auto g = [](double t) { return t * t - 2 * t + 1 - 1e-9; };
  const double half = std::sqrt(1e-9);
  const Found found = roots(g, 0, 10);
  ASSERT_EQ(found.roots.size(), 2U);
  EXPECT_NEAR(found.roots[0].right, 1 - half, 1e-10);
  EXPECT_NEAR(found.roots[1].right, 1 + half, 1e-10);
  ASSERT_EQ(found.turning_points.size(), 1U);
  EXPECT_TRUE(found.turning_points[0].reached);
}

TEST(Roots, WhatComesNearWithoutReachingIsNoted) {
  const auto g = [](double t) { return (t - 1) * (t - 1) + 1e-11; };
  const Found found = roots(g, 0, 3);
  EXPECT_TRUE(found.roots.empty());
  ASSERT_EQ(found.turning_points.size(), 1U);
  EXPECT_NEAR(found.turning_points[0].t, 1, 1e-5);
  EXPECT_NEAR(found.turning_points[0].value, 1e-11, 1e-12);
  const auto far = [](double t) { return (t - 1) * (t - 1) + 1e-8; };
  EXPECT_TRUE(roots(far, 0, 3).turning_points.empty());
}

TEST(Roots, ATouchIsReachedWhereTheValueSaysSo) {
  const auto g = [](double t) { return -(t - 1) * (t - 1); };  // exactly 0 at t = 1
  const Found reached = roots(g, 0, 2);
  ASSERT_EQ(reached.roots.size(), 2U);
  EXPECT_EQ(reached.roots[0].right, 1);
  EXPECT_TRUE(roots(g, 0, 2, true).roots.empty());
}

TEST(Roots, CornersAreNoObstacle) {
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

TEST(Roots, RandomPolynomialsAndWavesHaveAllTheirRoots) {
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
    const Found found = roots(g, 0, 4);
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

TEST(Roots, RoundingAloneCostsLittleAndMakesNothingUp) {
  int evaluations = 0;
  const RootFunction function{[&](double t) {
                                ++evaluations;
                                return (1e3 + std::sin(1e5 * t) * 1e-14) - 1e3;
                              },
                              true, 1e-12};
  EXPECT_TRUE(find_roots(function, 0, 1).roots.empty());
  EXPECT_LT(evaluations, 100);
}

TEST(Roots, OfMoreThanCanBeSearchedNotAllAreSought) {
  int evaluations = 0;
  const auto wave = [&](double t) {
    ++evaluations;
    return std::sin(1e9 * t);
  };
  EXPECT_FALSE(find_roots({wave, false, 1e-6}, 0, 1).whole);
  EXPECT_LT(evaluations, 100000);
  const Found found = find_roots(
      {[](double t) { return std::sin(400 * std::numbers::pi * t); }, false, 1e-12}, 0.5, 1);
  EXPECT_TRUE(found.whole);
  EXPECT_NEAR(static_cast<double>(found.roots.size()), 200, 1);
}

TEST(Roots, LeavesZeroAtOnce) {
  const auto g = [](double t) { return t; };
  const Found strict = roots(g, 0, 1, true);
  ASSERT_EQ(strict.roots.size(), 1U);
  EXPECT_EQ(strict.roots[0].left, 0);
  EXPECT_GT(g(strict.roots[0].right), 0);
  EXPECT_TRUE(roots(g, 0, 1).roots.empty());
}

/// Whether three points of g on [0, 1] say that it has no root there.
bool is_far(const std::function<double(double)>& g, double sign = 0) {
  const auto value = [&](const VectorXd& x) { return g(x(0)); };
  const std::array<VectorXd, 3> points = {VectorXd::Constant(1, 0), VectorXd::Constant(1, 0.5),
                                          VectorXd::Constant(1, 1)};
  return StepRange(value, points).is_far_from_zero(sign);
}

TEST(StepRange, IsNotFarWhereAPairOfRootsMayBe) {
  for (const double at : {0.1, 0.2, 0.25, 0.7, 0.9})
    for (const double gap : {1e-6, 0.01, 0.05}) {
      const auto g = [&](double t) { return (t - at) * (t - at - gap); };
      EXPECT_FALSE(is_far(g)) << at << " " << gap;
      EXPECT_FALSE(is_far(g, 1)) << at << " " << gap;
    }
  EXPECT_TRUE(is_far([](double t) { return 5 + t; }));
  EXPECT_TRUE(is_far([](double t) { return -5 - t; }, -1));
  EXPECT_FALSE(is_far([](double t) { return -5 - t; }, 1));
}

}  // namespace
}  // namespace gainsmith::ode
