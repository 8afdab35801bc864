// Internal to numbers: one orthonormal basis for each subspace, over numbers and balls alike.
//
// The basis B of a subspace with the orthogonal projector P = B B', k columns, is the Cholesky
// factor of P with pivots: with W = P, for j = 1..k
//
//   r = the diagonal of W,   p = the first row with e r_p >= r_i for all i,
//   b_j = W(:, p) / sqrt(r_p),   W <- W - b_j b_j'.
//
// P belongs to the subspace alone, so B does: no decomposition, precision or machine has a part in
// it. The pivot is one of the largest but for a factor; what is equal but for rounding (a common
// case) leaves the first in place, since ratios of exactly e do not occur in practice. So B moves
// as little as P does, until a ratio passes e. B(p_j, j) > 0, and B(p_j, l) = 0 for l > j.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "numbers/dense/householder.h"
#include "numbers/types/ball_functions.h"

namespace gainsmith::numbers::canonical {

/// The factor e by which a later diagonal element must exceed an earlier one to be the pivot.
constexpr double kLead = 2.718281828459045;

/// Whether x >= y; none when nobody knows.
template <class S>
std::optional<bool> at_least(const S& x, const S& y) {
  return x >= y;
}
template <class S>
std::optional<bool> at_least(const Ball<S>& x, const Ball<S>& y) {
  if (is_at_least(x, y)) return true;
  return is_positive(y - x) ? std::optional(false) : std::nullopt;
}

/// sqrt(x); none where x is not certainly > 0.
template <class S>
std::optional<S> root(const S& x) {
  using std::sqrt;
  return x > S(0) ? std::optional<S>(sqrt(x)) : std::nullopt;
}
template <class S>
std::optional<Ball<S>> root(const Ball<S>& x) {
  return is_positive(x) ? ball::sqrt(x) : std::nullopt;
}

/// The row p of the header, from the diagonal of W: the first with lead W_pp >= W_ii for all i.
/// None where that is not certain.
template <class Number>
std::optional<std::size_t> pivot(const Columns<Number>& W, const Number& lead) {
  for (std::size_t p = 0; p < W.size(); ++p) {
    const Number raised = lead * W[p][p];
    bool known = true, beaten = false;
    for (std::size_t i = 0; i < W.size() && !beaten; ++i) {
      if (i == p) continue;
      const std::optional<bool> leads = at_least(raised, W[i][i]);
      known = known && leads.has_value();
      beaten = leads == false;
    }
    if (beaten) continue;
    return known ? std::optional(p) : std::nullopt;
  }
  return std::nullopt;
}

/// The k columns of B from those of P; none when a pivot is not known for certain.
template <class Number>
std::optional<Columns<Number>> basis(Columns<Number> W, Eigen::Index k, const Number& lead) {
  Columns<Number> B;
  for (Eigen::Index j = 0; j < k; ++j) {
    const auto p = pivot(W, lead);
    const auto size = p ? root(W[*p][*p]) : std::nullopt;
    if (!size) return std::nullopt;
    std::vector<Number> b = W[*p];
    for (std::size_t i = 0; i < b.size(); ++i) b[i] = i == *p ? *size : b[i] / *size;
    for (std::size_t l = 0; l < W.size(); ++l)
      for (std::size_t i = 0; i < b.size(); ++i)
        W[l][i] = i == *p || l == *p ? Number{} : W[l][i] - b[i] * b[l];
    B.push_back(std::move(b));
  }
  return B;
}

/// Which subspace of a matrix M with n rows: its range, or the kernel of M'.
enum class Of { range, kernel };

/// The columns of P for k dimensions, of which product(i, j) are the elements. What zero rows of M
/// say is exact: their coordinates are not in the range, and in the kernel; what is left of the
/// space may be all that is left of the subspace.
template <class Number, class Product, class IsZero>
Columns<Number> projector(Of of, Eigen::Index n, Eigen::Index k, const Product& product,
                          const IsZero& is_zero, const Number& one) {
  const Number outside = of == Of::kernel ? one : Number{};
  Eigen::Index rows = n;
  for (Eigen::Index i = 0; i < n; ++i)
    if (is_zero(i)) --rows;
  const Eigen::Index dimensions = of == Of::kernel ? k - (n - rows) : k;
  const bool all = dimensions == rows, none = dimensions == 0;
  Columns<Number> P;
  for (Eigen::Index j = 0; j < n; ++j) {
    std::vector<Number>& column = P.emplace_back();
    for (Eigen::Index i = 0; i < n; ++i) {
      if (is_zero(i) || is_zero(j))
        column.push_back(i == j ? outside : Number{});
      else if (all || none)
        column.push_back(i == j && all ? one : Number{});
      else
        column.push_back(product(i, j));
    }
  }
  return P;
}

/// put(i, j, element) for each element of B.
template <class Number, class Put>
void for_each_element(const Columns<Number>& B, const Put& put) {
  Eigen::Index j = 0;
  for (const std::vector<Number>& column : B) {
    Eigen::Index i = 0;
    for (const Number& element : column) put(i++, j, element);
    ++j;
  }
}

}  // namespace gainsmith::numbers::canonical
