#include "numerics/balance.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace gainsmith::numerics {

namespace {

using Eigen::Index;
using Graph = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>;

constexpr int kMostExponent = 1000;  ///< of one state against another

/// The whole number below y, in the range of exponents.
int exponent_below(double y) {
  return static_cast<int>(std::clamp(std::floor(y), -1.0 * kMostExponent, 1.0 * kMostExponent));
}

/// Whether a path leads from i to j: the row of i holds what i is made of.
Graph reachable(const Matrix& sizes) {
  Graph reach = sizes.array() != 0;
  for (Index k = 0; k < sizes.rows(); ++k)
    for (Index i = 0; i < sizes.rows(); ++i)
      if (reach(i, k)) reach.row(i) = reach.row(i) || reach.row(k);
  for (Index k = 0; k < sizes.rows(); ++k) reach(k, k) = true;
  return reach;
}

// Halves are common in integer data: they all have to round in the same direction.
constexpr double kPastHalf = 0.5 + 0.0137;

/// The x that minimises sum (log2 |A_ij| + x_j - x_i)^2, with x = 0 for the first `fixed` states
/// and the first of each other connected part. The normal equations have the Laplacian of the graph
/// as their matrix: Gaussian elimination from the last state to the first.
Vector least_squares(const Matrix& sizes, Index fixed = 0) {
  const Index n = sizes.rows();
  Matrix normal = Matrix::Zero(n, n);
  Vector right = Vector::Zero(n);
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i) {
      if (i == j || sizes(i, j) == 0) continue;
      const double log = std::log2(sizes(i, j));
      normal(i, i) += 1;
      normal(j, j) += 1;
      normal(i, j) -= 1;
      normal(j, i) -= 1;
      right(i) += log;
      right(j) -= log;
    }
  // A state that nothing earlier is left to connect with is the first of its part.
  std::vector<bool> first(static_cast<std::size_t>(n), false);
  for (Index k = n - 1; k >= 0; --k) {
    if (k < fixed || (normal.row(k).head(k).array() == 0).all()) {
      first[static_cast<std::size_t>(k)] = true;
      continue;
    }
    for (Index i = 0; i < k; ++i) {
      const double factor = normal(i, k) / normal(k, k);
      if (factor == 0) continue;
      normal.row(i).head(k) -= factor * normal.row(k).head(k);
      right(i) -= factor * right(k);
    }
  }
  Vector x = Vector::Zero(n);
  for (Index k = 0; k < n; ++k)
    if (!first[static_cast<std::size_t>(k)])
      x(k) = (right(k) - normal.row(k).head(k).dot(x.head(k))) / normal(k, k);
  return x;
}

class Balance {
 public:
  explicit Balance(const Matrix& sizes)
      : n_(sizes.rows()),
        sizes_(sizes),
        reach_(reachable(sizes)),
        exponents_(static_cast<std::size_t>(n_), 0) {
    const Vector units = least_squares(sizes);
    for (Index i = 0; i < n_; ++i) multiply(i, exponent_below(units(i) + kPastHalf));
    balance_parts();
    shrink_couplings();
  }

  std::vector<int> exponents() const { return exponents_; }

 private:
  bool is_coupled(Index i, Index j) const { return reach_(i, j) && reach_(j, i); }

  /// The unit of state i is 2^exponent times what it was.
  void multiply(Index i, int exponent) {
    if (exponent == 0) return;
    exponents_[static_cast<std::size_t>(i)] += exponent;
    for (Index j = 0; j < n_; ++j) {
      if (j == i) continue;
      sizes_(j, i) = std::ldexp(sizes_(j, i), exponent);
      sizes_(i, j) = std::ldexp(sizes_(i, j), -exponent);
    }
  }

