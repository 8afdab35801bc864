#include "sdp/core/report.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "base/scalars.h"
#include "sdp/core/data.h"
#include "sdp/schur/kernels.h"

namespace gainsmith::sdp {
namespace {

template <typename T>
using Packed = std::vector<std::vector<T>>;

/// Where (row, column) of a block is in the packing of BlockMatrix.
std::size_t place(const Block& block, int row, int column) {
  return static_cast<std::size_t>(block.diagonal ? row : row + block.size * column);
}

const Block& block_of(const Problem& problem, const Entry& e) {
  return problem.blocks[static_cast<std::size_t>(e.block)];
}

/// F . S
template <typename T>
T inner(const Problem& problem, const std::vector<Entry>& f, const Packed<T>& s) {
  T sum(0);
  for (const Entry& e : f) {
    const T& value =
        s[static_cast<std::size_t>(e.block)][place(block_of(problem, e), e.row, e.column)];
    sum += value * coefficient<T>(problem, e) * static_cast<double>(e.row == e.column ? 1 : 2);
  }
  return sum;
}

/// sum_i x_i F_i - tau F_0
template <typename T>
Packed<T> combine(const Problem& problem, const std::vector<T>& x, double tau) {
  Packed<T> result;
  for (const Block& block : problem.blocks) {
    const auto n = static_cast<std::size_t>(block.size);
    result.emplace_back(block.diagonal ? n : n * n, T(0));
  }
  for (std::size_t i = 0; i < problem.f.size(); ++i) {
    const T factor = i == 0 ? T(-tau) : x[i - 1];
    for (const Entry& e : problem.f[i]) {
      const Block& block = block_of(problem, e);
      auto& values = result[static_cast<std::size_t>(e.block)];
      const T product = factor * coefficient<T>(problem, e);
      values[place(block, e.row, e.column)] += product;
      if (e.row != e.column) values[place(block, e.column, e.row)] += product;
    }
  }
  return result;
}

/// lambda_min over all blocks, by an eigensolver in double.
double rounded_eigenvalue(const Problem& problem, const Packed<double>& matrix) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    const Block& block = problem.blocks[b];
    const auto& values = matrix[b];
    if (block.diagonal) {
      smallest = std::min(smallest, *std::min_element(values.begin(), values.end()));
    } else {
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
          ConstMatrixMap<double>(values.data(), block.size, block.size), Eigen::EigenvaluesOnly);
      smallest = std::min(smallest, solver.eigenvalues()[0]);
    }
  }
  return smallest;
}

/// Does matrix + shift I have a Cholesky factor in T (nonnegative entries, in a diagonal block)?
/// Rows that are zero throughout are left out: they take nothing from semidefiniteness.
template <typename T>
bool positive(const Problem& problem, const Packed<T>& matrix, double shift) {
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    const Block& block = problem.blocks[b];
    const auto& values = matrix[b];
    if (block.diagonal) {
      for (const T& v : values)
        if (v < T(-shift)) return false;
      continue;
    }
    const ConstMatrixMap<T> map(values.data(), block.size, block.size);
    Matrix<T> copy = map;
    for (Eigen::Index i = 0; i < copy.rows(); ++i) {
      copy(i, i) += T(shift);
      if (map.col(i).cwiseEqual(T(0)).all()) copy(i, i) = T(1);
    }
    if (!cholesky(View<T>(copy))) return false;
  }
  return true;
}

/// max(0, -lambda_min), rounded up to a power of two: the least shift that makes the matrix
/// positive, between powers of 16 first.
template <typename T>
double negative_part(const Problem& problem, const Packed<T>& matrix) {
  if (positive(problem, matrix, 0)) return 0;
  constexpr int kLeast = -1020, kMost = 1020;
  int power = kLeast;
  while (power < kMost && !positive(problem, matrix, std::ldexp(1.0, power))) power += 4;
  int least = std::max(kLeast, power - 3);
  while (least < power && !positive(problem, matrix, std::ldexp(1.0, least))) ++least;
  return std::ldexp(1.0, least);
}

/// lambda_min: in double where the matrix is positive (never below 0 then), else a lower bound in
/// T.
template <typename T>
double smallest_eigenvalue(const Problem& problem, const Packed<T>& matrix) {
  const double negative = negative_part(problem, matrix);
  if (negative > 0) return -negative;
  Packed<double> rounded;
  for (const auto& block : matrix) {
    auto& values = rounded.emplace_back();
    for (const T& v : block) values.push_back(static_cast<double>(v));
  }
  return std::max(0.0, rounded_eigenvalue(problem, rounded));
}

template <typename T>
T dot(const Packed<T>& a, const Packed<T>& b) {
  T sum(0);
  for (std::size_t k = 0; k < a.size(); ++k)
    for (std::size_t i = 0; i < a[k].size(); ++i) sum += a[k][i] * b[k][i];
  return sum;
}

/// c_i in T.
template <typename T>
T cost(const Problem& problem, std::size_t i) {
  return coefficient<T>(problem.c[i], problem.c_rest.empty() ? 0 : problem.c_rest[i]);
}

/// c'x
template <typename T>
T objective(const Problem& problem, const std::vector<T>& x) {
  T sum(0);
  for (std::size_t i = 0; i < x.size(); ++i) sum += x[i] * cost<T>(problem, i);
  return sum;
}

