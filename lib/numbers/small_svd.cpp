#include "numbers/small_svd.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

namespace gainsmith::numbers {

namespace {

constexpr Eigen::Index kLargest = 8;
constexpr int kMostSweeps = 30;
/// Columns count as orthogonal up to this cosine: the rounding of a product of 8 rows.
constexpr double kOrthogonal = 8 * std::numeric_limits<double>::epsilon();
/// Of elements up to 2: one moves no eigenvalue by more than rounding when it, or its square over
/// the gap of its two diagonal elements, is not above this.
constexpr double kNothing = 0x1p-54;

using Column = std::array<double, kLargest>;

double product(const Column& a, const Column& b, std::size_t rows) {
  double sum = 0;
  for (std::size_t i = 0; i < rows; ++i) sum += a[i] * b[i];
  return sum;
}

/// Makes two columns orthogonal; false: they are.
bool rotate(Column& a, Column& b, std::size_t rows) {
  const double aa = product(a, a, rows);
  const double bb = product(b, b, rows);
  const double ab = product(a, b, rows);
  if (!(ab * ab > kOrthogonal * kOrthogonal * aa * bb)) return false;
  const double zeta = (bb - aa) / (2 * ab);
  const double t = std::copysign(1 / (std::abs(zeta) + std::sqrt(1 + zeta * zeta)), zeta);
  const double c = 1 / std::sqrt(1 + t * t);
  const double s = c * t;
  for (std::size_t i = 0; i < rows; ++i) {
    const double x = a[i];
    a[i] = c * x - s * b[i];
    b[i] = s * x + c * b[i];
  }
  return true;
}

using Square = std::array<Column, kLargest>;

bool is_symmetric(const Matrix& M) {
  if (M.rows() != M.cols()) return false;
  for (Eigen::Index j = 0; j < M.cols(); ++j)
    for (Eigen::Index i = 0; i < j; ++i)
      if (M(i, j) != M(j, i)) return false;
  return true;
}

/// Makes element (p, q) of a symmetric A zero.
void rotate(Square& A, std::size_t p, std::size_t q, std::size_t n) {
  const double apq = A[p][q];
  const double theta = (A[q][q] - A[p][p]) / (2 * apq);
  const double t = std::copysign(1 / (std::abs(theta) + std::sqrt(1 + theta * theta)), theta);
  const double c = 1 / std::sqrt(1 + t * t);
  const double s = c * t;
  A[p][p] -= t * apq;
  A[q][q] += t * apq;
  A[p][q] = A[q][p] = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (i == p || i == q) continue;
    const double x = A[p][i];
    A[p][i] = A[i][p] = c * x - s * A[q][i];
    A[q][i] = A[i][q] = s * x + c * A[q][i];
  }
}

/// The eigenvalues of a symmetric A are left on its diagonal; false: after many sweeps they are not.
bool diagonalize(Square& A, std::size_t n) {
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    bool rotated = false;
    for (std::size_t p = 0; p < n; ++p)
      for (std::size_t q = p + 1; q < n; ++q) {
        const double gap = std::abs(A[p][p] - A[q][q]);
        if (!(A[p][q] * A[p][q] > kNothing * std::max(gap, kNothing))) continue;
        rotate(A, p, q, n);
        rotated = true;
      }
    if (!rotated) return true;
  }
  return false;
}

/// Rotates columns until they are orthogonal; false: after many sweeps they are not.
bool make_orthogonal(Square& columns, std::size_t rows, std::size_t count) {
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    bool rotated = false;
    for (std::size_t p = 0; p < count; ++p)
      for (std::size_t q = p + 1; q < count; ++q)
        rotated = rotate(columns[p], columns[q], rows) || rotated;
    if (!rotated) return true;
  }
  return false;
}

}  // namespace

bool small_singular_values(const Matrix& M, double* out) {
  if (M.rows() > kLargest || M.cols() > kLargest || M.size() == 0 || !M.allFinite()) return false;
  const double largest = M.cwiseAbs().maxCoeff();
  const bool turned = M.cols() > M.rows();
  const auto rows = static_cast<std::size_t>(turned ? M.cols() : M.rows());
  const auto count = static_cast<std::size_t>(turned ? M.rows() : M.cols());
  const int unit = largest > 0 ? std::ilogb(largest) : 0;
  // Two factors, since one may overflow.
  const double half = std::ldexp(1.0, -unit / 2);
  const double rest = std::ldexp(1.0, -unit - -unit / 2);
  Square A{};
  for (std::size_t j = 0; j < count; ++j)
    for (std::size_t i = 0; i < rows; ++i) {
      const auto row = static_cast<Eigen::Index>(turned ? j : i);
      const auto column = static_cast<Eigen::Index>(turned ? i : j);
      A[j][i] = M(row, column) * half * rest;
    }
  const bool symmetric = is_symmetric(M);
  if (!(symmetric ? diagonalize(A, count) : make_orthogonal(A, rows, count))) return false;
  for (std::size_t j = 0; j < count; ++j) {
    const double value = symmetric ? std::abs(A[j][j]) : std::sqrt(product(A[j], A[j], rows));
    out[j] = value / half / rest;
  }
  std::sort(out, out + count, std::greater<>());
  return true;
}

}  // namespace gainsmith::numbers
