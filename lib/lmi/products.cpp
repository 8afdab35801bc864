#include "lmi/products.h"

#include <map>
#include <optional>

#include "base/stop.h"
#include "lmi/gather.h"

namespace gainsmith::lmi {

namespace {

/// c with a = c b, element for element; none where there is no such number.
std::optional<double> ratio(const Sparse& a, const Sparse& b) {
  if (a.rows() != b.rows() || a.cols() != b.cols() || a.nonZeros() != b.nonZeros() ||
      a.nonZeros() == 0)
    return std::nullopt;
  std::optional<double> factor;
  for (int k = 0; k < a.outerSize(); ++k) {
    Sparse::InnerIterator p(a, k);
    Sparse::InnerIterator q(b, k);
    for (; p && q; ++p, ++q) {
      if (p.index() != q.index()) return std::nullopt;
      if (!factor) factor = p.value() / q.value();
      if (p.value() != *factor * q.value()) return std::nullopt;
    }
    if (p || q) return std::nullopt;
  }
  return factor;
}

/// a / b at the first element of b.
double first_ratio(const Sparse& a, const Sparse& b) {
  for (int k = 0; k < b.outerSize(); ++k)
    if (Sparse::InnerIterator it(b, k); it) return a.coeff(it.row(), k) / it.value();
  return 0;
}

Sparse turned(const Sparse& matrix) { return matrix.transpose(); }

/// One term of S +- S', where (E, F) may be given as (F', E') with the sign.
struct Sides {
  MatrixUnknown unknown;
  Sparse left;
  Sparse right;
};

/// Adds E V F + sign (E V F)' to a sum of such terms, merged where a side is the same.
void add_with_mirror(std::vector<Sides>& sum, Sides term, double sign) {
  if (term.left.nonZeros() == 0 || term.right.nonZeros() == 0) return;
  const Sparse left = turned(term.right);
  const Sparse right = turned(term.left);
  const bool symmetric = term.unknown.symmetric;
  for (auto known = sum.begin(); known != sum.end(); ++known) {
    if (!(known->unknown == term.unknown)) continue;
    if (const auto c = ratio(term.left, known->left))
      known->right = sum_of(known->right, term.right, *c);
    else if (const auto d = ratio(term.right, known->right))
      known->left = sum_of(known->left, term.left, *d);
    else if (const auto e = symmetric ? ratio(left, known->left) : std::nullopt)
      known->right = sum_of(known->right, right, sign * *e);
    else if (const auto f = symmetric ? ratio(right, known->right) : std::nullopt)
      known->left = sum_of(known->left, left, sign * *f);
    else
      continue;
    Sides merged = std::move(*known);
    sum.erase(known);
    // It may be like another one now.
    return add_with_mirror(sum, std::move(merged), sign);
  }
  sum.push_back(std::move(term));
}

/// S + sign S' for half of a sum S of products: terms with V, not V'.
std::vector<Sides> with_mirrors(const std::vector<Product>& sum, double sign) {
  std::vector<Sides> result;
  for (const Product& product : sum) {
    if (product.transposed) {
      // E V' F = (F' V E')', which counts with the sign in S + sign S'.
      add_with_mirror(
          result,
          {product.unknown, turned(product.right), Sparse(0.5 * sign * turned(product.left))},
          sign);
      continue;
    }
    add_with_mirror(result, {product.unknown, product.left, Sparse(0.5 * product.right)}, sign);
  }
  return result;
}

/// The rows of F as columns of F'.
struct Factors {
  const Sparse* left;
  Sparse right;  ///< F'
  bool transposed;
};

/// Calls add(row, column, value) for the elements of E(:, i) F(j, :).
template <class Add>
void outer_product(const Factors& factors, int i, int j, Add add) {
  for (Sparse::InnerIterator f(factors.right, j); f; ++f)
    for (Sparse::InnerIterator e(*factors.left, i); e; ++e)
      add(static_cast<int>(e.index()), static_cast<int>(f.index()), e.value() * f.value());
}

/// The coefficients of all scalars of one unknown: those of V_ij are what the factors make of it.
template <class Add, class Take>
void coefficients_of(const MatrixUnknown& unknown, const std::vector<Factors>& all, Add add,
                     Take take, std::vector<std::pair<int, Sparse>>& out) {
  int index = unknown.first;
  out.reserve(out.size() + static_cast<std::size_t>(unknown.count()));
  for (int j = 0; j < unknown.columns; ++j) {
    check_stop();
    for (int i = unknown.symmetric ? j : 0; i < unknown.rows; ++i) {
      for (const Factors& factors : all) {
        if (unknown.symmetric && i != j) outer_product(factors, j, i, add);
        outer_product(factors, factors.transposed ? j : i, factors.transposed ? i : j, add);
      }
      Sparse matrix = take();
      if (matrix.nonZeros() > 0) out.emplace_back(index, Sparse()).second.swap(matrix);
      ++index;
    }
  }
}

/// The terms by their unknown, in the order of the scalars.
template <class Term, class MakeFactors>
std::map<int, std::pair<MatrixUnknown, std::vector<Factors>>> by_unknown(
    const std::vector<Term>& terms, MakeFactors make) {
  std::map<int, std::pair<MatrixUnknown, std::vector<Factors>>> result;
  for (const Term& term : terms) {
    auto& [unknown, factors] = result[term.unknown.first];
    unknown = term.unknown;
    factors.push_back(make(term));
  }
  return result;
}

}  // namespace

void add_product(std::vector<Product>& sum, Product product, double factor) {
  if (factor == 0 || product.left.nonZeros() == 0 || product.right.nonZeros() == 0) return;
  if (factor != 1) product.right = factor * product.right;
  for (auto known = sum.begin(); known != sum.end(); ++known) {
    if (!known->has_same_unknown(product)) continue;
    // E V F + c E V G = E V (F + c G), and likewise for equal right sides.
    if (const auto c = ratio(product.left, known->left))
      known->right = sum_of(known->right, product.right, *c);
    else if (const auto d = ratio(product.right, known->right))
      known->left = sum_of(known->left, product.left, *d);
    else
      continue;
    if (known->left.nonZeros() == 0 || known->right.nonZeros() == 0) sum.erase(known);
    return;
  }
  sum.push_back(std::move(product));
}

// Of a symmetric V transposition leaves V as it is.
Product transposed(const Product& product) {
  return {product.monomial, product.unknown, !product.unknown.symmetric && !product.transposed,
          turned(product.right), turned(product.left)};
}

// (S + S')/2 = sum He(E V F/2), terms with V' turned into terms with V.
std::vector<HermitianProduct> symmetric_part(const std::vector<Product>& sum) {
  std::vector<HermitianProduct> result;
  for (Sides& term : with_mirrors(sum, 1))
    result.push_back({term.unknown, std::move(term.left), std::move(term.right)});
  return result;
}

double asymmetry(const std::vector<Product>& sum) {
  // (S - S')/2 is the sum of these, and V_ij is at two places of V, both in E V F and (E V F)'.
  constexpr double kPlaces = 8;
  double bound = 0;
  for (const Sides& term : with_mirrors(sum, -1)) {
    // Of a symmetric V, E V F - (E V F)' is 0 where F' = c E.
    const Sparse mirrored = turned(term.right);
    const Sparse rest = term.unknown.symmetric
                            ? sum_of(mirrored, term.left, -first_ratio(mirrored, term.left))
                            : mirrored;
    bound += kPlaces * largest_element(term.left) * largest_element(rest);
  }
  return bound;
}

std::vector<std::pair<int, Sparse>> coefficients(const std::vector<Product>& sum, int rows,
                                                 int columns) {
  std::vector<std::pair<int, Sparse>> result;
  Gatherer gatherer(rows, columns);
  const auto factors = by_unknown(sum, [](const Product& product) {
    return Factors{&product.left, turned(product.right), product.transposed};
  });
  for (const auto& [first, of_one] : factors)
    coefficients_of(
        of_one.first, of_one.second,
        [&](int row, int column, double value) { gatherer.add(row, column, value); },
        [&] { return gatherer.take(); }, result);
  return result;
}

std::vector<std::pair<int, Sparse>> coefficients(const std::vector<HermitianProduct>& sum,
                                                 int size) {
  std::vector<std::pair<int, Sparse>> result;
  Gatherer gatherer(size, size);
  const auto factors = by_unknown(sum, [](const HermitianProduct& product) {
    return Factors{&product.left, turned(product.right), false};
  });
  for (const auto& [first, of_one] : factors)
    coefficients_of(
        of_one.first, of_one.second,
        [&](int row, int column, double value) {
          gatherer.add_mirrored(row, column, row == column ? 2 * value : value);
        },
        [&] { return gatherer.take_mirrored(); }, result);
  return result;
}

Eigen::MatrixXd matrix_at(const MatrixUnknown& unknown, const std::vector<double>& x) {
  Eigen::MatrixXd result(unknown.rows, unknown.columns);
  auto next = x.begin() + (unknown.first - 1);
  for (int j = 0; j < unknown.columns; ++j)
    for (int i = unknown.symmetric ? j : 0; i < unknown.rows; ++i) {
      if (unknown.symmetric) result(j, i) = *next;
      result(i, j) = *next++;
    }
  return result;
}

}  // namespace gainsmith::lmi
