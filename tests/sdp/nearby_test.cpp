// Solutions within the tolerance, around a centre that is off.
#include "sdp/core/nearby.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sdp/core/ipm.h"
#include "sdp/core/report.h"
#include "support/sdp_catalogue.h"
#include "support/sdp_check.h"

namespace gainsmith::sdp {
namespace {

using testing::CatalogueProblem;

/// The iterate of 31 digits whose errors are below `aim`.
Point<DoubleDouble> point_within(const Problem& problem, double aim) {
  const Presolved presolved = presolve(problem);
  const Options options;
  Ipm<DoubleDouble> ipm(problem, presolved, options);
  ipm.start_far(1);
  EXPECT_EQ(ipm.run({.aim = aim, .feasibility = aim}), Cause::converged);
  const auto& end = ipm.point();
  return restore<DoubleDouble>(problem, presolved, end.x, end.X, end.Y, end.tau);
}

TEST(Nearby, EndsWithinTheToleranceOfWhereItBegan) {
  for (const CatalogueProblem& known : testing::sdp_catalogue()) {
    if (known.answer != CatalogueProblem::Answer::optimum) continue;
    SCOPED_TRACE(known.name);
    const Options options;
    int iterations = 7;
    const Solution solution =
        solve_around(known.problem, options, point_within(known.problem, 1e-5), iterations);
    EXPECT_EQ(to_string(solution.status), "optimal");
    EXPECT_GT(iterations, 7);
    for (const double error : solution.dimacs) EXPECT_LE(std::abs(error), options.tolerance);
    const testing::Errors errors = testing::recompute(known.problem, solution, 1e-7L);
    EXPECT_LT(errors.dual, 1e-7L);
    EXPECT_TRUE(errors.cone);
    EXPECT_NEAR(solution.primal_objective, known.optimum, 1e-4 * (1 + std::abs(known.optimum)));
  }
}

/// x is feasible as it stands, whatever the errors of Y: sum x_i F_i - F_0 has a Cholesky factor.
TEST(Nearby, LeavesAFeasiblePoint) {
  const Problem problem = testing::sdp_catalogue().front().problem;
  int iterations = 0;
  const Solution solution = solve_around(problem, {}, point_within(problem, 1e-5), iterations);
  std::vector<DoubleDouble> x;
  for (std::size_t i = 0; i < solution.x.size(); ++i)
    x.emplace_back(solution.x[i], solution.rest.x[i]);
  EXPECT_TRUE(in_cone(problem, slack(problem, x)));
}

TEST(Nearby, StopsAtTheLimit) {
  const Problem problem = testing::sdp_catalogue().front().problem;
  Options options;
  options.iteration_limit = 3;
  int iterations = 2;
  const Solution solution = solve_around(problem, options, point_within(problem, 1e-5), iterations);
  EXPECT_EQ(solution.status, Status::undecided);
  EXPECT_EQ(solution.cause, Cause::iteration_limit);
  EXPECT_EQ(iterations, 3);
}

}  // namespace
}  // namespace gainsmith::sdp
