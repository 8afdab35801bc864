// Every problem of the catalogue in every arithmetic, its answer checked by code of the test's own.
#include "sdp/solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "sdp/core/presolve.h"
#include "sdp/schur/sparse_schur.h"
#include "support/sdp_catalogue.h"
#include "support/sdp_check.h"
#include "support/stop.h"

namespace gainsmith::sdp {
namespace {

using testing::CatalogueProblem;
using Answer = CatalogueProblem::Answer;

void expect_optimum(const CatalogueProblem& known, const Solution& solution) {
  ASSERT_EQ(to_string(solution.status), "optimal") << solution.message;
  EXPECT_EQ(solution.cause, Cause::converged);
  const testing::Errors errors = testing::recompute(known.problem, solution, 1e-7L);
  const double allowed = std::pow(10, -known.digits) * std::max(1.0, std::abs(known.optimum));
  EXPECT_NEAR(static_cast<double>(errors.primal_objective), known.optimum, allowed);
  EXPECT_NEAR(static_cast<double>(errors.dual_objective), known.optimum, allowed);
  EXPECT_LT(errors.dual, 1e-7L);
  EXPECT_LT(errors.primal, 1e-7L + errors.rounding);
  EXPECT_LT(std::abs(errors.gap), 1e-7L);
  EXPECT_LT(std::abs(errors.complementarity), 1e-7L);
  EXPECT_TRUE(errors.cone);
  EXPECT_NEAR(solution.primal_objective, static_cast<double>(errors.primal_objective), allowed);
  EXPECT_NEAR(solution.dual_objective, static_cast<double>(errors.dual_objective), allowed);
  EXPECT_NEAR(solution.dimacs[0], static_cast<double>(errors.dual), 1e-8);
  EXPECT_NEAR(solution.dimacs[2], static_cast<double>(errors.primal),
              1e-8 + static_cast<double>(errors.rounding));
  EXPECT_NEAR(solution.dimacs[4], static_cast<double>(errors.gap), 1e-8);
  EXPECT_NEAR(solution.dimacs[5], static_cast<double>(errors.complementarity), 1e-8);
}

void expect_primal_certificate(const Problem& problem, const Solution& solution) {
  const auto Y = testing::unpack(problem, solution.Y, solution.rest.Y);
  EXPECT_TRUE(solution.certificate.checked);
  EXPECT_NEAR(static_cast<double>(testing::inner(problem, problem.f[0], Y)), 1, 1e-9);
  testing::Real residual = 0;
  for (std::size_t i = 1; i < problem.f.size(); ++i)
    residual += std::abs(testing::inner(problem, problem.f[i], Y));
  EXPECT_LE(residual, 1.01e-8L);
  EXPECT_TRUE(testing::positive(Y, 1e-14L));
}

void expect_dual_certificate(const Problem& problem, const Solution& solution) {
  EXPECT_TRUE(solution.certificate.checked);
  testing::Real descent = 0;
  std::vector<testing::Real> x(solution.x.begin(), solution.x.end());
  for (std::size_t i = 0; i < solution.rest.x.size(); ++i) x[i] += solution.rest.x[i];
  for (std::size_t i = 0; i < problem.c.size(); ++i) descent += problem.c[i] * x[i];
  EXPECT_NEAR(static_cast<double>(descent), -1, 1e-9);
  EXPECT_TRUE(testing::positive(testing::combine(problem, x, 0), 1.01e-8L));
}

void expect_answer(const CatalogueProblem& known, const Solution& solution) {
  switch (known.answer) {
    case Answer::optimum:
      return expect_optimum(known, solution);
    case Answer::primal_infeasible:
      ASSERT_EQ(to_string(solution.status), "primal-infeasible") << solution.message;
      return expect_primal_certificate(known.problem, solution);
    case Answer::dual_infeasible:
      ASSERT_EQ(to_string(solution.status), "dual-infeasible") << solution.message;
      return expect_dual_certificate(known.problem, solution);
    case Answer::both_infeasible:
      ASSERT_TRUE(solution.status == Status::primal_infeasible ||
                  solution.status == Status::dual_infeasible)
          << to_string(solution.status) << solution.message;
      break;
    case Answer::weakly_infeasible:
      EXPECT_NE(to_string(solution.status), "optimal");
  }
  if (solution.status == Status::primal_infeasible)
    expect_primal_certificate(known.problem, solution);
  if (solution.status == Status::dual_infeasible) expect_dual_certificate(known.problem, solution);
}

class Catalogue : public ::testing::TestWithParam<std::string> {};

TEST_P(Catalogue, IsAnsweredRightly) {
  for (const CatalogueProblem& known : testing::sdp_catalogue()) {
    SCOPED_TRACE(known.name);
    Options options;
    options.precision = GetParam();
    expect_answer(known, solve(known.problem, options));
  }
}

// The same with a Schur complement that is mostly zero; in 100 digits for the smallest, as the
// others take their time.
TEST_P(Catalogue, IsAnsweredRightlyWithASparseSchurComplement) {
  constexpr int kUnknowns = 160;  // the sparse one is used from 100 on, empty F_i not counted
  constexpr int kSmall = 4;
  for (const CatalogueProblem& part : testing::sdp_catalogue()) {
    int rows = 0;
    for (const Block& block : part.problem.blocks) rows += block.size;
    if (GetParam() == "50" && rows > kSmall) continue;
    const CatalogueProblem known =
        testing::copies(part, std::max(8, kUnknowns / part.problem.m() + 1));
    SCOPED_TRACE(known.name);
    const Presolved presolved = presolve(known.problem);
    EXPECT_TRUE(SparseSchur<double>(presolved.data).worthwhile());
    Options options;
    options.precision = GetParam();
    expect_answer(known, solve(known.problem, options));
  }
}

TEST(Precision, IsTheNarrowestWithTheDigitsAskedFor) {
  const CatalogueProblem known = testing::sdp_catalogue().front();
  for (const auto& [asked, used] : {std::pair{"1", "double"},
                                    {"15", "double"},
                                    {"double", "double"},
                                    {"16", "31 digits"},
                                    {"31", "31 digits"},
                                    {"quad", "31 digits"},
                                    {"32", "100 digits"},
                                    {"100", "100 digits"}}) {
    Options options;
    options.precision = asked;
    EXPECT_EQ(solve(known.problem, options).precision, used) << asked;
  }
}

INSTANTIATE_TEST_SUITE_P(Precision, Catalogue, ::testing::Values("auto", "double", "quad", "50"),
                         [](const auto& p) {
                           return p.param == "50" ? std::string("fifty") : p.param;
                         });

TEST(Solver, GivesTheSameBitsForAnyNumberOfThreads) {
  for (const CatalogueProblem& known : testing::sdp_catalogue()) {
    Options one, two;
    two.threads = 2;
    const Solution a = solve(known.problem, one), b = solve(known.problem, two);
    EXPECT_EQ(a.x, b.x) << known.name;
    EXPECT_EQ(a.Y.values, b.Y.values) << known.name;
    EXPECT_EQ(a.iterations, b.iterations) << known.name;
  }
}

/// minimise sum x_i subject to x_i^2 + x_{i+1}^2 <= 4, as blocks [2 + x_i, x_{i+1}; x_{i+1}, 2 -
/// x_i] >= 0: its Schur complement is tridiagonal.
Problem chain(int links) {
  Problem problem;
  problem.c.assign(static_cast<std::size_t>(links), 1.0);
  problem.f.resize(static_cast<std::size_t>(links) + 1);
  for (int i = 0; i < links; ++i) {
    problem.blocks.push_back({2, false});
    problem.f[0].push_back({i, 0, 0, -2});
    problem.f[0].push_back({i, 1, 1, -2});
    problem.f[static_cast<std::size_t>(i) + 1].push_back({i, 0, 0, 1});
    problem.f[static_cast<std::size_t>(i) + 1].push_back({i, 1, 1, -1});
    if (i > 0) problem.f[static_cast<std::size_t>(i) + 1].push_back({i - 1, 0, 1, 1});
  }
  return problem;
}

TEST(Solver, UsesASparseSchurComplement) {
  // 60 links take the dense path, 120 the sparse one.
  for (const int links : {60, 120}) {
    const Problem problem = chain(links);
    const Solution solution = solve(problem);
    ASSERT_EQ(to_string(solution.status), "optimal") << solution.message;
    const testing::Errors errors = testing::recompute(problem, solution, 1e-7L);
    EXPECT_LT(errors.dual, 1e-7L);
    EXPECT_LT(errors.primal, 1e-7L);
    EXPECT_TRUE(errors.cone);
    EXPECT_NEAR(static_cast<double>(errors.primal_objective),
                static_cast<double>(errors.dual_objective), 1e-6 * links);
  }
}

TEST(Solver, StopsWhereItIsTold) {
  const CatalogueProblem known = testing::sdp_catalogue().front();
  Options few;
  few.iteration_limit = 3;
  const Solution limited = solve(known.problem, few);
  EXPECT_EQ(limited.status, Status::undecided);
  EXPECT_EQ(limited.cause, Cause::iteration_limit);
  EXPECT_EQ(limited.iterations, 3);
  EXPECT_NE(limited.message.find("iteration-limit"), std::string::npos);
}

/// Whenever a stop comes, the best point so far is there, with its own errors.
TEST(Solver, AStopLeavesTheBestPoint) {
  const CatalogueProblem known = testing::sdp_catalogue().front();
  {
    const tests::StopInTest stop(true);
    EXPECT_EQ(solve(known.problem).cause, Cause::interrupted);
  }
  for (const std::string precision : {"double", "quad", "100"}) {
    const tests::StopInTest stop;
    Options options;
    options.precision = precision;
    options.progress = [](const Progress& line) {
      if (line.iteration == 5) request_stop();
    };
    const Solution solution = solve(known.problem, options);
    EXPECT_EQ(solution.cause, Cause::interrupted);
    EXPECT_EQ(solution.iterations, 5);
    const testing::Errors errors = testing::recompute(known.problem, solution, 1e-7L);
    EXPECT_NEAR(static_cast<double>(errors.primal_objective), solution.primal_objective,
                1e-9 * (1 + std::abs(solution.primal_objective)));
  }
}

TEST(Solver, ReportsOneLineAnIteration) {
  int lines = 0;
  Options options;
  options.progress = [&](const Progress& line) { EXPECT_EQ(line.iteration, lines++); };
  const Solution solution = solve(testing::sdp_catalogue().front().problem, options);
  EXPECT_EQ(lines, solution.iterations + 1);
}

TEST(Solver, RefusesWhatIsNoProblem) {
  const Problem good = testing::sdp_catalogue().front().problem;
  const auto refused = [&](auto change) {
    Problem bad = good;
    change(bad);
    EXPECT_THROW(solve(bad), std::invalid_argument);
  };
  refused([](Problem& p) { p.f.pop_back(); });
  refused([](Problem& p) { p.blocks[0].size = 0; });
  refused([](Problem& p) { p.f[1][0].block = 1; });
  refused([](Problem& p) { p.f[1][0].column = 99; });
  refused([](Problem& p) { p.f[1][0].row = -1; });
  refused([](Problem& p) { std::swap(p.f[1][1].row, p.f[1][1].column); });
  refused([](Problem& p) { p.f[1][0].value = std::nan(""); });
  refused([](Problem& p) { p.c[0] = INFINITY; });
  refused([](Problem& p) { p.blocks[0].diagonal = true; });
  for (const char* const precision : {"", "float", "0", "101", "12x"}) {
    Options options;
    options.precision = precision;
    EXPECT_THROW(solve(good, options), std::invalid_argument) << precision;
  }
}

/// The smallest x with x I >= M, M = [2, 1; 1, 2]: 3.
Problem largest_eigenvalue() {
  Problem problem;
  problem.blocks = {{2, false}};
  problem.c = {1};
  problem.f = {{{0, 0, 0, 2}, {0, 0, 1, 1}, {0, 1, 1, 2}}, {{0, 0, 0, 1}, {0, 1, 1, 1}}};
  return problem;
}

TEST(Solver, EndsWhenTheCallerHasEnough) {
  const Problem problem = largest_eigenvalue();
  int asked = 0;
  Options options;
  options.enough = [&](const std::vector<double>& x) {
    ++asked;
    return x[0] > 3 && x[0] < 4;
  };
  const Solution solution = solve(problem, options);
  EXPECT_EQ(solution.status, Status::undecided);
  EXPECT_EQ(solution.cause, Cause::enough);
  EXPECT_EQ(to_string(solution.cause), "enough");
  ASSERT_EQ(solution.x.size(), 1U);
  EXPECT_GT(solution.x[0], 3);
  EXPECT_LT(solution.x[0], 4);
  EXPECT_EQ(asked, solution.iterations + 1);
  options.enough = [](const std::vector<double>&) { return false; };
  EXPECT_EQ(solve(problem, options).status, Status::optimal);
}

TEST(Solver, BeginsAtAPointNearTheSolution) {
  const Problem problem = largest_eigenvalue();
  const Solution far = solve(problem);
  ASSERT_EQ(far.status, Status::optimal);
  Solution near;
  near.x = {3.001};
  near.X.values = {{1.001, -1, -1, 1.001}};
  near.Y.values = {{0.501, 0.499, 0.499, 0.501}};
  Options options;
  options.from = &near;
  const Solution solution = solve(problem, options);
  ASSERT_EQ(solution.status, Status::optimal);
  EXPECT_NEAR(solution.x[0], 3, 1e-7);
  EXPECT_LT(solution.iterations, far.iterations);
}

}  // namespace
}  // namespace gainsmith::sdp
