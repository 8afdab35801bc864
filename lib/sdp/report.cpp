#include "sdp/report.h"

#include <Eigen/Cholesky>
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace gainsmith::sdp {
namespace {

using Map = Eigen::Map<const Eigen::MatrixXd>;

double& at(const Problem& problem, BlockMatrix& matrix, int block, int row, int column) {
  const Block& shape = problem.blocks[static_cast<std::size_t>(block)];
  const int place = shape.diagonal ? row : row + shape.size * column;
  return matrix.values[static_cast<std::size_t>(block)][static_cast<std::size_t>(place)];
}

/// F . S
double inner(const Problem& problem, const std::vector<Entry>& f, const BlockMatrix& s) {
  double sum = 0;
  for (const Entry& e : f) {
    const Block& shape = problem.blocks[static_cast<std::size_t>(e.block)];
    const int place = shape.diagonal ? e.row : e.row + shape.size * e.column;
    const double value =
        s.values[static_cast<std::size_t>(e.block)][static_cast<std::size_t>(place)];
    sum += (e.row == e.column ? 1 : 2) * e.value * value;
  }
  return sum;
}

/// sum_i x_i F_i - tau F_0
BlockMatrix combine(const Problem& problem, const std::vector<double>& x, double tau) {
  BlockMatrix result;
  for (const Block& block : problem.blocks) {
    const auto n = static_cast<std::size_t>(block.size);
    result.values.emplace_back(block.diagonal ? n : n * n, 0.0);
  }
  for (std::size_t i = 0; i < problem.f.size(); ++i) {
    const double factor = i == 0 ? -tau : x[i - 1];
    if (factor == 0) continue;
    for (const Entry& e : problem.f[i]) {
      at(problem, result, e.block, e.row, e.column) += factor * e.value;
      if (e.row != e.column) at(problem, result, e.block, e.column, e.row) += factor * e.value;
    }
  }
  return result;
}

double smallest_eigenvalue(const Problem& problem, const BlockMatrix& matrix) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    const Block& block = problem.blocks[b];
    const auto& values = matrix.values[b];
    if (block.diagonal) {
      smallest = std::min(smallest, *std::min_element(values.begin(), values.end()));
    } else {
      const Map map(values.data(), block.size, block.size);
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(map, Eigen::EigenvaluesOnly);
      smallest = std::min(smallest, solver.eigenvalues()[0]);
    }
  }
  return smallest;
}

bool positive_definite(const Problem& problem, const BlockMatrix& matrix) {
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    const Block& block = problem.blocks[b];
    const auto& values = matrix.values[b];
    if (block.diagonal) {
      for (const double v : values)
        if (!(v >= 0)) return false;
    } else {
      const Eigen::LLT<Eigen::MatrixXd> llt(Map(values.data(), block.size, block.size));
      if (llt.info() != Eigen::Success) return false;
    }
  }
  return true;
}

/// max(0, -lambda_min), without eigenvalues where a Cholesky factor shows that it is 0.
double negative_part(const Problem& problem, const BlockMatrix& matrix) {
  if (positive_definite(problem, matrix)) return 0;
  return std::max(0.0, -smallest_eigenvalue(problem, matrix));
}

double dot(const BlockMatrix& a, const BlockMatrix& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.values.size(); ++k)
    for (std::size_t i = 0; i < a.values[k].size(); ++i) sum += a.values[k][i] * b.values[k][i];
  return sum;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

void measure(const Problem& problem, const Point& point, Solution& solution) {
  const double primal = dot(problem.c, point.x);
  const double dual = inner(problem, problem.f[0], point.Y);
  const double size = 1 + std::abs(primal) + std::abs(dual);
  double largest_c = 0, largest_f0 = 0, dual_square = 0, primal_square = 0;
  for (const double c : problem.c) largest_c = std::max(largest_c, std::abs(c));
  for (const Entry& e : problem.f[0]) largest_f0 = std::max(largest_f0, std::abs(e.value));
  for (std::size_t i = 0; i < problem.c.size(); ++i) {
    const double r = inner(problem, problem.f[i + 1], point.Y) - problem.c[i];
    dual_square += r * r;
  }
  const BlockMatrix combined = combine(problem, point.x, 1);
  for (std::size_t b = 0; b < combined.values.size(); ++b)
    for (std::size_t i = 0; i < combined.values[b].size(); ++i) {
      const double r = combined.values[b][i] - point.X.values[b][i];
      primal_square += r * r;
    }

  solution.primal_objective = primal;
  solution.dual_objective = dual;
  solution.relative_gap = (primal - dual) / size;
  solution.dimacs = {std::sqrt(dual_square) / (1 + largest_c),
                     negative_part(problem, point.Y) / (1 + largest_c),
                     std::sqrt(primal_square) / (1 + largest_f0),
                     negative_part(problem, point.X) / (1 + largest_f0),
                     solution.relative_gap,
                     dot(point.X, point.Y) / size};
}

Certificate check_primal_infeasible(const Problem& problem, Point& point, double tolerance) {
  Certificate certificate;
  const double value = inner(problem, problem.f[0], point.Y);
  if (!(value > 0)) return certificate;
  for (auto& block : point.Y.values)
    for (double& v : block) v /= value;
  for (std::size_t i = 1; i < problem.f.size(); ++i)
    certificate.residual += std::abs(inner(problem, problem.f[i], point.Y));
  certificate.value = inner(problem, problem.f[0], point.Y);
  certificate.min_eigenvalue = smallest_eigenvalue(problem, point.Y);
  certificate.excluded_radius = 1 / certificate.residual;
  certificate.checked = certificate.residual <= tolerance &&
                        (certificate.min_eigenvalue >= 0 || positive_definite(problem, point.Y));
  return certificate;
}

Certificate check_dual_infeasible(const Problem& problem, Point& point, double tolerance) {
  Certificate certificate;
  const double value = -dot(problem.c, point.x);
  if (!(value > 0)) return certificate;
  for (double& v : point.x) v /= value;
  const BlockMatrix combined = combine(problem, point.x, 0);
  certificate.value = -dot(problem.c, point.x);
  certificate.min_eigenvalue = smallest_eigenvalue(problem, combined);
  certificate.residual = std::max(0.0, -certificate.min_eigenvalue);
  certificate.excluded_radius = 1 / certificate.residual;
  certificate.checked = certificate.residual <= tolerance;
  return certificate;
}

}  // namespace gainsmith::sdp
