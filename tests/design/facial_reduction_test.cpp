// Designs that hold with equality: objectives are minimised on the face that the solutions share.
#include "design/facial_reduction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "design/solve.h"
#include "numbers/dense/dense.h"

namespace gainsmith::design {
namespace {

/// min <C, P> over P >= 0 of trace 1 is the smallest eigenvalue of C.
TEST(FacialReduction, TheLeastObjectiveUnderATraceIsAnEigenvalue) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    RandomStream random(0xFACE, seed);
    const int n = 2 + static_cast<int>(seed % 3);
    const numbers::Matrix C = random_symmetric(random, n);
    const model::Gains gains = solve(
        "  data: {C: n x n}\n  unknowns: {P: symmetric n}\n"
        "  require: {shape: P >= 0, above: trace(P) >= 1, below: trace(P) <= 1}\n"
        "  minimize: trace(C*P)\n",
        "data: {C: " + tests::matrix_yaml(C) + "}\n");
    ASSERT_EQ(gains.verdict, model::Verdict::yes) << seed;
    EXPECT_EQ(gains.solver.status, "optimal") << seed;
    const double least = numbers::smallest_eigenvalue(C);
    EXPECT_NEAR(*gains.objective, least, 1e-6) << seed;
    EXPECT_NEAR(*gains.objective_lower_bound, least, 1e-6) << seed;
    EXPECT_LE(*gains.objective_lower_bound, *gains.objective) << seed;
    const numbers::Matrix& P = gains.unknowns.front().second;
    EXPECT_GE(numbers::smallest_eigenvalue(P), 0) << seed;
    EXPECT_NEAR(C.cwiseProduct(P).sum(), *gains.objective, 1e-9) << seed;
  }
}

TEST(FacialReduction, AnObjectiveThatTheFaceDeterminesIsOptimal) {
  const model::Gains all = solve(
      "  unknowns: {P: symmetric 2}\n"
      "  require: {shape: P > 0, above: trace(P) >= 4, below: trace(P) <= 4}\n"
      "  minimize: trace(P)\n");
  EXPECT_EQ(all.verdict, model::Verdict::yes);
  EXPECT_EQ(all.solver.status, "optimal");
  EXPECT_NEAR(*all.objective, 4, 1e-12);
  EXPECT_NEAR(*all.objective_lower_bound, 4, 1e-12);

  const model::Gains one = solve(
      "  unknowns: {x: scalar, y: scalar}\n  require: {low: x >= 3, high: x <= 3, "
      "left: y >= 2*x, right: y <= 6}\n  minimize: y - x\n");
  EXPECT_EQ(one.verdict, model::Verdict::yes);
  EXPECT_EQ(one.solver.status, "optimal");
  EXPECT_EQ(*one.objective, 3);
  EXPECT_EQ(*one.objective_lower_bound, 3);
}

TEST(FacialReduction, WithoutAMinimumThePointIsOnlyFeasible) {
  const model::Gains gains = solve(
      "  unknowns: {x: scalar, y: scalar}\n"
      "  require: {above: x + y >= 1, below: x + y <= 1, right: y > 0}\n  minimize: x\n");
  EXPECT_EQ(gains.verdict, model::Verdict::yes);
  EXPECT_EQ(gains.solver.status, "feasible");
  EXPECT_FALSE(gains.objective_lower_bound);
}

void expect_minimum(const model::Gains& gains, double least, const std::string& what) {
  ASSERT_EQ(gains.verdict, model::Verdict::yes) << what << ": " << gains.solver.message;
  EXPECT_EQ(gains.solver.status, "optimal") << what << ": " << gains.solver.message;
  const double size = std::abs(least);
  EXPECT_NEAR(*gains.objective, least, 1e-6 * size) << what;
  ASSERT_TRUE(gains.objective_lower_bound) << what;
  EXPECT_NEAR(*gains.objective_lower_bound, least, 1e-6 * size) << what;
  EXPECT_LE(*gains.objective_lower_bound, least + 1e-15 * size) << what;
}

/// -X(1, 1) is least for X = v v' with v the projection of e_1, v'v = 1: 1/n - 1.
TEST(FacialReduction, CentredGramMatricesHaveTheirMinimum) {
  for (int n = 3; n <= 7; ++n) {
    const std::string order = std::to_string(n);
    for (const char* margin : {"", "synthesis: {margin: 1e-7}\n"})
      expect_minimum(
          solve("  unknowns: {X: symmetric " + order +
                    "}\n  require: {psd: X >= 0, centred: \"X*ones(" + order + ", 1) == zeros(" +
                    order + ", 1)\", total: trace(X) == 1}\n  minimize: -X(1, 1)\n",
                margin),
          1.0 / n - 1, order + margin);
  }
}

/// The Laplacian of a path or a cycle whose weights have the sum 1: its second eigenvalue is
/// largest for weights i (n - i) / sum, 1 / sum in all; for equal weights, 2 (1 - cos(2 pi / n)) /
/// n in all.
TEST(FacialReduction, LaplaciansHaveTheirLargestSecondEigenvalue) {
  for (int n = 3; n <= 6; ++n) {
    for (const bool cycle : {false, true}) {
      const int edges = cycle ? n : n - 1;
      numbers::Matrix B = numbers::Matrix::Zero(n, edges);
      for (int e = 0; e < edges; ++e) {
        B(e, e) = 1;
        B((e + 1) % n, e) = -1;
      }
      double sum = 0;
      for (int i = 1; i < n; ++i) sum += 0.5 * i * (n - i);
      const double most = cycle ? 2 * (1 - std::cos(2 * std::acos(-1.0) / n)) / n : 1 / sum;
      expect_minimum(
          solve("  data: {B: n x m}\n  unknowns: {w: m, g: scalar}\n  require: {connected: "
                "\"B*diag(w)*B' >= g*(eye(n) - ones(n)/n)\", weights: diag(w) >= 0, total: "
                "\"ones(1, m)*w == 1\"}\n"
                "  minimize: -g\n",
                "data: {B: " + tests::matrix_yaml(B) + "}\n"),
          -most, std::to_string(n) + (cycle ? " in a cycle" : " in a row"));
    }
  }
}

/// [1, -1; -1, 1] (1 - g/2) >= 0.
TEST(FacialReduction, AnObjectiveOfAnEquationAndAFaceIsFound) {
  expect_minimum(solve("  unknowns: {x: scalar, g: scalar}\n  require: {psd: \"[x, -x; -x, x] >= "
                       "g*(eye(2) - ones(2)/2)\", eq: x == 1}\n  minimize: -g\n"),
                 -2, "face");
}

/// Each step is in the gain file, so that it can be checked.
TEST(FacialReduction, AChainOfStepsIsACertificateInFractions) {
  const model::Gains gains = solve(
      "  unknowns: {P: symmetric 2}\n"
      "  require: {size: trace(P) <= 0, positive: P >= 0, off: \"P(1, 2) == 1\"}\n");
  ASSERT_EQ(gains.verdict, model::Verdict::no);
  const model::AlgebraicRecord& record = gains.certificate.value().algebraic.value();
  EXPECT_EQ(record.steps(), 2);
  for (const auto& term : record.terms)
    EXPECT_EQ(term.step == 1, term.block == "off") << term.block;
  EXPECT_FALSE(gains.certificate->multipliers.empty());
}

}  // namespace
}  // namespace gainsmith::design
