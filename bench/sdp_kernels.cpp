// Flop rates of the SDP solver's kernels. `peak` is the rate that a large product reaches on this
// machine: the others are to be read against it.
#include <benchmark/benchmark.h>

#include <Eigen/Core>

#include "sdp/schur/factor.h"
#include "sdp/schur/kernels.h"
#include "sdp/schur/schur.h"

namespace gainsmith::sdp {
namespace {

void rate(benchmark::State& state, double multiplications) {
  state.counters["flops"] =
      benchmark::Counter(2 * multiplications, benchmark::Counter::kIsIterationInvariantRate,
                         benchmark::Counter::kIs1000);
}

template <typename T>
Matrix<T> positive(Eigen::Index n) {
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(n, n);
  return (a * a.transpose() + static_cast<double>(n) * Eigen::MatrixXd::Identity(n, n)).cast<T>();
}

template <typename T>
void product(benchmark::State& state) {
  const Eigen::Index n = state.range(0);
  const Matrix<T> a = positive<T>(n), b = positive<T>(n);
  Matrix<T> c(n, n);
  for (auto _ : state) {
    multiply(View<const T>(a), View<const T>(b), View<T>(c));
    benchmark::DoNotOptimize(c.data());
  }
  const auto size = static_cast<double>(n);
  rate(state, size * size * size);
}

template <typename T>
void factor(benchmark::State& state) {
  const Eigen::Index n = state.range(0);
  const Matrix<T> a = positive<T>(n);
  for (auto _ : state) {
    Matrix<T> l = a;
    benchmark::DoNotOptimize(cholesky(View<T>(l)));
  }
  const auto size = static_cast<double>(n);
  rate(state, size * size * size / 6);
}

/// Lyapunov operators of an n x n matrix: F_ij = -(A' E_ij + E_ij A), the shape of control LMIs.
Data lyapunov(int n) {
  Data data;
  data.layout = Layout({n}, 0);
  BlockData& block = data.dense.emplace_back();
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(n, n);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i <= j; ++i) {
      Eigen::MatrixXd e = Eigen::MatrixXd::Zero(n, n);
      e(i, j) = e(j, i) = 1;
      const Eigen::MatrixXd f = -(a.transpose() * e + e * a);
      data.c.push_back(1);
      data.c_rest.push_back(0);
      block.constraint.push_back(data.m());
      for (int q = 0; q < n; ++q)
        for (int p = 0; p <= q; ++p)
          if (f(p, q) != 0) block.terms.push_back({p, q, f(p, q), 0});
      block.start.push_back(block.terms.size());
    }
  return data;
}

/// Counted as m products X^-1 (F_i Y) and m^2/2 inner products, whatever formula is used.
template <typename T>
void schur(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0));
  const Data data = lyapunov(n);
  Blocks<T> X(data.layout), Y(data.layout);
  X.dense(0) = positive<T>(n);
  Y.dense(0) = positive<T>(n);
  Schur<T> system(data);
  for (auto _ : state) system.assemble(X, Y);
  const double m = data.m(), terms = static_cast<double>(data.dense[0].terms.size());
  rate(state, m * n * n * n + 2 * terms * n + m * terms / 2);
}

template <typename T>
void step(benchmark::State& state) {
  const int n = static_cast<int>(state.range(0));
  const Layout layout({n}, 0);
  Blocks<T> V(layout), D(layout);
  V.dense(0) = positive<T>(n);
  const Eigen::MatrixXd d = Eigen::MatrixXd::Random(n, n);
  D.dense(0) = (d + d.transpose()).cast<T>() * T(static_cast<double>(n));
  ConeFactor<T> cone(layout);
  for (auto _ : state) {
    cone.factorise(V);
    benchmark::DoNotOptimize(cone.step(D, T(1)));
  }
  const auto size = static_cast<double>(n);
  rate(state, size * size * size / 3);
}

BENCHMARK(product<double>)->Name("peak/double")->Arg(1024);
BENCHMARK(product<double>)->Name("product/double")->Arg(15)->Arg(60)->Arg(250);
BENCHMARK(product<DoubleDouble>)->Name("product/31-digits")->Arg(15)->Arg(60)->Arg(250);
BENCHMARK(schur<double>)->Name("schur/double")->Arg(10)->Arg(20)->Arg(30);
BENCHMARK(schur<DoubleDouble>)->Name("schur/31-digits")->Arg(10)->Arg(20)->Arg(30);
BENCHMARK(factor<double>)->Name("cholesky/double")->Arg(60)->Arg(500)->Arg(1106);
BENCHMARK(factor<DoubleDouble>)->Name("cholesky/31-digits")->Arg(60)->Arg(500);
BENCHMARK(step<double>)->Name("factor-and-step/double")->Arg(15)->Arg(60)->Arg(250);

}  // namespace
}  // namespace gainsmith::sdp

BENCHMARK_MAIN();
