// Stopping in the middle of an iteration, and allowances of work.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <random>
#include <thread>

#include "base/stop.h"
#include "sdp/solver.h"
#include "support/stop.h"

namespace gainsmith::sdp {
namespace {

/// Dense F_i: one iteration in 100 digits takes minutes.
Problem large() {
  constexpr int n = 60, m = 400;
  std::mt19937 draw(3);
  std::normal_distribution<double> normal;
  Problem problem;
  problem.blocks = {{n, false}};
  problem.f.resize(m + 1);
  problem.c.assign(m, 0);
  for (int i = 0; i <= m; ++i)
    for (int row = 0; row < n; ++row)
      for (int column = row; column < n; ++column) {
        const double value = normal(draw);
        problem.f[static_cast<std::size_t>(i)].push_back({0, row, column, value});
        if (i > 0 && row == column) problem.c[static_cast<std::size_t>(i) - 1] += value;
      }
  return problem;
}

TEST(Stop, EndsARunIn100DigitsWithinAnIteration) {
  const Problem problem = large();
  Options options;
  options.precision = "100";
  const tests::StopInTest stop;
  const Allowance work(1e9);
  std::atomic<double> begun = 1e9;  // work when the first iteration began
  options.progress = [&](const Progress&) { begun = std::min<double>(begun, work.spent()); };
  double asked = 0;
  std::jthread impatient([&](const std::stop_token& ended) {
    while (work.spent() < begun + 0.1 && !ended.stop_requested()) std::this_thread::yield();
    request_stop();
    asked = work.spent();
  });
  const Solution solution = solve(problem, options);
  impatient.request_stop();
  impatient.join();
  EXPECT_EQ(solution.status, Status::undecided);
  EXPECT_EQ(solution.cause, Cause::interrupted);
  EXPECT_EQ(solution.x.size(), problem.c.size());
  EXPECT_GT(asked, begun);
  EXPECT_LT(work.spent(), asked + 1);
}

TEST(Stop, BeforeTheFirstPointThereIsNone) {
  const Problem problem = large();
  for (const char* precision : {"auto", "100"}) {
    Options options;
    options.precision = precision;
    const tests::StopInTest stop(true);
    const Solution solution = solve(problem, options);
    EXPECT_EQ(solution.status, Status::undecided);
    EXPECT_EQ(solution.cause, Cause::interrupted);
    EXPECT_TRUE(solution.x.empty() || solution.x.size() == problem.c.size());
    EXPECT_EQ(solution.iterations, 0);
    EXPECT_FALSE(solution.message.empty());
  }
}

TEST(Stop, PassesOutOfAllowanceToTheCaller) {
  const Problem problem = large();
  Options options;
  options.precision = "100";
  const Allowance allowance(0.2);
  EXPECT_THROW(solve(problem, options), OutOfAllowance);
  EXPECT_LT(allowance.spent(), 1);
}

TEST(Stop, CountsTheSameWorkForAnyNumberOfThreads) {
  const Problem problem = large();
  std::vector<double> spent;
  for (const unsigned threads : {1u, 2u}) {
    Options options;
    options.precision = "double";
    options.iteration_limit = 5;
    options.threads = threads;
    const Allowance allowance(1e9);
    solve(problem, options);
    spent.push_back(allowance.spent());
  }
  EXPECT_GT(spent[0], 0);
  EXPECT_NEAR(spent[1] / spent[0], 1, 1e-9);
}

}  // namespace
}  // namespace gainsmith::sdp
