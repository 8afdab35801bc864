#include <gtest/gtest.h>

#include "api/gainsmith.h"

namespace gainsmith::api {
namespace {

/// min t with [t, 1; 1, t] >= 0 and a diagonal block 3 - t >= 0.
Sdp small_program() {
  Sdp program;
  program.blocks = {{2, false}, {1, true}};
  program.costs = {1};
  program.entries = {{0, 0, 0, 1, -1}, {0, 1, 0, 0, -3}, {1, 0, 0, 0, 1},
                     {1, 0, 1, 1, 1},  {1, 1, 0, 0, -1}};
  return program;
}

TEST(Solve, GivesThePointOfBothPrograms) {
  const SdpSolution solution = solve(small_program());
  ASSERT_EQ(solution.status, SdpStatus::optimal);
  EXPECT_NEAR(solution.x.at(0), 1, 1e-6);
  ASSERT_EQ(solution.X.size(), 2U);
  EXPECT_NEAR(solution.X[0](0, 1), 1, 1e-6);
  EXPECT_NEAR(solution.X[1](0, 0), 2, 1e-6);
  // F_1 . Y = 1, and X Y = 0 gives Y = [1, -1; -1, 1]/2.
  EXPECT_NEAR(solution.Y[0](0, 1), -0.5, 1e-6);
  EXPECT_NEAR(solution.dual_objective, 1, 1e-6);
}

TEST(Solve, SaysThatThereIsNoPoint) {
  Sdp program = small_program();
  program.entries[1].value = -0.5;  // t <= 0.5
  EXPECT_EQ(solve(program).status, SdpStatus::primal_infeasible);
}

TEST(Solve, RefusesWhatIsNoProgram) {
  Sdp program = small_program();
  program.entries.push_back({2, 0, 0, 0, 1});
  EXPECT_THROW(solve(program), Error);
  program = small_program();
  program.entries.push_back({1, 0, 1, 0, 1});  // below the diagonal
  EXPECT_THROW(solve(program), Error);
  program = small_program();
  SdpOptions options;
  options.precision = "some";
  EXPECT_THROW(solve(program, options), Error);
}

}  // namespace
}  // namespace gainsmith::api
