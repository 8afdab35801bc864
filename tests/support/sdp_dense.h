// The solver's equations by their definition, for the tests of its parts: every matrix stored in
// full, one a block and one of size one a linear entry, plain loops, nothing shared with the solver
// but the record `Data`.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "sdp/data.h"
#include "sdp/problem.h"

namespace gainsmith::sdp::testing {

template <typename T>
using Full = std::vector<Matrix<T>>;

template <typename T>
Full<T> full(const Blocks<T>& matrix) {
  Full<T> result;
  for (int b = 0; b < matrix.layout().blocks(); ++b) result.emplace_back(matrix.dense(b));
  for (const T& value : matrix.linear()) result.push_back(Matrix<T>::Constant(1, 1, value));
  return result;
}

/// a + factor b
template <typename T>
Full<T> plus(const Full<T>& a, const T& factor, const Full<T>& b) {
  Full<T> result = a;
  for (std::size_t k = 0; k < a.size(); ++k) result[k] += factor * b[k];
  return result;
}

template <typename T>
Full<T> times(const Full<T>& a, const Full<T>& b) {
  Full<T> result;
  for (std::size_t k = 0; k < a.size(); ++k) result.push_back(a[k].lazyProduct(b[k]));
  return result;
}

/// H(M) = (M + M')/2
template <typename T>
Full<T> symmetric_part(const Full<T>& m) {
  Full<T> result;
  for (const Matrix<T>& block : m) result.push_back(T(0.5) * (block + block.transpose()));
  return result;
}

template <typename T>
Full<T> scaled(const T& factor, Full<T> m) {
  for (Matrix<T>& block : m) block *= factor;
  return m;
}

/// trace(A B)
template <typename T>
T trace_of_product(const Full<T>& a, const Full<T>& b) {
  T sum(0);
  for (std::size_t k = 0; k < a.size(); ++k)
    for (Eigen::Index j = 0; j < a[k].cols(); ++j)
      for (Eigen::Index i = 0; i < a[k].rows(); ++i) sum += a[k](i, j) * b[k](j, i);
  return sum;
}

/// By Gauss-Jordan elimination; for positive definite matrices, which need no pivoting.
template <typename T>
Full<T> inverse(const Full<T>& m) {
  Full<T> result;
  for (Matrix<T> a : m) {
    const Eigen::Index n = a.rows();
    Matrix<T> x = Matrix<T>::Identity(n, n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const T pivot = a(k, k);
      a.row(k) /= pivot;
      x.row(k) /= pivot;
      for (Eigen::Index i = 0; i < n; ++i) {
        const T factor = a(i, k);
        if (i == k || factor == T(0)) continue;
        a.row(i) -= factor * a.row(k);
        x.row(i) -= factor * x.row(k);
      }
    }
    result.push_back(x);
  }
  return result;
}

template <typename T>
double largest(const Full<T>& m) {
  double result = 0;
  for (const Matrix<T>& block : m)
    for (const T& value : block.reshaped())
      result = std::max(result, std::abs(static_cast<double>(value)));
  return result;
}

template <typename T>
double largest(const Vector<T>& v) {
  return largest(Full<T>{v});
}

/// F_0, ..., F_m and c of a working problem, in full.
template <typename T>
struct Dense {
  explicit Dense(const Data& data) : c(data.m()) {
    Full<T> zero;
    for (const int n : data.layout.size) zero.push_back(Matrix<T>::Zero(n, n));
    for (int k = 0; k < data.layout.linear; ++k) zero.push_back(Matrix<T>::Zero(1, 1));
    f.assign(static_cast<std::size_t>(data.m()) + 1, zero);
    for (std::size_t b = 0; b < data.dense.size(); ++b)
      visit(data.dense[b], [&](Full<T>& fi, const Term& term, const T& value) {
        fi[b](term.row, term.column) = fi[b](term.column, term.row) = value;
      });
    visit(data.linear, [&](Full<T>& fi, const Term& term, const T& value) {
      fi[data.dense.size() + static_cast<std::size_t>(term.row)](0, 0) = value;
    });
    for (int i = 0; i < data.m(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      c[i] = number(data.c[at], data.c_rest[at]);
    }
  }

  int m() const { return static_cast<int>(c.size()); }

  /// sum x_i F_i - tau F_0
  Full<T> combine(const Vector<T>& x, const T& tau) const {
    Full<T> sum = scaled(T(-tau), f[0]);
    for (int i = 0; i < m(); ++i) sum = plus(sum, T(x[i]), f[static_cast<std::size_t>(i) + 1]);
    return sum;
  }

  /// A(S)_i = F_i . S
  Vector<T> products(const Full<T>& s) const {
    Vector<T> result(m());
    for (int i = 0; i < m(); ++i)
      result[i] = trace_of_product(f[static_cast<std::size_t>(i) + 1], s);
    return result;
  }

  std::vector<Full<T>> f;
  Vector<T> c;

 private:
  static T number(double value, double rest) {
    return std::is_same_v<T, double> ? T(value) : T(T(value) + T(rest));
  }
  template <typename Visit>
  void visit(const BlockData& block, const Visit& at) {
    for (std::size_t k = 0; k < block.constraint.size(); ++k)
      for (std::size_t t = block.start[k]; t < block.start[k + 1]; ++t)
        at(f[static_cast<std::size_t>(block.constraint[k])], block.terms[t],
           number(block.terms[t].value, block.terms[t].rest));
  }
};

struct NamedProblem {
  std::string name;
  Problem problem;
};

/// Random F_i and c in every shape that blocks and coefficients come in: one dense block, a
/// diagonal one, blocks of size one, several with coefficients that are empty in some, rows that
/// never occur, coefficients of a few entries, of a few rows (as P A + A'P), and a chain of small
/// blocks whose Schur complement is sparse. All numbers have a rest.
std::vector<NamedProblem> random_problems(std::uint64_t seed);

/// A A' + I with random A in every block, 1 + a^2 in the linear part.
template <typename T>
void fill_positive(std::uint64_t seed, Blocks<T>& matrix);
/// Positive definite, with the pattern of `data` where a block keeps one: so are X and R.
template <typename T>
void fill_positive(std::uint64_t seed, const Data& data, Blocks<T>& matrix);
/// Random and symmetric.
template <typename T>
void fill_symmetric(std::uint64_t seed, Blocks<T>& matrix);
template <typename T>
void fill(std::uint64_t seed, Vector<T>& v);

}  // namespace gainsmith::sdp::testing
