#include "hybrid/error_ellipsoid.h"

#include <algorithm>
#include <cmath>

#include "hybrid/ball.h"

namespace gainsmith::hybrid {

namespace {

using Eigen::Index;
using numbers::Matrix;

/// The largest row of G_ and sqrt(Z_) is kept between these.
constexpr double kLeastScale = 1e-80;
constexpr double kMostScale = 1e80;

}  // namespace

void ErrorEllipsoid::start(const Eigen::VectorXd& delta) {
  const Index n = delta.size();
  bounds_.resize(n);
  root_.resize(n);
  product_.resize(n, n);
  G_ = Z_ = Matrix::Zero(n, n);
  norm_ = Eigen::VectorXd::Zero(n);
  scale_ = 1;
  steps_ = 0;
  step(G_, G_, 0, delta);
}

void ErrorEllipsoid::rescale(double largest) {
  if (!(largest > 0) || (largest <= kMostScale && largest >= kLeastScale)) return;
  G_ /= largest;
  Z_ /= largest * largest;
  scale_ *= largest;
}

void ErrorEllipsoid::step(const Matrix& E, const Matrix& sizes, double slack,
                          const Eigen::VectorXd& delta) {
  const Index n = bounds_.size();
  const double eps = 4 * (static_cast<double>(n) + 2) * unit_roundoff<double>() + slack;
  const double* const e = E.data();
  const double* const s = sizes.data();
  double* const p = product_.data();
  double* const g = G_.data();
  double* const z = Z_.data();
  bool known = false;
  for (Index i = 0; i < n; ++i) {
    root_(i) = std::sqrt(z[i * n + i]);
    known = known || norm_(i) > 0 || root_(i) > 0;
  }
  if (known) {
    // G <- E G;  Z <- E Z E';  what the rounding of both adds to the diagonal of Z.
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i < n; ++i) {
        double sum = 0;
        for (Index k = 0; k < n; ++k) sum += e[k * n + i] * g[j * n + k];
        p[j * n + i] = sum;
      }
    G_.swap(product_);
    double* const q = product_.data();
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i < n; ++i) {
        double sum = 0;
        for (Index k = 0; k < n; ++k) sum += e[k * n + i] * z[j * n + k];
        q[j * n + i] = sum;
      }
    for (Index j = 0; j < n; ++j)
      for (Index i = 0; i <= j; ++i) {
        double sum = 0;
        for (Index k = 0; k < n; ++k) sum += q[k * n + i] * e[k * n + j];
        z[j * n + i] = z[i * n + j] = sum;
      }
    for (Index i = 0; i < n; ++i) {
      double from_G = 0;
      double from_Z = 0;
      for (Index k = 0; k < n; ++k) {
        from_G += s[k * n + i] * norm_(k);
        from_Z += s[k * n + i] * root_(k);
      }
      z[i * n + i] +=
          static_cast<double>(n) * (eps * eps * from_G * from_G + eps * from_Z * from_Z);
    }
    steps_ += 1;
  }
  const double inject = n > 0 ? delta.maxCoeff() : 0;
  if (inject > 0) {
    if (!known) scale_ = inject;
    for (Index i = 0; i < n; ++i) {
      const double d = delta(i) / scale_;
      z[i * n + i] += static_cast<double>(n) * d * d;
    }
    steps_ += 1;
  }
  set_bounds();
}

void ErrorEllipsoid::set_bounds() {
  const Index n = bounds_.size();
  const double factor = std::sqrt(steps_) * scale_ * kBoundSlack;
  const double* const g = G_.data();
  double largest = 0;
  for (Index i = 0; i < n; ++i) {
    double square = 0;
    for (Index k = 0; k < n; ++k) square += g[k * n + i] * g[k * n + i];
    norm_(i) = std::sqrt(square);
    const double sum = std::sqrt(square + std::max(Z_(i, i), 0.0));
    bounds_(i) = factor * sum;
    largest = std::max(largest, sum);
  }
  if (largest > kMostScale || (largest < kLeastScale && largest > 0)) {
    rescale(largest);
    set_bounds();
  }
}

void ErrorEllipsoid::gather() {
  // [G, sqrt(n diag Z)] = (Q R)' has the same c' Y c as R'.
  const Index n = bounds_.size();
  if (n == 0) return;
  stacked_.resize(2 * n, n);
  stacked_.topRows(n) = G_.transpose();
  stacked_.bottomRows(n).setZero();
  for (Index i = 0; i < n; ++i)
    stacked_(n + i, i) = std::sqrt(static_cast<double>(n) * std::max(Z_(i, i), 0.0));
  factored_.compute(stacked_);
  G_.setZero();
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i <= j; ++i) G_(j, i) = factored_.matrixQR()(i, j);
  Z_.setZero();
  for (Index i = 0; i < n; ++i) {
    const double norm = G_.row(i).norm();
    const double rounding = 100 * static_cast<double>(n * n) * unit_roundoff<double>() * norm;
    Z_(i, i) = static_cast<double>(n) * rounding * rounding;
  }
  steps_ += 1;
  set_bounds();
}

}  // namespace gainsmith::hybrid
