#include "bounded/steps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "base/error.h"

namespace gainsmith::bounded {
namespace {

using Eigen::VectorXd;
using numbers::Matrix;

hybrid::AffineMap linear(const Matrix& matrix) { return {matrix, VectorXd::Zero(matrix.rows())}; }

/// x after an interval.
VectorXd flow(const FlowSteps& steps, double interval, VectorXd x) {
  std::vector<FlowStep> cuts;
  steps.cut(interval, cuts);
  VectorXd next(x.size());
  for (const FlowStep& step : cuts) {
    steps.advance(step, x, next);
    x = next;
  }
  return x;
}

TEST(FlowSteps, RotationGoesInACircle) {
  const FlowSteps steps(linear(Matrix{{0, -3}, {3, 0}}), 2);
  for (const double t : {0.0, 1e-9, 0.01, 0.5, 1.234567, 2.0}) {
    const VectorXd x = flow(steps, t, Eigen::Vector2d(1, 0));
    EXPECT_NEAR(x(0), std::cos(3 * t), 1e-14) << t;
    EXPECT_NEAR(x(1), std::sin(3 * t), 1e-14) << t;
  }
}

TEST(FlowSteps, JordanBlockGrowsByPolynomials) {
  const double a = -0.7;
  const FlowSteps steps(linear(Matrix{{a, 1, 0}, {0, a, 1}, {0, 0, a}}), 3);
  for (const double t : {0.2, 1.0, 2.9}) {
    const VectorXd x = flow(steps, t, Eigen::Vector3d(0, 0, 1));
    EXPECT_NEAR(x(0), std::exp(a * t) * t * t / 2, 1e-14) << t;
    EXPECT_NEAR(x(1), std::exp(a * t) * t, 1e-14) << t;
    EXPECT_NEAR(x(2), std::exp(a * t), 1e-14) << t;
  }
}

TEST(FlowSteps, ConstantTermIsFollowed) {
  // x' = 2 - 0.5 x from 1: x = 4 - 3 exp(-t/2); y' = 3 with no linear part.
  const FlowSteps steps({Matrix{{-0.5, 0}, {0, 0}}, Eigen::Vector2d(2, 3)}, 5);
  const VectorXd x = flow(steps, 4.3, Eigen::Vector2d(1, -1));
  EXPECT_NEAR(x(0), 4 - 3 * std::exp(-2.15), 1e-14);
  EXPECT_NEAR(x(1), -1 + 3 * 4.3, 1e-13);
}

TEST(FlowSteps, StiffModesKeepTheSlowOnesExact) {
  // Eigenvalues -1e5 and -0.3, coupled: x2 = exp(-0.3 t), x1' = -1e5 x1 + 1e5 x2.
  const FlowSteps steps(linear(Matrix{{-1e5, 1e5}, {0, -0.3}}), 1.1);
  const auto exact = [](double t) {
    return 1e5 / (1e5 - 0.3) * (std::exp(-0.3 * t) - std::exp(-1e5 * t));
  };
  for (const double t : {1e-6, 1e-5, 1e-3, 0.5, 1.1})
    EXPECT_NEAR(flow(steps, t, Eigen::Vector2d(0, 1))(0), exact(t), 1e-13) << t;
}

TEST(FlowSteps, LengthsAddUpAndResolveTheInterval) {
  const FlowSteps steps(linear(Matrix{{0, -3}, {3, 0}}), 2);
  for (const double interval : {1e-7, 0.3, 1.0, 1.99999, 2.0}) {
    std::vector<FlowStep> cuts;
    steps.cut(interval, cuts);
    double sum = 0;
    for (const FlowStep& step : cuts) {
      EXPECT_GT(step.length, 0);
      EXPECT_LE(step.length, 2.0 / 8);
      sum += step.length;
    }
    EXPECT_NEAR(sum, interval, 4e-16) << interval;
    EXPECT_GE(cuts.size(), interval >= 1 ? 7U : 1U);
  }
  std::vector<FlowStep> none;
  steps.cut(0, none);
  EXPECT_TRUE(none.empty());
}

TEST(FlowSteps, NumberOfStepsGrowsWithTheLogarithmOfTheStiffness) {
  const auto count = [](double rate) {
    std::vector<FlowStep> cuts;
    FlowSteps(linear(Matrix{{-rate, 0}, {0, -1}}), 1).cut(0.9, cuts);
    return cuts.size();
  };
  EXPECT_LE(count(1e6), count(1) + 45);
}

TEST(FlowSteps, RefusesFlowsThatAreNoNumbersOrTooFast) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(FlowSteps(linear(Matrix::Constant(1, 1, nan)), 1), InputError);
  EXPECT_THROW(FlowSteps(linear(Matrix::Constant(1, 1, -1e13)), 1), InputError);
}

}  // namespace
}  // namespace gainsmith::bounded
