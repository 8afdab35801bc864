#include "sdp/core/forecast.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/error.h"
#include "base/memory.h"
#include "sdp/solver.h"

namespace gainsmith::sdp {
namespace {

/// minimise sum x_i, x_i + x_j >= 1 for neighbours, all of it in one block of `rows` rows: every
/// pair of unknowns shares it, so the Schur complement is dense.
Problem dense(int unknowns, int rows) {
  Problem problem;
  problem.blocks = {{rows, false}};
  problem.c.assign(static_cast<std::size_t>(unknowns), 1);
  problem.f.resize(static_cast<std::size_t>(unknowns) + 1);
  for (int i = 0; i < unknowns; ++i)
    problem.f[static_cast<std::size_t>(i) + 1] = {{0, i % rows, i % rows, 1},
                                                  {0, 0, rows - 1, 1e-3}};
  problem.f[0] = {{0, 0, 0, 1}};
  return problem;
}

TEST(Forecast, WhatDoesNotFitIsRefusedBeforeItIsTaken) {
  const double limit = memory_limit();
  EXPECT_GT(limit, 1e8);
  // 2 m^2 doubles beyond the limit.
  const int m = static_cast<int>(std::sqrt(limit / 16) * 1.1);
  try {
    solve(dense(m, 4));
    FAIL() << "memory for " << m << " unknowns";
  } catch (const InputError& error) {
    EXPECT_NE(error.message().find(std::to_string(m) + " unknowns"), std::string::npos)
        << error.message();
    EXPECT_NE(error.message().find("GB"), std::string::npos);
    EXPECT_NE(error.message().find("--no-solve"), std::string::npos);
  }
  EXPECT_NO_THROW(require_memory(m, 0.9 * limit));
  EXPECT_THROW(require_memory(m, 1.1 * limit), InputError);
}

}  // namespace
}  // namespace gainsmith::sdp
