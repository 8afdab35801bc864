// Directions of wide arithmetic with a Schur complement in double.
#include "sdp/schur/mixed_schur.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>

#include "sdp/core/newton.h"
#include "sdp/core/presolve.h"
#include "sdp/solver.h"

namespace gainsmith::sdp {
namespace {

/// max F_0.Y with diag(Y) = 1 and further products of Y with sparse matrices given.
Problem sparse_program(int n, int m, unsigned seed) {
  std::mt19937 draw(seed);
  std::normal_distribution<double> normal;
  Problem problem;
  problem.blocks = {{n, false}};
  problem.f.resize(1);
  const auto add_entry = [&](std::vector<Entry>& f) {
    int row = static_cast<int>(draw() % static_cast<unsigned>(n));
    int column = static_cast<int>(draw() % static_cast<unsigned>(n));
    if (row > column) std::swap(row, column);
    f.push_back({0, row, column, normal(draw)});
  };
  for (int k = 0; k < 4 * n; ++k) add_entry(problem.f[0]);
  for (int i = 0; i < m; ++i) {
    auto& f = problem.f.emplace_back();
    for (int k = 0; k < 3; ++k) add_entry(f);
    if (i < n) f = {{0, i, i, 1}};
    double trace = 0;
    for (const Entry& e : f)
      if (e.row == e.column) trace += e.value;
    problem.c.push_back(trace);
  }
  return problem;
}

template <typename T>
void expect_same_solution() {
  const Problem problem = sparse_program(16, 100, 5);
  Presolved presolved = presolve(problem);
  Iterate<T> point(presolved.data);
  std::mt19937 draw(1);
  std::normal_distribution<double> normal;
  for (Blocks<T>* v : {&point.X, &point.Y}) {
    Matrix<T> g(16, 16);
    for (Eigen::Index k = 0; k < g.size(); ++k) g.data()[k] = T(normal(draw));
    v->dense(0) = g * g.transpose();
  }
  Newton<T> newton(presolved.data, 1);
  ASSERT_TRUE(newton.factorise(point));
  Defect<T> defect(presolved.data);
  for (Eigen::Index i = 0; i < defect.dual.size(); ++i) defect.dual[i] = T(normal(draw));
  ASSERT_TRUE(newton.prepare(point, defect, Model::fixed, 1e-18));
  Iterate<T> direction(presolved.data);
  newton.predict(point, defect, direction);
  Vector<T> moved(presolved.data.m());
  apply(presolved.data, direction.Y, moved);
  // A(dY) = r to what the direction promises.
  EXPECT_LT(static_cast<double>(T((moved - defect.dual).norm())),
            1.01e-3 * static_cast<double>(T(defect.dual.norm())));

  MixedSchur<T> schur(presolved.data, 1);
  Blocks<T> inverse(presolved.data.layout);
  ConeFactor<T> factor(presolved.data.layout);
  ASSERT_TRUE(factor.factorise(point.X));
  factor.inverse(inverse);
  schur.assemble(inverse, point.Y, false);
  EXPECT_TRUE(schur.rounded());
  ASSERT_TRUE(schur.factorise());
  Vector<T> rounded, exact;
  schur.solve(defect.dual, rounded);
  ASSERT_TRUE(schur.widen());
  EXPECT_FALSE(schur.rounded());
  schur.solve(defect.dual, exact);
  const double difference = static_cast<double>(T((rounded - exact).norm() / exact.norm()));
  EXPECT_LT(difference, 1e-4);
  EXPECT_GT(difference, 0);
  // From then on B is in T at once.
  schur.assemble(inverse, point.Y, false);
  EXPECT_FALSE(schur.rounded());
}

TEST(MixedSchur, HasTheSolutionInDoubleAndInT) {
  expect_same_solution<DoubleDouble>();
  expect_same_solution<Decimal100>();
}

TEST(MixedSchur, WideRunsReachTolerancesFarBelowDouble) {
  const Problem problem = sparse_program(16, 100, 9);
  for (const auto& [precision, tolerance] : {std::pair{"quad", 1e-18}, std::pair{"100", 1e-30}}) {
    Options options;
    options.precision = precision;
    options.tolerance = tolerance;
    const Solution solution = solve(problem, options);
    EXPECT_EQ(to_string(solution.status), "optimal") << precision << ": " << solution.message;
    for (const double error : solution.dimacs) EXPECT_LE(std::abs(error), tolerance);
  }
}

}  // namespace
}  // namespace gainsmith::sdp
