#include "lmi/affine.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "forall/hull.h"

namespace gainsmith::lmi {

namespace {

using Key = AffineForm::Key;

}  // namespace

void add_term(AffineForm& form, AffineForm::Key key, Sparse matrix) {
  if (matrix.nonZeros() == 0) return;
  const auto found = form.terms.lower_bound(key);
  if (found == form.terms.end() || found->first != key) {
    form.terms.emplace_hint(found, key, std::move(matrix));
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

bool is_same(const AffineForm& a, const AffineForm& b) {
  return a.shape == b.shape && a.terms.size() == b.terms.size() &&
         std::equal(a.terms.begin(), a.terms.end(), b.terms.begin(),
                    [](const auto& left, const auto& right) {
                      return left.first == right.first &&
                             Sparse(left.second - right.second).norm() == 0;
                    });
}

bool AffineForm::is_constant() const {
  return terms.empty() || (terms.size() == 1 && terms.begin()->first == Key{0, 0});
}

bool AffineForm::has_unknown(int* which) const {
  for (const auto& [key, matrix] : terms) {
    if (key.second == 0) continue;
    if (which != nullptr) *which = key.second;
    return true;
  }
  return false;
}

AffineForm constant_form(const numbers::Matrix& matrix) {
  AffineForm result{{static_cast<int>(matrix.rows()), static_cast<int>(matrix.cols())}, {}};
  add_term(result, {0, 0}, sparse(matrix));
  return result;
}

AffineForm unknown_form(const Unknown& unknown) {
  AffineForm result{unknown.shape, {}};
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
  return found;
}

void remove_noise(AffineForm& form, const forall::MonomialTable& monomials) {
  // An element of a term counts beside the largest one that the same unknown has there, so that no
  // unit matters.
  using Element = std::tuple<int, Eigen::Index, Eigen::Index>;
  std::map<Element, double> largest;
  const auto for_each = [&](const auto& visit) {
    for (const auto& [key, matrix] : form.terms)
      for (int column = 0; column < matrix.outerSize(); ++column)
        for (Sparse::InnerIterator it(matrix, column); it; ++it)
          visit(key.first, Element(key.second, it.row(), it.col()), std::abs(it.value()));
  };
  if (form.terms.empty() || form.terms.rbegin()->first.first == 0) return;
  for_each([&](int, const Element& at, double size) {
    double& most = largest[at];
    most = std::max(most, size);
  });
  forall::Sizes sizes;
  for_each([&](int monomial, const Element& at, double size) {
    if (size > 0) sizes[monomial] = std::max(sizes[monomial], size / largest[at]);
  });
  const std::set<int> noise = forall::noise(sizes, monomials);
  std::erase_if(form.terms, [&](const auto& term) { return noise.contains(term.first.first); });
}

AffineForm at_vertex(const AffineForm& form, const std::vector<double>& values) {
  AffineForm result{form.shape, {}};
  for (const auto& [key, matrix] : form.terms) {
    const double factor = values[static_cast<std::size_t>(key.first)];
    const auto [found, fresh] = result.terms.try_emplace({0, key.second}, factor * matrix);
    if (!fresh) found->second = found->second + factor * matrix;
  }
  return result;
}

numbers::Matrix value_of(const AffineForm& form, const std::vector<double>& x) {
  numbers::Matrix result = numbers::Matrix::Zero(form.shape.rows, form.shape.cols);
  for (const auto& [key, matrix] : form.terms)
    add_multiple(result, key.second == 0 ? 1.0 : x[static_cast<std::size_t>(key.second) - 1],
                 matrix);
  return result;
}

}  // namespace gainsmith::lmi
