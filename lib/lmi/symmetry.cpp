#include "lmi/symmetry.h"

#include <Eigen/QR>
#include <algorithm>
#include <vector>

#include "model/function.h"

namespace gainsmith::lmi {

namespace {

using Chosen = std::vector<const model::Design::Unknown*>;

/// Whether the matrix is the unknown, or a coefficient of it.
bool is_of(const Unknown& matrix, const model::Design::Unknown& unknown) {
  if (unknown.variable.empty()) return matrix.name == unknown.name;
  for (int k = 0; k <= unknown.degree; ++k)
    if (matrix.name == model::coefficient_name(unknown.name, static_cast<std::size_t>(k)))
      return true;
  return false;
}

/// The form with x_ij in place of x_ji, i < j, of the unknowns chosen.
AffineForm with_symmetric(const AffineForm& form, const Unknowns& unknowns, const Chosen& chosen) {
  AffineForm result{form.shape, form.terms};
  for (const Unknown& matrix : unknowns.list()) {
    if (std::none_of(chosen.begin(), chosen.end(),
                     [&](const auto* unknown) { return is_of(matrix, *unknown); }))
      continue;
    for (const auto& [key, coefficient] : form.terms) {
      const int k = key.second - matrix.first;
      if (k < 0 || k >= matrix.count) continue;
      const auto [row, column] = matrix.places(k).front();
      if (row <= column) continue;
      result.terms.erase(key);
      const int mirrored = matrix.first + column + row * matrix.shape.rows;
      add_term(result, {key.first, mirrored}, coefficient);
    }
  }
  return result;
}

constexpr double kAsymmetry = 1e-12;  // of the largest element

/// The largest |element| of all coefficients.
double size_of(const AffineForm& form) {
  double size = 0;
  for (const auto& [key, matrix] : form.terms) size = std::max(size, largest_element(matrix));
  return size;
}

/// The element (row, column) as (e_0, e_1, ..., e_m).
template <class Terms, class Index>
numbers::Vector element_of(const Terms& terms, Index index, int row, int column, Eigen::Index m) {
  numbers::Vector element = numbers::Vector::Zero(m + 1);
  for (const auto& [key, matrix] : terms) element[index(key)] = matrix.coeff(row, column);
  return element;
}

/// Whether every coefficient is symmetric but for kAsymmetry of the largest element.
bool is_symmetric(const AffineForm& form) {
  const double size = size_of(form);
  return std::all_of(form.terms.begin(), form.terms.end(), [&](const auto& term) {
    const Sparse mirrored = term.second.transpose();
    return largest_element(sum_of(term.second, mirrored, -1)) <= kAsymmetry * size;
  });
}

}  // namespace

std::vector<numbers::Vector> equations_in(const std::vector<Block>& blocks, int unknowns) {
  std::vector<numbers::Vector> equations;
  const auto index = [](int i) { return i; };
  for (const Block& block : blocks)
    for (int row = 0; row < block.size && !block.strict; ++row) {
      if (!element_of(block.terms, index, row, row, unknowns).isZero(0)) continue;
      for (int column = row + 1; column < block.size; ++column) {
        auto element = element_of(block.terms, index, row, column, unknowns);
        if (!element.isZero(0)) equations.push_back(std::move(element));
      }
    }
  return equations;
}

std::optional<AffineForm> symmetric_where(const AffineForm& form,
                                          const std::vector<numbers::Vector>& equations) {
  if (equations.empty() || !form.shape.is_square()) return std::nullopt;
  const AffineForm whole = expanded(form);
  const Eigen::Index m = equations.front().size() - 1;
  // The skew part of each element, as (e_0, ..., e_m), has to be in the span of the equations: what
  // its projection leaves is compared with rounding.
  numbers::Matrix E(m + 1, std::ssize(equations));
  for (Eigen::Index k = 0; k < E.cols(); ++k)
    E.col(k) = equations[static_cast<std::size_t>(k)].normalized();
  const Eigen::CompleteOrthogonalDecomposition<numbers::Matrix> span(E);
  const auto index = [](const AffineForm::Key& key) { return key.second; };
  for (int row = 0; row < form.shape.rows; ++row)
    for (int column = 0; column < row; ++column) {
      const numbers::Vector skew = element_of(whole.terms, index, row, column, m) -
                                   element_of(whole.terms, index, column, row, m);
      const numbers::Vector left = skew - E * span.solve(skew);
      if (!(left.cwiseAbs().maxCoeff() <= kAsymmetry * size_of(whole))) return std::nullopt;
    }
  AffineForm result{form.shape, {}};
  add_placed(result, whole, 0, 0, 0.5);
  add_placed(result, transposed(whole), 0, 0, 0.5);
  return result;
}

const model::Design::Unknown* needs_symmetric(const AffineForm& form, const Inequalities& of) {
  const AffineForm whole = expanded(form);
  Chosen chosen;
  for (const model::Design::Unknown& unknown : of.design().unknowns)
    if (unknown.structure == model::Structure::full && unknown.shape.is_square())
      chosen.push_back(&unknown);
  const auto suffices = [&](const Chosen& some) {
    return is_symmetric(with_symmetric(whole, of.unknowns, some));
  };
  if (suffices({}) || !suffices(chosen)) return nullptr;
  // One after the other is taken out; the first that is missed is needed.
  for (const model::Design::Unknown* unknown : Chosen(chosen)) {
    Chosen others = chosen;
    std::erase(others, unknown);
    if (!suffices(others)) return unknown;
    chosen = std::move(others);
  }
  return nullptr;
}

}  // namespace gainsmith::lmi
