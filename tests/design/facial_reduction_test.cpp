// Designs that hold with equality: objectives are minimised on the face that the solutions share.
#include "design/facial_reduction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "design/solve.h"
#include "numbers/dense.h"

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

}  // namespace
}  // namespace gainsmith::design
