// The projection onto a polytope of a random metric: ours, SLSQP of NLopt, and the cone solver on
// the semidefinite program
//   minimise t   b - A z >= 0,   [I, L'(z - x); *, t] >= 0
// `off` is the largest excess of a row in units of the rounding of its terms, `far` the relative
// distance to the point in 100 digits: of the worst of 20 sets with 2 n rows.
#include <benchmark/benchmark.h>
#include <nlopt.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <random>
#include <vector>

#include "base/eigen_scalars.h"
#include "numerics/projection.h"
#include "sdp/solver.h"

namespace gainsmith::numerics {
namespace {

struct Set {
  Matrix P, A, b, x;
};

std::vector<Set> sets(int n) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  const auto matrix = [&](int rows, int cols) {
    return Matrix(Matrix::NullaryExpr(rows, cols, [&] { return number(random); }));
  };
  std::vector<Set> result;
  for (int k = 0; k < 20; ++k) {
    const Matrix G = matrix(n, n);
    const Matrix scale = Vector(Vector::NullaryExpr(n, [&] {
                           return std::pow(10, 2 * number(random));
                         })).asDiagonal();
    Set set{scale * (G * G.transpose() + 0.1 * Matrix::Identity(n, n)) * scale,
            matrix(2 * n, n),
            {},
            3 * matrix(n, 1)};
    set.b = set.A * matrix(n, 1) + matrix(2 * n, 1).cwiseAbs();
    result.push_back(set);
  }
  return result;
}

Matrix ours(const Set& set) { return project_polytope<double>(set.x, set.P, set.A, set.b).point; }

Matrix slsqp(const Set& set) {
  const auto n = static_cast<unsigned>(set.x.size()), m = static_cast<unsigned>(set.b.size());
  using Map = Eigen::Map<const Vector>;
  nlopt_opt search = nlopt_create(NLOPT_LD_SLSQP, n);
  const auto objective = [](unsigned count, const double* z, double* slope, void* data) {
    const Set& of = *static_cast<const Set*>(data);
    const Vector step = Map(z, count) - of.x, force = of.P * step;
    if (slope != nullptr) Eigen::Map<Vector>(slope, count) = 2 * force;
    return step.dot(force);
  };
  const auto rows = [](unsigned count, double* value, unsigned dim, const double* z, double* slope,
                       void* data) {
    const Set& of = *static_cast<const Set*>(data);
    Eigen::Map<Vector>(value, count) = of.A * Map(z, dim) - of.b;
    if (slope != nullptr) Eigen::Map<Matrix>(slope, dim, count) = of.A.transpose();
  };
  auto* data = const_cast<Set*>(&set);  // NLopt's interface is C
  nlopt_set_min_objective(search, objective, data);
  nlopt_add_inequality_mconstraint(search, m, rows, data, nullptr);
  nlopt_set_xtol_rel(search, 1e-15);
  nlopt_set_maxeval(search, 1000);
  Matrix z = set.x;
  double value = 0;
  nlopt_optimize(search, z.data(), &value);
  nlopt_destroy(search);
  return z;
}

Matrix cone(const Set& set) {
  const int n = static_cast<int>(set.x.size()), rows = static_cast<int>(set.b.size());
  const Matrix L = set.P.llt().matrixL();
  const Matrix at = L.transpose() * set.x;
  sdp::Problem problem;
  problem.blocks = {{rows, true}, {n + 1, false}};
  problem.c.assign(static_cast<std::size_t>(n), 0);
  problem.c.push_back(1);
  problem.f.resize(static_cast<std::size_t>(n) + 2);
  // X = sum_i z_i F_i + t F_t - F_0.
  for (int i = 0; i < rows; ++i) {
    problem.f[0].push_back({0, i, i, -set.b(i)});
    for (int j = 0; j < n; ++j)
      problem.f[static_cast<std::size_t>(j) + 1].push_back({0, i, i, -set.A(i, j)});
  }
  for (int i = 0; i < n; ++i) {
    problem.f[0].push_back({1, i, i, -1});
    problem.f[0].push_back({1, i, n, at(i)});
    for (int j = 0; j < n; ++j)
      if (L(j, i) != 0) problem.f[static_cast<std::size_t>(j) + 1].push_back({1, i, n, L(j, i)});
  }
  problem.f.back().push_back({1, n, n, 1});
  sdp::Options options;
  options.precision = "double";
  options.tolerance = 1e-12;
  const sdp::Solution solution = sdp::solve(problem, options);
  return Eigen::Map<const Vector>(solution.x.data(), n);
}

template <class Scalar>
MatrixOf<Scalar> as_matrix(const Matrix& M) {
  return M.cast<Scalar>();
}

template <Matrix (*project)(const Set&)>
void projection(benchmark::State& state) {
  const std::vector<Set> all = sets(static_cast<int>(state.range(0)));
  for (auto _ : state)
    for (const Set& set : all) benchmark::DoNotOptimize(project(set));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.size()));
  double off = 0, far = 0;
  for (const Set& set : all) {
    const Matrix z = project(set);
    const auto exact =
        project_polytope<Decimal100>(as_matrix<Decimal100>(set.x), as_matrix<Decimal100>(set.P),
                                     as_matrix<Decimal100>(set.A), as_matrix<Decimal100>(set.b));
    const Matrix right =
        exact.point.unaryExpr([](const Decimal100& value) { return static_cast<double>(value); });
    const Vector size = set.A.cwiseAbs() * z.cwiseAbs() + set.b.cwiseAbs();
    off = std::max(off, ((set.A * z - set.b).array() / (size.array() * 0x1p-52)).maxCoeff());
    far = std::max(far, (z - right).norm() / right.norm());
  }
  state.counters["off"] = off;
  state.counters["far"] = far;
}

BENCHMARK(projection<ours>)->Name("ours")->Arg(2)->Arg(3)->Arg(8)->Arg(20);
BENCHMARK(projection<slsqp>)->Name("slsqp")->Arg(2)->Arg(3)->Arg(8)->Arg(20);
BENCHMARK(projection<cone>)->Name("cone")->Arg(2)->Arg(3)->Arg(8)->Arg(20);

}  // namespace
}  // namespace gainsmith::numerics

BENCHMARK_MAIN();