  /// Rows and columns of the strongly connected parts: with their sums r and c in the part, state i
  /// is multiplied by the power of two nearest to sqrt(r/c), where that makes r + c smaller by 5 %.
  void balance_parts() {
    constexpr int kMostSweeps = 100;
    for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
      bool done = true;
      for (Index i = 0; i < n_; ++i) {
        double column = 0, row = 0;
        for (Index j = 0; j < n_; ++j) {
          if (j == i || !is_coupled(i, j)) continue;
          column += sizes_(j, i);
          row += sizes_(i, j);
        }
        if (!(column > 0 && row > 0)) continue;
        const auto exponent = exponent_below(std::log2(row / column) / 2 + 0.5);
        const double better = std::ldexp(column, exponent) + std::ldexp(row, -exponent);
        if (exponent == 0 || !(better < 0.95 * (column + row))) continue;
        multiply(i, exponent);
        done = false;
      }
      if (done) return;
    }
  }

  /// Makes what leads from one part to another small, part by part, those first that depend on the
  /// most.
  void shrink_couplings() {
    double weight = 0;
    for (Index i = 0; i < n_; ++i) {
      double row = 0;
      for (Index j = 0; j < n_; ++j)
        if (is_coupled(i, j)) row += sizes_(i, j);
      weight = std::max(weight, row);
    }
    const double most = (weight > 0 ? weight : 1) / (2 * static_cast<double>(n_));
    std::vector<Index> order(static_cast<std::size_t>(n_));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
      return reach_.row(a).count() > reach_.row(b).count();
    });
    std::vector<bool> done(static_cast<std::size_t>(n_), false);
    for (const Index first : order) {
      if (done[static_cast<std::size_t>(first)]) continue;
      double largest = 0;
      for (Index j = 0; j < n_; ++j)
        if (is_coupled(first, j))
          for (Index i = 0; i < n_; ++i)
            if (!is_coupled(first, i)) largest = std::max(largest, sizes_(i, j));
      const int exponent = largest > most ? exponent_below(std::log2(most / largest)) : 0;
      for (Index j = 0; j < n_; ++j) {
        if (!is_coupled(first, j)) continue;
        done[static_cast<std::size_t>(j)] = true;
        multiply(j, exponent);
      }
    }
  }

  Index n_;
  Matrix sizes_;
  Graph reach_;
  std::vector<int> exponents_;
};

/// The exponents of least_squares() but for the first `skipped`; all zero where a size is not
/// finite.
std::vector<int> rounded_units(const Matrix& sizes, Index fixed, Index skipped) {
  std::vector<int> exponents;
  const Vector all = sizes.allFinite() ? least_squares(sizes, fixed) : Vector::Zero(sizes.rows());
  for (Index i = skipped; i < all.size(); ++i)
    exponents.push_back(exponent_below(all(i) + kPastHalf));
  return exponents;
}

}  // namespace

std::vector<int> units(const Matrix& A, const Matrix& C) {
  const Index n = A.rows(), p = C.rows();
  Matrix sizes = Matrix::Zero(p + n, p + n);
  sizes.topRightCorner(p, n) = C;
  sizes.bottomRightCorner(n, n) = A;
  return rounded_units(sizes, p, p);
}

Equilibrium equilibrium(const Matrix& M) {
  const Index n = M.rows();
  Matrix sizes = Matrix::Zero(2 * n, 2 * n);
  sizes.topRightCorner(n, n) = M;
  std::vector<int> rows = rounded_units(sizes, 0, 0);
  const std::vector<int> columns(rows.begin() + n, rows.end());
  rows.resize(static_cast<std::size_t>(n));
  return {rows, columns};
}

std::vector<int> balance(const Matrix& sizes) {
  const std::vector<int> none(static_cast<std::size_t>(sizes.rows()), 0);
  if (sizes.rows() < 2 || !sizes.allFinite()) return none;
  const auto exponents = Balance(sizes).exponents();
  const auto [least, most] = std::minmax_element(exponents.begin(), exponents.end());
  return *most - *least <= 2 * kMostExponent ? exponents : none;
}

}  // namespace gainsmith::numerics
