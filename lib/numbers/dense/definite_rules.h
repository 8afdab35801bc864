// Internal to numbers: definite.h, instantiated by one source a scalar.
#pragma once

#include <cmath>
#include <vector>

#include "numbers/dense/definite.h"
#include "numbers/dense/dense.h"
#include "numbers/dense/factor.h"

namespace gainsmith::numbers {

namespace definiteness {

/// k with 4^k near the size of each diagonal element; empty when one is not > 0.
template <class S>
std::vector<int> halved_exponents(const MatrixOf<S>& mid) {
  std::vector<int> exponents;
  exponents.reserve(static_cast<std::size_t>(mid.rows()));
  for (Eigen::Index i = 0; i < mid.rows(); ++i) {
    const auto size = static_cast<double>(mid(i, i));
    if (!(size > 0) || !std::isfinite(size)) return {};
    exponents.push_back((std::ilogb(size) + 1) >> 1);  // leaves [1/2, 2)
  }
  return exponents;
}

/// The check of definite(), with radii rad + more; `more` may be empty.
template <class S>
bool passes(const Enclosed<S>& M, const Matrix& more) {
  const Eigen::Index n = M.rows();
  if (n == 0) return true;
  const std::vector<int> units = halved_exponents<S>(M.mid);
  if (static_cast<Eigen::Index>(units.size()) != n) return false;
  MatrixOf<S> A(n, n);
  Vector sums = Vector::Zero(n);
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index i = 0; i < n; ++i) {
      const int unit = -units[static_cast<std::size_t>(i)] - units[static_cast<std::size_t>(j)];
      if (i >= j) A(i, j) = times_power_of_two(M.mid(i, j), unit);
      double radius = M.rad(i, j);
      if (more.size() != 0) radius += (more(i, j) + more(j, i)) / 2;
      sums(i) += times_power_of_two(radius, unit) + kTiny;
    }
  // Of the radii the largest row sum bounds the spectral norm; the rest is the error of Cholesky of
  // a matrix with a diagonal below 2.
  const auto m = static_cast<double>(n) + 2;
  const double shift = up(sums.maxCoeff(), 2 * m + 8) + 2 * m * m * unit_roundoff<S>() * (1 + 1e-9);
  if (!(shift < 2)) return false;
  for (Eigen::Index i = 0; i < n; ++i) A(i, i) -= S(shift);
  return factor_in_place<S>(A);
}

/// v'Mv in balls, for v of double.
template <class S>
Ball<S> form(const Enclosed<S>& M, const Vector& v) {
  const Enclosed<S> column = exactly<S>(MatrixOf<S>(v.template cast<S>()));
  return product(transposed(column), product(M, column)).ball(0);
}

/// v with certainly v'Mv <= 0: a unit vector, or an eigenvector in the units of the diagonal.
template <class S>
Definite not_positive(const Enclosed<S>& M) {
  const Eigen::Index n = M.rows();
  Definite result;
  const auto take = [&](const Vector& v, const Ball<S>& value) {
    const Ball<S> opposite = -value;
    if (!is_not_negative(opposite) || result.sign == Sign::negative) return;
    result.sign = is_positive(opposite) ? Sign::negative : Sign::not_positive;
    result.direction = v;
  };
  for (Eigen::Index i = 0; i < n; ++i) take(Vector::Unit(n, i), M.ball(i, i));
  if (result.sign == Sign::negative) return result;
  Matrix rounded = M.mid.unaryExpr([](const S& x) { return static_cast<double>(x); });
  Vector units(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    double size = std::abs(rounded(i, i));
    // A row without a diagonal is as large as its elements.
    if (size == 0) size = std::pow(rounded.row(i).cwiseAbs().maxCoeff(), 2);
    units(i) = size > 0 && std::isfinite(size) ? std::ldexp(1.0, -std::ilogb(size) / 2) : 1;
  }
  rounded = (units.asDiagonal() * rounded * units.asDiagonal()).eval();
  if (!rounded.allFinite()) return result;
  const SymmetricEigen eigen(rounded);
  const Vector v = units.cwiseProduct(eigen.vectors().col(0));
  if (v.allFinite()) take(v, form(M, v));
  return result;
}

}  // namespace definiteness

template <class S>
Definite definite(const Enclosed<S>& M) {
  const Enclosed<S> symmetric = symmetric_part(M);
  if (definiteness::passes<S>(symmetric, {})) return {Sign::positive, {}};
  return definiteness::not_positive<S>(symmetric);
}

template <class S>
bool is_positive_definite(const Enclosed<S>& M, const Matrix& more) {
  return definiteness::passes<S>(symmetric_part(M), more);
}

}  // namespace gainsmith::numbers
