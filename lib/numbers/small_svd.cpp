#include "numbers/small_svd.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace gainsmith::numbers {

namespace {

constexpr Eigen::Index kLargest = 8;
constexpr int kMostSweeps = 30;
/// Columns count as orthogonal up to this cosine: the rounding of a product of 8 rows.
constexpr double kOrthogonal = 8 * std::numeric_limits<double>::epsilon();
/// Of elements up to 2: one moves no eigenvalue by more than rounding when it, or its square over
/// the gap of its two diagonal elements, is not above this.
constexpr double kNothing = 0x1p-54;

/// A column of M and, below it, one of the rotations so far.
using Column = std::array<double, 2 * kLargest>;

double product(const Column& a, const Column& b, std::size_t rows) {
  double sum = 0;
  for (std::size_t i = 0; i < rows; ++i) sum += a[i] * b[i];
  return sum;
}

/// Makes the first `rows` elements of two columns of `height` elements orthogonal; false: they are.
bool rotate(Column& a, Column& b, std::size_t rows, std::size_t height) {
  const double aa = product(a, a, rows);
  const double bb = product(b, b, rows);
  const double ab = product(a, b, rows);
  if (!(ab * ab > kOrthogonal * kOrthogonal * aa * bb)) return false;
  const double zeta = (bb - aa) / (2 * ab);
  const double t = std::copysign(1 / (std::abs(zeta) + std::sqrt(1 + zeta * zeta)), zeta);
  const double c = 1 / std::sqrt(1 + t * t);
  const double s = c * t;
  for (std::size_t i = 0; i < height; ++i) {
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
bool make_orthogonal(Square& columns, std::size_t rows, std::size_t height, std::size_t count) {
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    bool rotated = false;
    for (std::size_t p = 0; p < count; ++p)
      for (std::size_t q = p + 1; q < count; ++q)
        rotated = rotate(columns[p], columns[q], rows, height) || rotated;
    if (!rotated) return true;
  }
  return false;
}

/// M, or its transpose if that is taller, column by column and scaled by a power of 2.
struct Scaled {
  Square columns{};
  std::size_t rows, count;
  bool turned;
  double half, rest;  ///< the factor: two, since one may overflow

  explicit Scaled(const Matrix& M)
      : rows(static_cast<std::size_t>(std::max(M.rows(), M.cols()))),
        count(static_cast<std::size_t>(std::min(M.rows(), M.cols()))),
        turned(M.cols() > M.rows()) {
    const double largest = M.cwiseAbs().maxCoeff();
    const int unit = largest > 0 ? std::ilogb(largest) : 0;
    half = std::ldexp(1.0, -unit / 2);
    rest = std::ldexp(1.0, -unit - -unit / 2);
    for (std::size_t j = 0; j < count; ++j)
      for (std::size_t i = 0; i < rows; ++i) columns[j][i] = of(M, i, j) * half * rest;
  }
  double of(const Matrix& M, std::size_t i, std::size_t j) const {
    return M(static_cast<Eigen::Index>(turned ? j : i), static_cast<Eigen::Index>(turned ? i : j));
  }
};

bool is_small(const Matrix& M) {
  return M.rows() <= kLargest && M.cols() <= kLargest && M.size() > 0 && M.allFinite();
}

}  // namespace

bool small_singular_values(const Matrix& M, double* out) {
  if (!is_small(M)) return false;
  Scaled A(M);
  const bool symmetric = is_symmetric(M);
  if (!(symmetric ? diagonalize(A.columns, A.count)
                  : make_orthogonal(A.columns, A.rows, A.rows, A.count)))
    return false;
  for (std::size_t j = 0; j < A.count; ++j) {
    const Column& column = A.columns[j];
    const double value =
        symmetric ? std::abs(column[j]) : std::sqrt(product(column, column, A.rows));
    out[j] = value / A.half / A.rest;
  }
  std::sort(out, out + A.count, std::greater<>());
  return true;
}

bool small_singular_slopes(const Matrix& M, const Matrix& dM, double* out) {
  if (!is_small(M)) return false;
  Scaled A(M);
  for (std::size_t j = 0; j < A.count; ++j) A.columns[j][A.rows + j] = 1;
  if (!make_orthogonal(A.columns, A.rows, A.rows + A.count, A.count)) return false;
  std::array<std::pair<double, double>, kLargest> values{};
  for (std::size_t k = 0; k < A.count; ++k) {
    const Column& column = A.columns[k];
    double sum = 0;
    for (std::size_t j = 0; j < A.count; ++j)
      for (std::size_t i = 0; i < A.rows; ++i)
        sum += column[i] * A.of(dM, i, j) * column[A.rows + j];
    const double length = std::sqrt(product(column, column, A.rows));
    values[k] = {length, length > 0 ? sum / length : 0};
  }
  std::stable_sort(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(A.count),
                   [](const auto& one, const auto& other) { return one.first > other.first; });
  for (std::size_t k = 0; k < A.count; ++k) out[k] = values[k].second;
  return true;
}

}  // namespace gainsmith::numbers
