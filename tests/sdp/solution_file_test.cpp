#include "sdp/files/solution_file.h"

#include <gtest/gtest.h>

namespace gainsmith::sdp {
namespace {

Problem shape() {
  Problem problem;
  problem.blocks = {{2, false}, {2, true}};
  problem.c = {1, 2};
  problem.f.resize(3);
  return problem;
}

Solution point() {
  Solution solution;
  solution.status = Status::optimal;
  solution.x = {0.5, -2};
  solution.X.values = {{1, 0.25, 0.25, 3}, {4, 0}};
  solution.Y.values = {{0, 0, 0, 7}, {0, 0.5}};
  solution.primal_objective = 1;
  solution.dual_objective = 0.5;
  return solution;
}

TEST(SolutionFile, HasCsdpsLayout) {
  EXPECT_EQ(csdp_solution(shape(), point()),
            "0.5 -2\n"
            "1 1 1 1 1\n1 1 1 2 0.25\n1 1 2 2 3\n1 2 1 1 4\n"
            "2 1 2 2 7\n2 2 2 2 0.5\n");
}

TEST(SolutionFile, HasSdpasLayout) {
  EXPECT_EQ(sdpa_solution(shape(), point()),
            "phase.value  = pdOPT\nobjValPrimal = 1\nobjValDual   = 0.5\n"
            "xVec = \n{0.5,-2}\n"
            "xMat = \n{\n{ {1,0.25},\n  {0.25,3} }\n{4,0}\n}\n"
            "yMat = \n{\n{ {0,0},\n  {0,7} }\n{0,0.5}\n}\n");
}

}  // namespace
}  // namespace gainsmith::sdp
