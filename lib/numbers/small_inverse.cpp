#include "numbers/small_inverse.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace gainsmith::numbers {

namespace {

constexpr Eigen::Index kLargest = 8;
/// Where inverse() tries other units: twice the root of epsilon.
constexpr double kPlainCondition = 0x1p-25;

using Square = std::array<std::array<double, kLargest>, kLargest>;
using Units = std::array<double, kLargest>;

/// Powers of two d with d_i^2 M_ii from 1 to 4, of a symmetric M with a diagonal > 0; otherwise 1.
Units units_of(const Matrix& M) {
  Units units{};
  units.fill(1);
  for (Eigen::Index i = 0; i < M.rows(); ++i) {
    if (!(M(i, i) > 0) || !std::isfinite(M(i, i))) return units;
    for (Eigen::Index j = 0; j < i; ++j)
      if (M(i, j) != M(j, i)) return units;
  }
  for (Eigen::Index i = 0; i < M.rows(); ++i)
    units[static_cast<std::size_t>(i)] =
        std::ldexp(1.0, -static_cast<int>(std::floor(std::ilogb(M(i, i)) / 2.0)));
  return units;
}

double one_norm(const Square& A, std::size_t n) {
  double norm = 0;
  for (std::size_t j = 0; j < n; ++j) {
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) sum += std::abs(A[i][j]);
    norm = std::max(norm, sum);
  }
  return norm;
}

/// A X = B by Gauss with pivots in the columns; A is overwritten, B becomes X. False: a pivot is 0.
bool solve(Square& A, Square& B, std::size_t n) {
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(A[i][k]) > std::abs(A[pivot][k])) pivot = i;
    if (!(std::abs(A[pivot][k]) > 0)) return false;
    std::swap(A[k], A[pivot]);
    std::swap(B[k], B[pivot]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = A[i][k] / A[k][k];
      if (factor == 0) continue;
      for (std::size_t j = k + 1; j < n; ++j) A[i][j] -= factor * A[k][j];
      for (std::size_t j = 0; j < n; ++j) B[i][j] -= factor * B[k][j];
    }
  }
  for (std::size_t k = n; k-- > 0;)
    for (std::size_t j = 0; j < n; ++j) {
      double sum = B[k][j];
      for (std::size_t i = k + 1; i < n; ++i) sum -= A[k][i] * B[i][j];
      B[k][j] = sum / A[k][k];
    }
  return true;
}

}  // namespace

bool small_inverse(const Matrix& M, double* out) {
  if (M.rows() > kLargest) return false;
  const auto n = static_cast<std::size_t>(M.rows());
  const Units d = units_of(M);
  Square A{};
  Square X{};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j)
      A[i][j] = d[i] * M(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) * d[j];
    X[i][i] = 1;
  }
  const double norm = one_norm(A, n);
  if (!solve(A, X, n) || !(norm * one_norm(X, n) < 1 / kPlainCondition)) return false;
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i) *out++ = d[i] * X[i][j] * d[j];
  return true;
}

}  // namespace gainsmith::numbers