/// The doubles of numbers, and what rounding left of them (none in double).
template <typename T>
void split(const std::vector<T>& from, std::vector<double>& value, std::vector<double>& rest) {
  for (const T& v : from) {
    value.push_back(static_cast<double>(v));
    if constexpr (!std::is_same_v<T, double>) rest.push_back(as<DoubleDouble>(v).lo());
  }
}

template <typename T>
void split(const Packed<T>& from, BlockMatrix& value, BlockMatrix& rest) {
  for (const auto& block : from) {
    std::vector<double> low;
    split(block, value.values.emplace_back(), low);
    if constexpr (!std::is_same_v<T, double>) rest.values.push_back(std::move(low));
  }
}

}  // namespace

template <typename T>
std::vector<std::vector<T>> slack(const Problem& problem, const std::vector<T>& x) {
  return combine(problem, x, 1);
}

template <typename T>
bool in_cone(const Problem& problem, const std::vector<std::vector<T>>& matrix) {
  return positive(problem, matrix, 0);
}

template <typename T>
void measure(const Problem& problem, const Point<T>& point, Solution& solution) {
  const T primal = objective(problem, point.x);
  const T dual = inner(problem, problem.f[0], point.Y);
  solution.primal_objective = static_cast<double>(primal);
  solution.dual_objective = static_cast<double>(dual);
  const double size = 1 + std::abs(solution.primal_objective) + std::abs(solution.dual_objective);
  double largest_c = 0, largest_f0 = 0;
  for (const double c : problem.c) largest_c = std::max(largest_c, std::abs(c));
  for (const Entry& e : problem.f[0]) largest_f0 = std::max(largest_f0, std::abs(e.value));

  double dual_square = 0, primal_square = 0;
  for (std::size_t i = 0; i < problem.c.size(); ++i) {
    const double r =
        static_cast<double>(T(inner(problem, problem.f[i + 1], point.Y) - cost<T>(problem, i)));
    dual_square += r * r;
  }
  const Packed<T> combined = combine(problem, point.x, 1);
  for (std::size_t b = 0; b < combined.size(); ++b)
    for (std::size_t i = 0; i < combined[b].size(); ++i) {
      const double r = static_cast<double>(T(combined[b][i] - point.X[b][i]));
      primal_square += r * r;
    }

  solution.relative_gap = static_cast<double>(T(primal - dual)) / size;
  solution.dimacs = {std::sqrt(dual_square) / (1 + largest_c),
                     negative_part(problem, point.Y) / (1 + largest_c),
                     std::sqrt(primal_square) / (1 + largest_f0),
                     negative_part(problem, point.X) / (1 + largest_f0),
                     solution.relative_gap,
                     static_cast<double>(dot(point.X, point.Y)) / size};
}

template <typename T>
void store(const Point<T>& point, Solution& solution) {
  split(point.x, solution.x, solution.rest.x);
  split(point.X, solution.X, solution.rest.X);
  split(point.Y, solution.Y, solution.rest.Y);
  if constexpr (std::is_same_v<T, Decimal100>)
    for (const auto& block : point.Y) {
      auto& finer = solution.rest.finer_Y.emplace_back();
      for (const T& v : block) finer.push_back(finer_part(v));
    }
}

template <typename T>
Certificate check_primal_infeasible(const Problem& problem, Point<T>& point, double tolerance) {
  Certificate certificate;
  const T value = inner(problem, problem.f[0], point.Y);
  if (!(value > T(0))) return certificate;
  for (auto& block : point.Y)
    for (T& v : block) v /= value;
  T residual(0);
  for (std::size_t i = 1; i < problem.f.size(); ++i)
    residual += std::abs(static_cast<double>(inner(problem, problem.f[i], point.Y)));
  certificate.value = static_cast<double>(inner(problem, problem.f[0], point.Y));
  certificate.residual = static_cast<double>(residual);
  certificate.excluded_radius = 1 / certificate.residual;
  certificate.min_eigenvalue = smallest_eigenvalue(problem, point.Y);
  certificate.checked = certificate.residual <= tolerance && certificate.min_eigenvalue >= 0;
  return certificate;
}

template <typename T>
Certificate check_dual_infeasible(const Problem& problem, Point<T>& point, double tolerance) {
  Certificate certificate;
  const T value = -objective(problem, point.x);
  if (!(value > T(0))) return certificate;
  for (T& v : point.x) v /= value;
  certificate.value = static_cast<double>(T(-objective(problem, point.x)));
  certificate.min_eigenvalue = smallest_eigenvalue(problem, combine(problem, point.x, 0));
  certificate.residual = std::max(0.0, -certificate.min_eigenvalue);
  certificate.excluded_radius = 1 / certificate.residual;
  certificate.checked = certificate.residual <= tolerance;
  return certificate;
}

#define GAINSMITH_INSTANTIATE(T)                                                      \
  template Packed<T> slack<T>(const Problem&, const std::vector<T>&);                 \
  template bool in_cone<T>(const Problem&, const Packed<T>&);                         \
  template void measure<T>(const Problem&, const Point<T>&, Solution&);               \
  template void store<T>(const Point<T>&, Solution&);                                 \
  template Certificate check_primal_infeasible<T>(const Problem&, Point<T>&, double); \
  template Certificate check_dual_infeasible<T>(const Problem&, Point<T>&, double);
GAINSMITH_FOR_EACH_SCALAR(GAINSMITH_INSTANTIATE)
#undef GAINSMITH_INSTANTIATE

}  // namespace gainsmith::sdp
