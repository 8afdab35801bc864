#include "ode/chebyshev.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace gainsmith::ode::chebyshev {

using Eigen::Index;
using Eigen::VectorXd;
using numbers::Matrix;

namespace {

struct Transform {
  VectorXd points;
  Matrix matrix;  ///< values * matrix = coefficients
};

/// c_j = (2/n) sum'' f_k cos(j theta_k), theta_k = pi (n - k)/n; halves at both ends of k and j.
Transform make_transform(int degree) {
  const Index n = degree;
  Transform made{VectorXd::Ones(n + 1), Matrix::Ones(n + 1, n + 1)};
  if (n == 0) return made;
  const auto size = static_cast<double>(n);
  const auto half_at_end = [&](Index k) { return k == 0 || k == n ? 0.5 : 1.0; };
  for (Index k = 0; k <= n; ++k) {
    made.points(k) = std::sin(std::numbers::pi * static_cast<double>(2 * k - n) / (2 * size));
    for (Index j = 0; j <= n; ++j) {
      const Index turns = (j * (n - k)) % (2 * n);
      const double wave = std::cos(std::numbers::pi * static_cast<double>(turns) / size);
      made.matrix(k, j) = 2 / size * half_at_end(k) * half_at_end(j) * wave;
    }
  }
  return made;
}

const Transform& transform(Index degree) {
  static const std::vector<Transform> all = [] {
    std::vector<Transform> made;
    for (int n = 0; n <= largest_degree; ++n) made.push_back(make_transform(n));
    return made;
  }();
  if (degree < 0 || degree > largest_degree) throw std::logic_error("a series of that degree");
  return all[static_cast<std::size_t>(degree)];
}

}  // namespace

const VectorXd& points(int degree) { return transform(degree).points; }

Matrix coefficients(const Matrix& values) {
  return values.lazyProduct(transform(values.cols() - 1).matrix);
}

namespace {

/// sum_k c_k w_k of `rows` functions whose coefficients of one k are adjacent, those of the next
/// `stride` apart: no operation waits for the one before.
template <int rows>
void combine(const double* c, Index stride, const double* weights, std::size_t terms, double* out) {
  std::array<double, rows> sum{};
  for (std::size_t k = 0; k < terms; ++k, c += stride)
    for (std::size_t r = 0; r < rows; ++r) sum[r] += weights[k] * c[r];
  std::copy(sum.begin(), sum.end(), out);
}

}  // namespace

void at(const Matrix& coefficients, double x, double* out) {
  const Index rows = coefficients.rows();
  const auto terms = static_cast<std::size_t>(coefficients.cols());
  std::array<double, largest_degree + 1> usual;
  std::vector<double> more(terms > usual.size() ? terms : 0);
  double* const weights = more.empty() ? usual.data() : more.data();  // T_k(x)
  weights[0] = 1;
  if (terms > 1) weights[1] = x;
  for (std::size_t k = 2; k < terms; ++k) weights[k] = 2 * x * weights[k - 1] - weights[k - 2];
  const double* const c = coefficients.data();
  Index row = 0;
  for (; row + 32 <= rows; row += 32) combine<32>(c + row, rows, weights, terms, out + row);
  for (; row + 8 <= rows; row += 8) combine<8>(c + row, rows, weights, terms, out + row);
  for (; row + 2 <= rows; row += 2) combine<2>(c + row, rows, weights, terms, out + row);
  if (row < rows) combine<1>(c + row, rows, weights, terms, out + row);
}

VectorXd at(const Matrix& coefficients, double x) {
  VectorXd result(coefficients.rows());
  at(coefficients, x, result.data());
  return result;
}

numbers::Box ranges(const Matrix& coefficients) {
  VectorXd swing = VectorXd::Zero(coefficients.rows());
  for (Index k = 1; k < coefficients.cols(); ++k) swing += coefficients.col(k).cwiseAbs();
  // T_k by recurrence err by k^2 units at most.
  const auto terms = static_cast<double>(coefficients.cols() * coefficients.cols());
  const double unit = 4 * terms * std::numeric_limits<double>::epsilon();
  numbers::Box box;
  box.reserve(static_cast<std::size_t>(swing.size()));
  for (Index k = 0; k < swing.size(); ++k) {
    const double first = coefficients(k, 0);
    const double radius = swing(k) > 0 ? swing(k) + unit * (std::abs(first) + swing(k)) : 0;
    box.push_back({first - radius, first + radius});
  }
  return box;
}

Matrix part(const Matrix& coefficients, double from, double to) {
  const VectorXd& inside = points(static_cast<int>(coefficients.cols()) - 1);
  Matrix values(coefficients.rows(), coefficients.cols());
  for (Index k = 0; k < inside.size(); ++k)
    values.col(k) = at(coefficients, outer(inside(k), from, to));
  return chebyshev::coefficients(values);
}

Matrix trimmed(const Matrix& coefficients, double least) {
  Index last = coefficients.cols() - 1;
  while (last > 0 && (coefficients.col(last).cwiseAbs().array() <= least).all()) --last;
  return coefficients.leftCols(last + 1);
}

/// d_{k-1} = d_{k+1} + 2 k c_k, d_0 halved.
Matrix derivative(const Matrix& coefficients) {
  const Index degree = coefficients.cols() - 1;
  if (degree == 0) return Matrix::Zero(coefficients.rows(), 1);
  Matrix result = Matrix::Zero(coefficients.rows(), degree);
  for (Index k = degree; k > 0; --k) {
    result.col(k - 1) = 2 * static_cast<double>(k) * coefficients.col(k);
    if (k + 1 < degree) result.col(k - 1) += result.col(k + 1);
  }
  result.col(0) /= 2;
  return result;
}

}  // namespace gainsmith::ode::chebyshev
