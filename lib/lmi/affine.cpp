#include "lmi/affine.h"

#include <algorithm>
#include <map>
#include <utility>

#include "forall/hull.h"

namespace gainsmith::lmi {

namespace {

using Key = AffineForm::Key;

}  // namespace

void add_term(AffineForm& form, AffineForm::Key key, const Sparse& matrix) {
  if (matrix.nonZeros() == 0) return;
  const auto found = form.terms.lower_bound(key);
  if (found == form.terms.end() || found->first != key) {
    form.terms.emplace_hint(found, key, matrix);
    return;
  }
  found->second = sum_of(found->second, matrix, 1);
  if (found->second.nonZeros() == 0) form.terms.erase(found);
}

void add_term(AffineForm& form, AffineForm::Key key, const Sparse& matrix, double factor) {
  if (matrix.nonZeros() == 0 || factor == 0) return;
  const auto found = form.terms.lower_bound(key);
  if (found == form.terms.end() || found->first != key) {
    form.terms.emplace_hint(found, key, factor == 1 ? matrix : Sparse(factor * matrix));
    return;
  }
  found->second = sum_of(found->second, matrix, factor);
  if (found->second.nonZeros() == 0) form.terms.erase(found);
}

numbers::Matrix dense_constant(const AffineForm& form) {
  const auto found = form.terms.find({0, 0});
  if (found == form.terms.end()) return numbers::Matrix::Zero(form.shape.rows, form.shape.cols);
  return numbers::Matrix(found->second);
}

AffineForm expanded(const AffineForm& form) {
  AffineForm result{form.shape, form.terms};
  std::map<int, std::vector<Product>> by_monomial;
  for (const Product& product : form.products) by_monomial[product.monomial].push_back(product);
  for (const auto& [monomial, products] : by_monomial)
    for (const auto& [i, matrix] : coefficients(products, form.shape.rows, form.shape.cols))
      add_term(result, {monomial, i}, matrix);
  return result;
}

bool is_same(const AffineForm& a, const AffineForm& b) {
  if (!a.products.empty() || !b.products.empty()) return is_same(expanded(a), expanded(b));
  return a.shape == b.shape && a.terms.size() == b.terms.size() &&
         std::equal(a.terms.begin(), a.terms.end(), b.terms.begin(),
                    [](const auto& left, const auto& right) {
                      return left.first == right.first &&
                             Sparse(left.second - right.second).norm() == 0;
                    });
}

void add_placed(AffineForm& form, const AffineForm& other, int row, int column, double factor) {
  const auto [rows, columns] = std::pair(form.shape.rows, form.shape.cols);
  for (const auto& [key, matrix] : other.terms)
    add_term(form, key, placed(matrix, rows, columns, row, column), factor);
  for (const Product& product : other.products) {
    Product whole = product;
    whole.left = placed(product.left, rows, static_cast<int>(product.left.cols()), row, 0);
    whole.right = placed(product.right, static_cast<int>(product.right.rows()), columns, 0, column);
    add_product(form.products, std::move(whole), factor);
  }
}

AffineForm transposed(const AffineForm& form) {
  AffineForm result{{form.shape.cols, form.shape.rows}, {}};
  for (const auto& [key, matrix] : form.terms) result.terms.emplace(key, matrix.transpose());
  for (const Product& product : form.products) add_product(result.products, transposed(product));
  return result;
}

bool AffineForm::is_constant() const {
  return products.empty() &&
         (terms.empty() || (terms.size() == 1 && terms.begin()->first == Key{0, 0}));
}

bool AffineForm::has_unknown(int* which) const {
  for (const auto& [key, matrix] : terms) {
    if (key.second == 0) continue;
    if (which != nullptr) *which = key.second;
    return true;
  }
  if (products.empty()) return false;
  if (which != nullptr) *which = products.front().unknown.first;
  return true;
}

AffineForm constant_form(const numbers::Matrix& matrix) {
  AffineForm result{{static_cast<int>(matrix.rows()), static_cast<int>(matrix.cols())}, {}};
  add_term(result, {0, 0}, sparse(matrix));
  return result;
}

AffineForm unknown_form(const Unknown& unknown) {
  AffineForm result{unknown.shape, {}};
  // I V I: the scalars of a large matrix are not written out.
  if (unknown.whole) {
    const auto [rows, columns] = std::pair(unknown.shape.rows, unknown.shape.cols);
    Sparse left(rows, rows);
    Sparse right(columns, columns);
    left.setIdentity();
    right.setIdentity();
    const bool symmetric = unknown.structure == model::Structure::symmetric;
    result.products.push_back({0, {unknown.first, rows, columns, symmetric}, false, left, right});
    return result;
  }
  for (int k = 0; k < unknown.count; ++k) {
    Sparse matrix(unknown.shape.rows, unknown.shape.cols);
    for (const auto& [row, column] : unknown.places(k)) matrix.insert(row, column) = 1;
    matrix.makeCompressed();
    result.terms.emplace(Key{0, unknown.first + k}, std::move(matrix));
  }
  return result;
}

AffineForm variable_form(forall::MonomialTable& monomials, int variable) {
  const forall::Variable& v = monomials.variables()[static_cast<std::size_t>(variable)];
  AffineForm result{v.shape, {}};
  if (v.is_interval()) {
    const int tau = monomials.index(variable, forall::Atom{1, 0, 0, false});
    add_term(result, {tau, 0}, sparse(numbers::Matrix::Ones(1, 1)));
    return result;
  }
  // sum_j alpha_j V_j with weights alpha_j that sum to 1: V_0 + sum_{j>0} alpha_j (V_j - V_0).
  add_term(result, {0, 0}, sparse(v.elements[0]));
  for (int j = 1; j < static_cast<int>(v.elements.size()); ++j)
    add_term(result, {monomials.index_of_weight(variable, j), 0},
             sparse(v.elements[static_cast<std::size_t>(j)] - v.elements[0]));
  return result;
}

std::set<int> monomials_in(const AffineForm& form) {
  std::set<int> found;
  for (const auto& [key, matrix] : form.terms)
    if (key.first != 0) found.insert(key.first);
  for (const Product& product : form.products)
    if (product.monomial != 0) found.insert(product.monomial);
  return found;
}

namespace {

/// The largest share that an element of a monomial's terms has in the largest one that the same
/// unknown has at its place, so that no unit matters.
forall::Sizes shares_of(const AffineForm& form) {
  std::map<int, std::vector<std::pair<int, const Sparse*>>> by_unknown;
  for (const auto& [key, matrix] : form.terms)
    by_unknown[key.second].emplace_back(key.first, &matrix);
  numbers::Matrix largest = numbers::Matrix::Zero(form.shape.rows, form.shape.cols);
  forall::Sizes sizes;
  const auto for_each = [](const Sparse& matrix, const auto& visit) {
    for (int column = 0; column < matrix.outerSize(); ++column)
      for (Sparse::InnerIterator it(matrix, column); it; ++it)
        visit(it.row(), it.col(), std::abs(it.value()));
  };
  for (const auto& [unknown, list] : by_unknown) {
    for (const auto& [monomial, matrix] : list)
      for_each(*matrix, [&](Eigen::Index row, Eigen::Index column, double size) {
        largest(row, column) = std::max(largest(row, column), size);
      });
    for (const auto& [monomial, matrix] : list)
      for_each(*matrix, [&, of = monomial](Eigen::Index row, Eigen::Index column, double size) {
        if (size > 0) sizes[of] = std::max(sizes[of], size / largest(row, column));
      });
    for (const auto& [monomial, matrix] : list)
      for_each(*matrix,
               [&](Eigen::Index row, Eigen::Index column, double) { largest(row, column) = 0; });
  }
  return sizes;
}

}  // namespace

void remove_noise(AffineForm& form, const forall::MonomialTable& monomials) {
  if (monomials_in(form).empty()) return;
  const std::set<int> noise = forall::noise(shares_of(expanded(form)), monomials);
  std::erase_if(form.terms, [&](const auto& term) { return noise.contains(term.first.first); });
  std::erase_if(form.products,
                [&](const Product& product) { return noise.contains(product.monomial); });
}

// Numbers for monomials: the terms of one unknown add up.
AffineForm at_vertex(const AffineForm& form, const std::vector<double>& values) {
  AffineForm result{form.shape, {}};
  for (const auto& [key, matrix] : form.terms) {
    const double factor = values[static_cast<std::size_t>(key.first)];
    const auto [found, fresh] = result.terms.try_emplace({0, key.second}, factor * matrix);
    if (!fresh) found->second = found->second + factor * matrix;
  }
  for (Product product : form.products) {
    const double factor = values[static_cast<std::size_t>(product.monomial)];
    product.monomial = 0;
    add_product(result.products, std::move(product), factor);
  }
  return result;
}

numbers::Matrix value_of(const AffineForm& form, const std::vector<double>& x) {
  numbers::Matrix result = numbers::Matrix::Zero(form.shape.rows, form.shape.cols);
  for (const auto& [key, matrix] : form.terms)
    add_multiple(result, key.second == 0 ? 1.0 : x[static_cast<std::size_t>(key.second) - 1],
                 matrix);
  for (const Product& product : form.products) {
    numbers::Matrix V = matrix_at(product.unknown, x);
    if (product.transposed) V = V.transpose().eval();
    const numbers::Matrix inner = product.left * V;
    result += inner * product.right;
  }
  return result;
}

}  // namespace gainsmith::lmi
