// Facial reduction on programs whose face and optimum are known.
#include "sdp/core/face.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "sdp/core/ipm.h"
#include "sdp/solver.h"
#include "support/sdp_check.h"

namespace gainsmith::sdp {
namespace {

void expect_optimal(const Problem& problem, const Solution& solution, double tolerance) {
  EXPECT_EQ(to_string(solution.status), "optimal") << solution.message;
  for (const double error : solution.dimacs) EXPECT_LE(std::abs(error), tolerance);
  const testing::Errors errors = testing::recompute(problem, solution, tolerance);
  EXPECT_LT(errors.dual, tolerance);
  EXPECT_LT(errors.primal, tolerance + errors.rounding);
  EXPECT_TRUE(errors.cone);
}

/// Bisection of a cycle with n nodes, n even: max -L.Y / 4, diag(Y) = 1, ee'.Y = 0, hence Y e = 0.
/// Y = sum of the two eigenprojections of L to 2 - 2 cos(2 pi / n), times n / 2, is optimal.
Problem cycle_bisection(int n) {
  Problem problem;
  problem.blocks = {{n, false}};
  problem.f.resize(static_cast<std::size_t>(n) + 2);
  for (int i = 0; i < n; ++i) {
    problem.f[0].push_back({0, i, i, -0.5});
    problem.f[0].push_back({0, std::min(i, (i + 1) % n), std::max(i, (i + 1) % n), 0.25});
    problem.f[static_cast<std::size_t>(i) + 1] = {{0, i, i, 1}};
    for (int j = i; j < n; ++j) problem.f.back().push_back({0, i, j, 1});
  }
  problem.c.assign(static_cast<std::size_t>(n), 1);
  problem.c.push_back(0);
  return problem;
}

/// The relaxation of a quadratic assignment problem of order n after Zhao, Karisch, Rendl and
/// Wolkowicz (1998). Unit row and column sums of the assignment force 2n - 1 kernel vectors, each
/// of which takes a combination of several constraints to expose.
Problem assignment(int n, unsigned seed) {
  std::mt19937 draw(seed);
  const auto symmetric = [&] {
    std::vector<std::vector<double>> a(static_cast<std::size_t>(n),
                                       std::vector<double>(static_cast<std::size_t>(n), 0));
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) a[i][j] = a[j][i] = static_cast<double>(draw() % 10);
    return a;
  };
  const auto a = symmetric(), b = symmetric();
  const auto at = [n](int i, int k) { return 1 + i * n + k; };
  Problem problem;
  problem.blocks = {{n * n + 1, false}};
  problem.f.emplace_back();
  const auto add = [&](double c, std::vector<Entry> f) {
    problem.c.push_back(c);
    problem.f.push_back(std::move(f));
  };
  add(1, {{0, 0, 0, 1}});
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const int p = at(i, k);
      add(0, {{0, 0, p, 1}, {0, p, p, -2}});
      for (int j = i; j < n; ++j)
        for (int l = 0; l < n; ++l) {
          const int q = at(j, l);
          if (p >= q) continue;
          const double cost = a[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] *
                              b[static_cast<std::size_t>(k)][static_cast<std::size_t>(l)];
          if (cost != 0) problem.f[0].push_back({0, p, q, -cost});
          if ((i == j) != (k == l)) add(0, {{0, p, q, 1}});
        }
    }
  for (int i = 0; i < 2 * n - 1; ++i) {
    std::vector<Entry> sum;
    for (int k = 0; k < n; ++k) {
      const int p = i < n ? at(i, k) : at(k, i - n);
      sum.push_back({0, p, p, 1});
    }
    add(1, std::move(sum));
  }
  return problem;
}

/// Where a run in double ends.
struct Ended {
  explicit Ended(const Problem& problem) : presolved(presolve(problem)) {
    const Options options;
    Ipm<double> ipm(problem, presolved, options);
    ipm.start_far(1);
    Run run;
    run.aim = 1e-6;
    ipm.run(run);
    point.emplace(ipm.point());
  }
  Presolved presolved;
  std::optional<Iterate<double>> point;
};

