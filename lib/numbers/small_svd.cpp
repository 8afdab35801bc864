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

}  // namespace

bool small_singular_values(const Matrix& M, double* out) {
  if (M.rows() > kLargest || M.cols() > kLargest || M.size() == 0) return false;
  const double largest = M.cwiseAbs().maxCoeff();
  if (!std::isfinite(largest) || !M.allFinite()) return false;
  const bool turned = M.cols() > M.rows();
  const auto rows = static_cast<std::size_t>(turned ? M.cols() : M.rows());
  const auto cols = static_cast<std::size_t>(turned ? M.rows() : M.cols());
  const int unit = largest > 0 ? std::ilogb(largest) : 0;
  std::array<Column, kLargest> columns{};
  for (std::size_t j = 0; j < cols; ++j)
    for (std::size_t i = 0; i < rows; ++i) {
      const auto row = static_cast<Eigen::Index>(turned ? j : i);
      const auto column = static_cast<Eigen::Index>(turned ? i : j);
      columns[j][i] = std::ldexp(M(row, column), -unit);
    }
  bool rotated = true;
  for (int sweep = 0; rotated; ++sweep) {
    if (sweep == kMostSweeps) return false;
    rotated = false;
    for (std::size_t p = 0; p < cols; ++p)
      for (std::size_t q = p + 1; q < cols; ++q)
        rotated = rotate(columns[p], columns[q], rows) || rotated;
  }
  for (std::size_t j = 0; j < cols; ++j)
    out[j] = std::ldexp(std::sqrt(product(columns[j], columns[j], rows)), unit);
  std::sort(out, out + cols, std::greater<>());
  return true;
}

}  // namespace gainsmith::numbers
