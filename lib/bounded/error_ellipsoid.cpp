#include "bounded/error_ellipsoid.h"

#include <algorithm>
#include <cmath>

#include "bounded/ball.h"
#include "bounded/small_size.h"

namespace gainsmith::bounded {

namespace {

using Eigen::Index;
using numbers::Matrix;

/// Whether squares and products of such sizes stay far within the range of double.
bool is_in_range(double size) { return size >= 0x1p-256 && size <= 0x1p256; }

template <int N>
void multiply(Index size, const double* e, const double* g, double* p) {
  const Index n = N > 0 ? N : size;
  for (Index j = 0; j < n; ++j) {
    for (Index i = 0; i < n; ++i) p[j * n + i] = 0;
    for (Index k = 0; k < n; ++k)
      for (Index i = 0; i < n; ++i) p[j * n + i] += e[k * n + i] * g[j * n + k];
  }
}

template <int N>
void multiply_column(Index size, const double* e, const double* x, double* p) {
  const Index n = N > 0 ? N : size;
  for (Index k = 0; k < n; ++k)
    for (Index i = 0; i < n; ++i) p[i] += e[k * n + i] * x[k];
}

template <int N>
void row_squares(Index size, const double* g, double* p) {
  const Index n = N > 0 ? N : size;
  for (Index i = 0; i < n; ++i) p[i] = 0;
  for (Index k = 0; k < n; ++k)
    for (Index i = 0; i < n; ++i) p[i] += g[k * n + i] * g[k * n + i];
}

}  // namespace

void ErrorEllipsoid::start(const Eigen::VectorXd& delta) {
  const Index n = delta.size();
  bounds_.resize(n);
  reach_.resize(n);
  product_.resize(n, n);
  G_ = Matrix::Zero(n, n);
  norm_ = Eigen::VectorXd::Zero(n);
  scale_ = 1;
  terms_ = 0;
  z_ = delta;
  set_bounds();
  gather();
  bounds_ = delta * kBoundSlack;
}

void ErrorEllipsoid::rescale(double largest) {
  G_ /= largest;
  scale_ *= largest;
}

void ErrorEllipsoid::step(const Matrix& E, const Matrix& sizes, const Eigen::VectorXd& delta) {
  const Index n = bounds_.size();
  const double eps = 4 * (static_cast<double>(n) + 2) * unit_roundoff<double>();
  const double factor = eps * std::sqrt(terms_) * scale_;
  for (Index i = 0; i < n; ++i) reach_(i) = z_(i) * (1 + eps) + factor * norm_(i);
  z_ = delta;
  with_size(n, [&](auto N) {
    multiply_column<decltype(N)::value>(n, sizes.data(), reach_.data(), z_.data());
    if (terms_ == 0) return;
    multiply<decltype(N)::value>(n, E.data(), G_.data(), product_.data());
  });
  if (terms_ > 0) G_.swap(product_);
  set_bounds();
}

void ErrorEllipsoid::set_bounds() {
  const Index n = bounds_.size();
  if (terms_ == 0) {
    bounds_ = z_ * kBoundSlack;
    return;
  }
  with_size(n, [&](auto N) { row_squares<decltype(N)::value>(n, G_.data(), norm_.data()); });
  const double factor = std::sqrt(terms_) * scale_;
  double largest = 0;
  for (Index i = 0; i < n; ++i) {
    norm_(i) = norm_(i) > full_precision_from()
                   ? std::sqrt(norm_(i))
                   : std::sqrt(static_cast<double>(n)) * G_.row(i).lpNorm<Eigen::Infinity>();
    bounds_(i) = (factor * norm_(i) + z_(i)) * kBoundSlack;
    largest = std::max(largest, norm_(i));
  }
  if (largest > 0 && !is_in_range(largest)) {
    rescale(largest);
    set_bounds();
  }
}

void ErrorEllipsoid::triangulate() {
  // Householder, in place; R is what remains above the diagonal.
  const Index n = stacked_.cols();
  const Index rows = stacked_.rows();
  for (Index k = 0; k < n; ++k) {
    auto column = stacked_.col(k).segment(k, rows - k);
    const double norm = column.norm();
    if (norm == 0) continue;
    const double head = column(0);
    const double alpha = head > 0 ? -norm : norm;
    column(0) = head - alpha;
    const double square = norm * (norm + std::abs(head));  // |v|^2 / 2
    for (Index j = k + 1; j < n; ++j) {
      auto other = stacked_.col(j).segment(k, rows - k);
      other -= (column.dot(other) / square) * column;
    }
    column(0) = alpha;
  }
}

void ErrorEllipsoid::gather() {
  const Index n = bounds_.size();
  const double most = n == 0 ? 0 : z_.maxCoeff();
  if (!(most > 0)) return;
  const double largest = std::max(most, terms_ == 0 ? 0 : scale_ * norm_.maxCoeff());
  if (!std::isfinite(largest)) return;
  rescale(largest / scale_);
  stacked_.resize(2 * n, n);
  stacked_.topRows(n) = G_.transpose();
  stacked_.bottomRows(n).setZero();
  for (Index i = 0; i < n; ++i)
    stacked_(n + i, i) = std::sqrt(static_cast<double>(n)) * (z_(i) / scale_);
  triangulate();
  G_.setZero();
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i <= j; ++i) G_(j, i) = stacked_(i, j);
  terms_ += 1;
  const double rounding =
      100 * static_cast<double>(n * n) * unit_roundoff<double>() * std::sqrt(terms_) * scale_;
  with_size(n, [&](auto N) { row_squares<decltype(N)::value>(n, G_.data(), norm_.data()); });
  for (Index i = 0; i < n; ++i)
    z_(i) = rounding * std::max(std::sqrt(norm_(i)), G_.row(i).lpNorm<Eigen::Infinity>());
  set_bounds();
}

}  // namespace gainsmith::bounded