/// c'd, and the largest entry of N'A*(d).
std::pair<double, double> missed(const Face& face, const Problem& problem) {
  DoubleDouble cost(0);
  for (std::size_t i = 0; i < problem.c.size(); ++i) cost += face.direction[i] * problem.c[i];
  double largest = 0;
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    const auto n = static_cast<std::size_t>(problem.blocks[b].size);
    std::vector<std::vector<DoubleDouble>> image(n, std::vector<DoubleDouble>(n));
    for (std::size_t i = 1; i < problem.f.size(); ++i)
      for (const Entry& e : problem.f[i]) {
        if (e.block != static_cast<int>(b)) continue;
        const auto p = static_cast<std::size_t>(e.row), q = static_cast<std::size_t>(e.column);
        image[p][q] += face.direction[i - 1] * e.value;
        if (p != q) image[q][p] += face.direction[i - 1] * e.value;
      }
    for (std::size_t j = 0; j < n; ++j) {
      std::vector<DoubleDouble> column(static_cast<std::size_t>(face.blocks[b].size));
      for (std::size_t i = 0; i < n; ++i)
        for (const Face::Part& part : face.blocks[b].parts[i])
          column[static_cast<std::size_t>(part.row)] += image[i][j] * part.weight;
      for (const DoubleDouble& v : column) largest = std::max(largest, std::abs(v.hi()));
    }
  }
  return {std::abs(cost.hi()), largest};
}

TEST(Face, ExposesTheKernelVectorOfABisection) {
  const Problem problem = cycle_bisection(20);
  const Ended ended(problem);
  const auto face = find_face(problem, ended.presolved, *ended.point);
  ASSERT_TRUE(face);
  EXPECT_EQ(face->blocks[0].size, 19);
  const auto [cost, off] = missed(*face, problem);
  EXPECT_LT(cost, 1e-22);
  EXPECT_LT(off, 1e-22);
}

TEST(Face, ExposesAllKernelVectorsOfAnAssignment) {
  for (const int n : {4, 5, 6}) {
    const Problem problem = assignment(n, 7);
    const Ended ended(problem);
    const auto face = find_face(problem, ended.presolved, *ended.point);
    ASSERT_TRUE(face) << n;
    EXPECT_EQ(face->blocks[0].size, (n - 1) * (n - 1) + 1);
    const auto [cost, off] = missed(*face, problem);
    EXPECT_LT(cost, 1e-22);
    EXPECT_LT(off, 1e-22);
  }
}

TEST(Face, IsAbsentWhereYHasAnInterior) {
  Problem problem = cycle_bisection(20);
  problem.f.pop_back();
  problem.c.pop_back();
  const Ended ended(problem);
  EXPECT_FALSE(find_face(problem, ended.presolved, *ended.point));
}

TEST(Face, AProgramWithABlockForcedToZeroLosesIt) {
  // F_2 . Y = 0 with F_2 > 0 on the last block alone; a point far out along F_2.
  Problem problem;
  problem.blocks = {{1, true}, {2, false}, {2, true}};
  problem.c = {1, 0};
  problem.f = {{{1, 0, 0, 1}, {1, 0, 1, 0.25}},
               {{0, 0, 0, 1}, {1, 0, 0, 1}, {1, 1, 1, 1}},
               {{2, 0, 0, 1}, {2, 1, 1, 2}}};
  const Presolved presolved = presolve(problem);
  Iterate<double> point(presolved.data);
  point.x << 3, 1e6;
  adjoint(presolved.data, point.x, 1.0, point.X);
  const auto face = find_face(problem, presolved, point);
  ASSERT_TRUE(face);
  EXPECT_EQ(face->blocks[2].number, -1);
  const Problem restricted = restrict_to(*face, problem);
  EXPECT_EQ(restricted.blocks, (std::vector<Block>{{1, true}, {2, false}}));
  EXPECT_TRUE(restricted.f[2].empty());
  const Solution solution = solve(restricted);
  const auto lifted = lift(*face, problem, solution, 1e-9);
  ASSERT_TRUE(lifted);
  EXPECT_EQ(lifted->Y[2][0].hi(), 0);
  EXPECT_GT(lifted->X[2][0].hi(), 0);
}

TEST(Face, SolvesBisectionsOfCycles) {
  for (const int n : {16, 60, 100}) {
    SCOPED_TRACE(n);
    const Problem problem = cycle_bisection(n);
    const Solution solution = solve(problem);
    expect_optimal(problem, solution, 1e-8);
    const double optimum = -n * (1 - std::cos(2 * std::numbers::pi / n)) / 2;
    EXPECT_NEAR(solution.dual_objective, optimum, 1e-7 * (1 + std::abs(optimum)));
    EXPECT_NEAR(solution.primal_objective, optimum, 1e-7 * (1 + std::abs(optimum)));
  }
}

TEST(Face, SolvesAssignmentsInDouble) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    SCOPED_TRACE(seed);
    const Problem problem = assignment(6, seed);
    const Solution solution = solve(problem);
    expect_optimal(problem, solution, 1e-8);
    EXPECT_EQ(solution.precision, "double");
  }
}

}  // namespace
}  // namespace gainsmith::sdp
