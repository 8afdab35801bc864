#include "claims/claim_check.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "support/linear_algebra.h"
#include "support/text_problem.h"
#include "verify/judge.h"

namespace gainsmith::verify {
namespace {

using numbers::Matrix;
using Law = model::LawKind;
using Start = model::StartKind;
using tests::TextProblem;

/// A run of a problem, its claims judged one by one, and the costs in double.
struct Checked {
  std::vector<claims::Finding> findings;
  std::vector<Eigen::VectorXd> costs;
};

Checked check(TextProblem& problem, std::uint64_t run = 0) {
  const auto setup = make_setup(problem.instance(), problem.gains);
  Judge judge(*setup);
  Checked result;
  result.findings = judge(1, run).findings;
  const claims::Track& track = judge.track(1, run);
  for (const claims::ClaimCheck& one : judge.checks()) {
    result.costs.emplace_back();
    if (!one.claim().cost) continue;
    Eigen::VectorXd& costs = result.costs.back();
    costs.resize(static_cast<Eigen::Index>(track.samples()));
    for (std::size_t k = 0; k < track.samples(); ++k)
      costs(static_cast<Eigen::Index>(k)) = track.at(k, *one.claim().cost).value;
  }
  return result;
}

/// int_0^t x' W x ds for x' = M x from x0, by Van Loan's block exponential.
double van_loan(const Matrix& M, const Matrix& W, double t, const Eigen::VectorXd& x0) {
  const Eigen::Index n = M.rows();
  Matrix block = Matrix::Zero(2 * n, 2 * n);
  block << -M.transpose(), W, Matrix::Zero(n, n), M;
  const Matrix exponential = tests::exponential(block * t);
  return x0.dot(tests::product({exponential.bottomRightCorner(n, n).transpose(),
                                exponential.topRightCorner(n, n), x0})
                    .col(0));
}

TextProblem linear_plant(const std::string& matrix) {
  TextProblem problem;
  problem.data("A", "n x n", matrix).data("W", "n x n", "[2, 0.5; 0.5, 1]").state("x", "n");
  problem.flow({{"x", "A*x"}}).jump({{"x", "0.5*x"}}).timer("0.5", "1.1", "0", "1.1");
  problem.start("x", Start::expression, {"[1; -2]"});
  return problem;
}

TEST(Cost, IntegralOverAFlowIsVanLoans) {
  TextProblem problem = linear_plant("[0.2, -4; 3, -0.5]");
  problem.first("1.1").horizon("1.09").cost("J", "1000", "x'*W*x", "0");
  const Checked result = check(problem);
  const Matrix A{{0.2, -4}, {3, -0.5}};
  const Matrix W{{2, 0.5}, {0.5, 1}};
  const double expected = van_loan(A, W, 1.09, Eigen::Vector2d(1, -2));
  EXPECT_NEAR(result.costs[0].tail(1)(0), expected, 1e-13 * expected);
}

TEST(Cost, StiffTransientIsIntegratedInFull) {
  // x1' = -k x1: int x1^2 = (1 - exp(-2 k t))/(2 k), all of it in the first 1/k of the interval.
  for (const double k : {30.0, 1e3, 1e5}) {
    TextProblem problem = linear_plant("[-" + std::to_string(k) + ", 0; 0, -0.1]");
    problem.first("1.1").horizon("1.1").cost("J", "1000", "x(1)^2", "0");
    const double expected = (1 - std::exp(-2 * k * 1.1)) / (2 * k);
    EXPECT_NEAR(check(problem).costs[0].tail(1)(0), expected, 1e-11 * expected) << k;
  }
}

TEST(Cost, StableLoopCostsWhatLyapunovSays) {
  // A'P + P A + W = 0 by hand for A = diag(-1, -2): P = [W11/2, W12/3; ., W22/4].
  TextProblem problem = linear_plant("[-1, 0; 0, -2]");
  problem.jump({}).horizon("40").cost("J", "x'*[1, 0.5/3; 0.5/3, 0.25]*x", "x'*W*x", "0");
  const Checked result = check(problem);
  const double expected = 1 - 2 * 2 * 0.5 / 3 + 4 * 0.25;
  EXPECT_NEAR(result.costs[0].tail(1)(0), expected, 1e-12);
  // The bound is attained but for exp(-80) of it, which no 31 digits show.
  EXPECT_TRUE(result.findings[0].undecided());
  EXPECT_NEAR(result.findings[0].score, 0, 1e-12);
}

TEST(Cost, JumpCostsAreTakenBeforeTheJump) {
  TextProblem problem = linear_plant("[0, 0; 0, 0]");
  problem.first("1")
      .horizon("2.1")
      .law(Law::constant, {"1"})
      .cost("J", "6", "0", "x(1)^2 + x(2)^2");
  const Checked result = check(problem);
  EXPECT_NEAR(result.costs[0].tail(1)(0), 5 + 5.0 / 4, 1e-12);
  EXPECT_TRUE(result.findings[0].violated());
  EXPECT_NEAR(result.findings[0].value, 6.25, 1e-12);
  EXPECT_EQ(result.findings[0].j, 2);
  EXPECT_NEAR(result.findings[0].score, 0.25 / 6, 1e-12);
}

/// int |cos 7 t| dt has kinks, int sqrt(x'x) dt has none: both are known in closed form.
TEST(Cost, AFlowCostThatIsNoQuadraticFormIsBounded) {
  const double pi = std::acos(-1.0);
  struct Case {
    std::string matrix, cost;
    double horizon, expected;
  };
  const std::vector<Case> cases = {
      {"[-1, 0; 0, -1]", "norm(x)", 1.5, std::sqrt(5.0) * (1 - std::exp(-1.5))},
      {"[0, 7; -7, 0]", "abs(x(1))", 4 * pi / 7, std::sqrt(5.0) * 8 / 7},
      {"[0, 0; 0, -3]", "where(x(2) + 0.5 > 0, 0, 1)", 2, std::log(4.0) / 3}};
  for (const Case& one : cases) {
    for (const bool holds : {true, false}) {
      TextProblem problem = linear_plant(one.matrix);
      problem.first("1.1").jump({}).horizon(std::to_string(one.horizon));
      problem.cost("J", std::to_string(one.expected * (holds ? 1.02 : 0.98)), one.cost, "0");
      const Checked result = check(problem);
      EXPECT_NEAR(result.costs[0].tail(1)(0), one.expected, 0.02 * one.expected) << one.cost;
      EXPECT_EQ(result.findings[0].judgement,
                holds ? claims::Judgement::held : claims::Judgement::violated)
          << one.cost << " " << result.findings[0].value << " +- " << result.findings[0].rounding;
    }
  }
}

TEST(Cost, WhatIsNeverPositiveCountsAsAWhole) {
  TextProblem problem = linear_plant("[-1, 0; 0, -1]");
  problem.first("1.1").jump({}).horizon("1").cost("J", "4", "-x(1)^2", "0");
  const Checked result = check(problem);
  const double expected = -(1 - std::exp(-2.0)) / 2;
  EXPECT_EQ(result.findings[0].judgement, claims::Judgement::held);
  EXPECT_EQ(result.findings[0].t, 1);
  EXPECT_NEAR(result.findings[0].value, expected, 1e-12);
  EXPECT_NEAR(result.findings[0].score, expected / 4 - 1, 1e-12);
}

TEST(Cost, BoundMustHoldAtEveryInstant) {
  // The cost rises to 5 at the first jump and a negative jump cost takes it back afterwards.
  TextProblem problem = linear_plant("[0, 0; 0, 0]");
  problem.first("1").horizon("2.1").law(Law::constant, {"1"});
  problem.cost("J", "4", "0", "where(abs(x(1)) > 0.9, 5, -5)");
  const Checked result = check(problem);
  EXPECT_DOUBLE_EQ(result.costs[0].tail(1)(0), 0);
  EXPECT_TRUE(result.findings[0].violated());
  EXPECT_EQ(result.findings[0].j, 1);
  EXPECT_EQ(result.findings[0].value, 5);
}

TEST(Nonincreasing, RotationKeepsItsNormWhichIsNotCertain) {
  TextProblem problem = linear_plant("[0, -7; 7, 0]");
  problem.jump({}).horizon("100").nonincreasing("V", "x'*x");
  const claims::Finding finding = check(problem).findings[0];
  EXPECT_TRUE(finding.undecided());
  EXPECT_GT(finding.rounding, 0);
  EXPECT_LT(finding.rounding, 1e-9);
}

TEST(Nonincreasing, SlowCreepIsSeen) {
  // Each step raises V by less than 1e-9 of it, all of them by 2e-6.
  TextProblem problem = linear_plant("[1e-8, 0; 0, 1e-8]");
  problem.jump({}).horizon("100").nonincreasing("V", "x'*x");
  const claims::Finding finding = check(problem).findings[0];
  EXPECT_TRUE(finding.violated());
  EXPECT_EQ(finding.t, 100);
  EXPECT_NEAR(finding.score, 2e-6, 1e-9);
}

TEST(Nonincreasing, RiseOverAJumpIsFoundAtTheJump) {
  TextProblem problem = linear_plant("[-0.1, 0; 0, -0.1]");
  problem.jump({{"x", "3*x"}}).first("0.7").horizon("0.8").nonincreasing("V", "x'*x");
  const claims::Finding finding = check(problem).findings[0];
  EXPECT_TRUE(finding.violated());
  EXPECT_EQ(finding.t, 0.7);
  EXPECT_EQ(finding.j, 1);
  EXPECT_NEAR(finding.value, 45 * std::exp(-0.14), 1e-12);
  EXPECT_NEAR(finding.bound, 5 * std::exp(-0.14), 1e-13);
}

TEST(Nonincreasing, HeldRunSaysWhatIsLeft) {
  TextProblem problem = linear_plant("[-0.1, 0; 0, -0.1]");
  problem.jump({}).horizon("5").nonincreasing("V", "x'*x");
  const claims::Finding finding = check(problem).findings[0];
  EXPECT_FALSE(finding.violated());
  EXPECT_NEAR(finding.score, std::exp(-1) - 1, 1e-13);
}

TEST(Shrinks, ComparesTheEndWithTheStart) {
  TextProblem problem = linear_plant("[-0.1, 0; 0, -0.1]");
  problem.first("1").law(Law::constant, {"1"});  // lengths that add up to the horizon exactly
  problem.jump({}).horizon("5").shrinks("most", "norm(x)", "exp(-0.5)");
  problem.shrinks("more", "norm(x)", "exp(-0.5001)");
  const auto findings = check(problem).findings;
  EXPECT_FALSE(findings[0].violated());
  EXPECT_TRUE(findings[1].violated());
  EXPECT_NEAR(findings[1].score, std::expm1(1e-4), 1e-12);
  EXPECT_EQ(findings[1].t, 5);
}

TEST(Shrinks, StartAtZeroHolds) {
  TextProblem problem = linear_plant("[0, 1; 0, 0]");
  problem.horizon("40").shrinks("grows", "abs(x(1) - 1)", "0.1");
  const claims::Finding finding = check(problem).findings[0];
  EXPECT_FALSE(finding.violated());
  EXPECT_EQ(finding.score, -1);
}

TEST(Nonincreasing, DropBelowTheDigitsIsSaid) {
  // x' = 1 - x: V = (x - 1)^2 falls to exp(-200) of its start, far below what 31 digits show of x.
  TextProblem problem = linear_plant("[-1, 0; 0, -1]");
  problem.flow({{"x", "A*x + [1; 1]"}}).jump({}).horizon("100");
  problem.nonincreasing("V", "(x - [1; 1])'*(x - [1; 1])");
  const claims::Finding finding = check(problem).findings[0];
  EXPECT_EQ(finding.judgement, claims::Judgement::held);
  EXPECT_GT(finding.floor, 0);
  EXPECT_LE(finding.floor, 1e-20);
}

TEST(Nonincreasing, DropOverHundredsOfDecadesIsSeenInTheErrorItself) {
  TextProblem problem = linear_plant("[-6, 0; 0, -6]");
  problem.jump({}).horizon("30").nonincreasing("V", "x'*x");  // exp(-360) = 5e-157
  const claims::Finding finding = check(problem).findings[0];
  EXPECT_EQ(finding.judgement, claims::Judgement::held);
  EXPECT_EQ(finding.floor, 0);
}

}  // namespace
}  // namespace gainsmith::verify
