#include "sdp/schur/matrix_solver.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <random>

#include "sdp/schur/matrix_operator.h"
#include "sdp/schur/matrix_preconditioner.h"
#include "sdp/schur/matrix_scaling.h"
#include "sdp/schur/matrix_schur.h"
#include "sdp/solver.h"
#include "support/linear_algebra.h"
#include "support/stop.h"

namespace gainsmith::sdp {
namespace {

using Doubles = Eigen::MatrixXd;

Doubles normal(std::mt19937& random, Eigen::Index rows, Eigen::Index columns) {
  std::normal_distribution<double> distribution;
  return Doubles::NullaryExpr(rows, columns, [&] { return distribution(random); });
}

DenseMatrix stored(const Doubles& M) {
  return {static_cast<int>(M.rows()), static_cast<int>(M.cols()), {M.data(), M.data() + M.size()}};
}

/// A random matrix whose spectral abscissa is `to`.
Doubles shifted(Doubles A, double to) {
  A.diagonal().array() += to - tests::spectral_abscissa(A);
  return A;
}

/// Largest s with P >= s I, He(V F) >= s I and a bound on the sum of the traces; V = P where there
/// are no outputs, else He(P F1 + Y C).
MatrixProgram margin_program(const Doubles& F, const Doubles& C) {
  const auto n = static_cast<int>(F.rows()), p = static_cast<int>(C.rows());
  const int m = n * (n + 1) / 2, s = m + n * p;
  const Doubles I = Doubles::Identity(n, n);
  MatrixProgram program;
  program.c.assign(static_cast<std::size_t>(s) + 1, 0);
  program.c.back() = -1;
  program.unknowns.push_back({0, n, n, true});
  program.blocks.push_back({n, {{0, stored(0.5 * I), stored(I)}}, {}});
  program.blocks.push_back({n, {{0, stored(I), stored(F)}}, {}});
  if (p > 0) {
    program.unknowns.push_back({m, n, p, false});
    program.blocks[1].products.push_back({1, stored(I), stored(C)});
  }
  for (MatrixProgram::Block& block : program.blocks)
    for (int i = 0; i < n; ++i) block.elements.push_back({s, i, i, -1});
  MatrixProgram::Row row{2.0 * n, {}};
  int at = 0;
  for (int j = 0; j < n; ++j)
    for (int i = j; i < n; ++i, ++at)
      row.coefficients.emplace_back(at, i == j ? -1 - 2 * F(i, i) : -2 * (F(i, j) + F(j, i)));
  for (int j = 0; j < p; ++j)
    for (int i = 0; i < n; ++i) row.coefficients.emplace_back(m + j * n + i, -2 * C(j, i));
  program.rows.push_back(row);
  return program;
}

/// A program with everything that a program may have, of random numbers.
MatrixProgram mixed_program(std::mt19937& random) {
  MatrixProgram program;
  program.c.assign(6 + 6 + 2, 1);
  program.unknowns = {{0, 3, 3, true}, {6, 3, 2, false}};
  Doubles selection = Doubles::Zero(5, 3);
  selection(1, 0) = 1;
  selection(4, 1) = -2;
  program.blocks.push_back({5,
                            {{0, stored(selection), stored(normal(random, 3, 5))},
                             {0, stored(normal(random, 5, 3)), stored(selection.transpose())},
                             {1, stored(normal(random, 5, 3)), stored(normal(random, 2, 5))}},
                            {{-1, 0, 0, 2}, {-1, 0, 3, 1}, {12, 1, 2, 3}, {13, 4, 4, 1}}});
  program.blocks.push_back(
      {2, {{1, stored(normal(random, 2, 3)), stored(normal(random, 2, 2))}}, {{13, 0, 1, 1}}});
  program.rows = {{3, {{0, 1}, {7, -2}, {12, 1}}}, {1, {{13, 1}}}};
  return program;
}

/// The same program in its scalars.
Problem expanded(const MatrixProgram& program) {
  const MatrixOperator L(program);
  Problem problem;
  problem.c = program.c;
  for (const MatrixProgram::Block& block : program.blocks) problem.blocks.push_back({block.size});
  problem.blocks.push_back({static_cast<int>(program.rows.size()), true});
  const auto entries = [](const Blocks<double>& S, double sign) {
    std::vector<Entry> result;
    const int blocks = S.layout().blocks();
    for (int b = 0; b < blocks; ++b)
      for (int j = 0; j < S.dense(b).cols(); ++j)
        for (int i = 0; i <= j; ++i)
          if (S.dense(b)(i, j) != 0) result.push_back({b, i, j, sign * S.dense(b)(i, j)});
    for (int r = 0; r < S.linear().size(); ++r)
      if (S.linear()[r] != 0) result.push_back({blocks, r, r, sign * S.linear()[r]});
    return result;
  };
  problem.f.push_back(entries(L.constant(), -1));
  for (int i = 0; i < L.variables(); ++i) {
    Blocks<double> S(L.layout());
    L.apply(Vector<double>::Unit(L.variables(), i), S);
    problem.f.push_back(entries(S, 1));
  }
  return problem;
}

Blocks<double> random_symmetric(const Layout& layout, std::mt19937& random, bool positive) {
  Blocks<double> Q(layout);
  for (int b = 0; b < layout.blocks(); ++b) {
    const Doubles M = normal(random, Q.dense(b).rows(), Q.dense(b).cols());
    Q.dense(b) = positive ? Doubles(M * M.transpose() + Doubles::Identity(M.rows(), M.cols()))
                          : Doubles(M + M.transpose());
  }
  for (double& element : Q.linear()) element = 1 + std::abs(normal(random, 1, 1)(0, 0));
  return Q;
}

TEST(MatrixOperator, TheAdjointIsTheAdjoint) {
  std::mt19937 random(1);
  const MatrixProgram program = mixed_program(random);
  const MatrixOperator L(program);
  for (int k = 0; k < 5; ++k) {
    const Vector<double> x = normal(random, L.variables(), 1);
    const Blocks<double> Q = random_symmetric(L.layout(), random, false);
    Blocks<double> S(L.layout());
    L.apply(x, S);
    Vector<double> g;
    L.adjoint(Q, g);
    EXPECT_NEAR(inner(S, Q), g.dot(x), 1e-12 * (1 + std::abs(g.dot(x))));
  }
  EXPECT_EQ(L.scalars(), (std::vector<int>{12, 13}));
}

TEST(MatrixOperator, TheSchurOperatorIsWhatItStandsFor) {
  std::mt19937 random(2);
  const MatrixProgram program = mixed_program(random);
  const MatrixOperator L(program);
  SchurOperator M(L);
  const Blocks<double> W = random_symmetric(L.layout(), random, true);
  M.set_scaling(W);
  const Vector<double> x = normal(random, L.variables(), 1);
  Blocks<double> S(L.layout()), scaled(L.layout());
  L.apply(x, S);
  for (int b = 0; b < S.layout().blocks(); ++b)
    scaled.dense(b) = W.dense(b) * S.dense(b) * W.dense(b);
  scaled.linear() = W.linear().cwiseProduct(S.linear());
  Vector<double> expected, found;
  L.adjoint(scaled, expected);
  M.apply(x, found);
  EXPECT_LT((found - expected).norm(), 1e-12 * expected.norm());
  for (const int scalar : L.scalars()) {
    Vector<double> unit = Vector<double>::Unit(L.variables(), scalar);
    M.apply(unit, found);
    EXPECT_NEAR(M.diagonal(scalar), found[scalar], 1e-12 * found[scalar]);
  }
}

TEST(MatrixScaling, TakesOnePointToTheOther) {
  std::mt19937 random(3);
  const Layout layout({4, 7}, 2);
  const Blocks<double> X = random_symmetric(layout, random, true);
  const Blocks<double> S = random_symmetric(layout, random, true);
  Scaling scaling(layout);
  Blocks<double> R = X;
  for (int b = 0; b < 2; ++b) R.dense(b) = Doubles(tests::cholesky_factor(X.dense(b)));
  ASSERT_TRUE(scaling.prepare(R, S));
  Blocks<double> image(layout);
  scaling.inward(S, image);
  for (int b = 0; b < 2; ++b) {
    const Doubles W = scaling.W().dense(b), D = scaling.d(b).asDiagonal();
    EXPECT_LT((W * S.dense(b) * W - X.dense(b)).norm(), 1e-11 * X.dense(b).norm());
    EXPECT_LT((image.dense(b) - D).norm(), 1e-11 * D.norm());
  }
  EXPECT_LT((scaling.W().linear().cwiseProduct(S.linear()) - X.linear()).norm(), 1e-13);
  EXPECT_LT((image.linear() - scaling.linear_d()).norm(), 1e-13);
  // One half of X is left after half of the step to 0.
  Blocks<double> halved(layout), square_of_it(layout), toward = image;
  toward.flat() *= -1;
  ASSERT_TRUE(scaling.factor(toward, 0.5, halved));
  square(halved, square_of_it);
  EXPECT_LT((2 * square_of_it.flat() - X.flat()).norm(), 1e-11 * X.flat().norm());
  EXPECT_FALSE(scaling.factor(toward, 1.1, halved));
  // diag(d) - a diag(d) stays inside up to a = 1.
  Blocks<double> back = image;
  back.flat() *= -1;
  EXPECT_NEAR(scaling.step(back, 10), 1, 0.02);
}

TEST(MatrixPreconditioner, IsTheInverseForOneBlockOfOneMatrix) {
  std::mt19937 random(4);
  const Doubles I = Doubles::Identity(6, 6);
  MatrixProgram program;
  program.c.assign(21, 0);
  program.unknowns = {{0, 6, 6, true}};
  program.blocks = {{6, {{0, stored(0.5 * I), stored(I)}}, {}}};
  const MatrixOperator L(program);
  Scaling scaling(L.layout());
  // Any square matrix is a factor of some X.
  ASSERT_TRUE(scaling.prepare(random_symmetric(L.layout(), random, true),
                              random_symmetric(L.layout(), random, true)));
  SchurOperator M(L);
  M.set_scaling(scaling.W());
  Preconditioner preconditioner(L);
  preconditioner.prepare(M, scaling.G());
  const Vector<double> x = normal(random, 21, 1);
  Vector<double> image, back;
  M.apply(x, image);
  preconditioner.apply(image, back);
  EXPECT_LT((back - x).norm(), 1e-10 * x.norm());
}

TEST(MatrixSchur, TheFactorIsThatOfTheOperator) {
  std::mt19937 random(9);
  MatrixProgram program = mixed_program(random);
  // Z beside P alone in a block, and beside Y in a row.
  program.c.resize(17, 1);
  program.unknowns.push_back({14, 2, 2, true});
  program.blocks.push_back({4,
                            {{0, stored(normal(random, 4, 3)), stored(normal(random, 3, 4))},
                             {2, stored(normal(random, 4, 2)), stored(normal(random, 2, 4))}},
                            {}});
  program.rows.push_back({2, {{8, 1}, {15, -3}}});
  const MatrixOperator L(program);
  SchurOperator M(L);
  const Blocks<double> W = random_symmetric(L.layout(), random, true);
  M.set_scaling(W);
  MatrixSchur factored(L);
  ASSERT_TRUE(factored.prepare(M, W));
  for (Eigen::Index i = 0; i < L.variables(); ++i) {
    const Vector<double> x = Vector<double>::Unit(L.variables(), i);
    Vector<double> image, back;
    M.apply(x, image);
    factored.apply(image, back);
    EXPECT_LT((back - x).norm(), 1e-9) << i;
  }
}

TEST(MatrixSolver, FindsAPointInside) {
  for (const int n : {4, 12, 25}) {
    std::mt19937 random(static_cast<unsigned>(n));
    const Doubles A = shifted(0.3 * normal(random, n, n), -0.1);
    const MatrixProgram program = margin_program(-A, Doubles(0, n));
    MatrixOptions options;
    options.start.assign(program.c.size(), 0);
    options.start.back() = -1;
    options.enough = [](const std::vector<double>& x) { return x.back() > 1e-9; };
    const Solution found = solve(program, options);
    ASSERT_EQ(found.cause, Cause::enough) << n;
    const MatrixOperator L(program);
    const Doubles P = L.unpack(0, Eigen::Map<const Vector<double>>(
                                      found.x.data(), static_cast<Eigen::Index>(found.x.size())));
    EXPECT_GT(tests::symmetric_eigenvalues(P)(0), 0);
    const Doubles decrease = -(P * A + A.transpose() * P);
    EXPECT_GT(tests::symmetric_eigenvalues(decrease)(0), 0);
  }
}

TEST(MatrixSolver, FindsAnObserver) {
  std::mt19937 random(7);
  const int n = 16;
  const Doubles A = shifted(0.3 * normal(random, n, n), 0.3), C = normal(random, 4, n);
  const MatrixProgram program = margin_program(-A, C);
  MatrixOptions options;
  options.start.assign(program.c.size(), 0);
  options.start.back() = -1;
  options.enough = [](const std::vector<double>& x) { return x.back() > 1e-9; };
  EXPECT_EQ(solve(program, options).cause, Cause::enough);
}

TEST(MatrixSolver, TheLargestMarginIsThatOfTheOrdinarySolver) {
  // P >= s I, a P >= s I (2 a in F = a I), trace(P) (1 + 2 a) <= 2 n: s = min(1, 2 a) 2 / (1 + 2
  // a).
  const int n = 8;
  for (const double a : {0.1, 0.5, 3.0}) {
    const MatrixProgram program = margin_program(a * Doubles::Identity(n, n), Doubles(0, n));
    MatrixOptions options;
    options.start.assign(program.c.size(), 0);
    options.start.back() = -1;
    const Solution found = solve(program, options);
    EXPECT_EQ(found.cause, Cause::converged);
    EXPECT_NEAR(found.x.back(), std::min(1.0, 2 * a) * 2 / (1 + 2 * a), 1e-7);
    EXPECT_LE(found.relative_gap, options.tolerance);
  }
}

TEST(MatrixSolver, AMinimumThatTakesTheFactorIsThatOfTheOrdinarySolver) {
  // Conjugate gradients alone give up well before this gap.
  std::mt19937 random(10);
  const int n = 12;
  const Doubles A = shifted(0.3 * normal(random, n, n), 0.1), C = normal(random, 3, n);
  const MatrixProgram program = margin_program(-A, C);
  MatrixOptions options;
  options.tolerance = 1e-9;
  const Solution found = solve(program, options);
  ASSERT_EQ(found.cause, Cause::converged);
  const Solution ordinary = solve(expanded(program));
  ASSERT_EQ(ordinary.status, Status::optimal);
  EXPECT_NEAR(found.primal_objective, ordinary.primal_objective,
              1e-7 * (1 + std::abs(ordinary.primal_objective)));
}

TEST(MatrixSolver, OfAnUnstableMatrixNoPointIsInside) {
  std::mt19937 random(5);
  const int n = 10;
  const Doubles A = shifted(0.3 * normal(random, n, n), 0.2);
  const MatrixProgram program = margin_program(-A, Doubles(0, n));
  MatrixOptions options;
  options.start.assign(program.c.size(), 0);
  options.start.back() = -1;
  const Solution found = solve(program, options);
  EXPECT_LT(std::abs(found.x.back()), 1e-6);
}

TEST(MatrixSolver, BeginsOutsideWithoutAStart) {
  std::mt19937 random(8);
  const Doubles A = shifted(0.3 * normal(random, 12, 12), -0.3);
  const MatrixProgram program = margin_program(-A, Doubles(0, 12));
  MatrixOptions options;
  options.tolerance = 1e-6;
  const Solution far = solve(program, options);
  options.start.assign(program.c.size(), 0);
  options.start.back() = -1;
  const Solution near = solve(program, options);
  ASSERT_EQ(far.cause, Cause::converged);
  EXPECT_NEAR(far.primal_objective, near.primal_objective, 1e-5);
}

TEST(MatrixSolver, EndsWhenAllIsToStop) {
  std::mt19937 random(9);
  const MatrixProgram program =
      margin_program(-shifted(normal(random, 20, 20), -0.1), Doubles(0, 20));
  const tests::StopInTest stop(true);
  EXPECT_THROW(solve(program, {}), Stopped);
}

}  // namespace
}  // namespace gainsmith::sdp
