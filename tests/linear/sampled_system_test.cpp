#include "linear/sampled_system.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "linear/sampled_problem.h"

namespace gainsmith::linear {
namespace {

using tests::column;
using tests::sampled_data;
using tests::scalar;
using tests::TextProblem;

std::string error_of(TextProblem& problem) {
  try {
    const SampledProblem made(problem);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SampledSystem, FlowAndJumpOfPlantAndObserverAreRead) {
  TextProblem problem = sampled_data("1.1", column({2, 3}), column({0.1, -0.9}), scalar(-5));
  const SampledProblem made(problem);
  numbers::Matrix flow{{0.2, -1.01, 0, 0, 0},
                       {1, 0, 0, 0, 0},
                       {0, 0, 0.2, -1.01, 2},
                       {0, 0, 1, 0, 3},
                       {0, 0, 0, 0, -5}};
  const Coordinates states = made.states();
  EXPECT_LT((states.linear.cast<double>() - flow).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_TRUE(states.constant.isZero(0));
  const double rest = 1 - (0.5 * 0.1 + 0.9);  // I - C F
  numbers::Matrix jump{{1, 0, 0, 0, 0},
                       {0, 1, 0, 0, 0},
                       {0.05, -0.1, 0.95, 0.1, 0},
                       {-0.45, 0.9, 0.45, 0.1, 0},
                       {0.5 * rest, -rest, -0.5 * rest, rest, 0}};
  const auto map = affine_jump(states);
  ASSERT_TRUE(map.has_value());
  EXPECT_LT((map->linear.cast<double>() - jump).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(SampledSystem, ErrorFlowIsEquationEight) {
  const numbers::Matrix L = column({3.68, -24.47});
  const numbers::Matrix F = column({0.104, -0.948});
  const double H = -25.93;
  TextProblem problem = sampled_data("1.1", L, F, scalar(H));
  const SampledProblem made(problem);
  const Coordinates states = made.states();
  const numbers::Matrix A{{0.2, -1.01}, {1, 0}};
  const numbers::Matrix C{{0.5, -1}};
  numbers::Matrix errors(3, 5);  // [e; q] = errors x
  errors << numbers::Matrix::Identity(2, 2), -numbers::Matrix::Identity(2, 2),
      numbers::Matrix::Zero(2, 1), C, -C, -numbers::Matrix::Identity(1, 1);
  numbers::Matrix flow(3, 3);
  flow << A - L * C, L, C * A - C * L * C - H * C, C * L + scalar(H);
  numbers::Matrix jump = numbers::Matrix::Zero(3, 3);
  jump.topLeftCorner(2, 2) = numbers::Matrix::Identity(2, 2) - F * C;
  EXPECT_LT((errors * states.linear.cast<double>() - flow * errors).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LT(
      (errors * affine_jump(states)->linear.cast<double>() - jump * errors).cwiseAbs().maxCoeff(),
      1e-13);
}

TEST(SampledSystem, HasAnAffineFlowWithConstantCoefficients) {
  for (const char* flow : {"3 - tau", "x^2", "x*tau", "sin(x)"}) {
    TextProblem problem;
    problem.state("x", "scalar").flow({{"x", flow}}).timer("1", "2", "0", "2");
    EXPECT_EQ(SampledProblem(problem).made, nullptr) << flow;
  }
}

/// Such runs are followed by steps.
TEST(SampledSystem, HasNoTextsWithoutAValueInHundredDigits) {
  const auto is_sampled = [](const char* jump) {
    TextProblem problem;
    problem.state("x", "2").state("P", "2 x 2").jump({{"x", jump}}).timer("1", "2", "0", "2");
    const SampledProblem made(problem);
    return made.made != nullptr;
  };
  EXPECT_TRUE(is_sampled("inv(P)*x"));
  EXPECT_TRUE(is_sampled("pinv([1, 2; 2, 4])*x"));
  for (const char* jump :
       {"project_polytope(x, eye(2), [1, 0], 2)", "project_ellipsoid(x, eye(2), [0; 0], eye(2), 4)",
        "project_convex(x, eye(2), x'*x - 4)", "pinv(P)*x", "det(P)*x", "eig(P)(:, 1)",
        "flow_map(-x, x, 1)"})
    EXPECT_FALSE(is_sampled(jump)) << jump;
}

TEST(SampledSystem, NonlinearJumpIsKeptAsText) {
  TextProblem problem;
  problem.state("x", "scalar").state("w", "scalar").jump({{"x", "x^2"}}).timer("1", "2", "0", "2");
  const SampledProblem made(problem);
  EXPECT_FALSE(affine_jump(made.states()).has_value());
  EXPECT_EQ(made.system().jump.size(), 1U);
}

TEST(SampledSystem, GainsMustBeThereAndFit) {
  TextProblem missing = sampled_data("1.1", column({2, 3}), column({0, 0}), scalar(-5));
  missing.gains.gains.pop_back();
  EXPECT_NE(error_of(missing).find("no value for H"), std::string::npos) << error_of(missing);
  TextProblem wrong = sampled_data("1.1", column({2, 3}), column({0, 0}), scalar(-5));
  wrong.gains.gains[0].second = numbers::Matrix::Zero(3, 1);
  EXPECT_NE(error_of(wrong).find("L in the gain file is 3 x 1, expected 2 x 1"), std::string::npos)
      << error_of(wrong);
}

TEST(SampledSystem, TimerBoundsMustBeOrdered) {
  TextProblem reset;
  reset.state("x", "scalar").timer("2", "1", "0", "1");
  EXPECT_NE(error_of(reset).find("comes after a time in [2, 1]"), std::string::npos);
  TextProblem first;
  first.state("x", "scalar").timer("1", "2", "-1", "1");
  EXPECT_NE(error_of(first).find("comes after a time in [-1, 1]"), std::string::npos);
}

}  // namespace
}  // namespace gainsmith::linear
