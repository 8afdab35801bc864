#include "lmi/symmetry.h"

#include <algorithm>
#include <cmath>
#include <string>
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

bool is_symmetric(const AffineForm& form) {
  constexpr double kAsymmetry = 1e-12;
  double size = 0;
  for (const auto& [key, matrix] : form.terms) size = std::max(size, largest_element(matrix));
  return std::all_of(form.terms.begin(), form.terms.end(), [&](const auto& term) {
    const Sparse mirrored = term.second.transpose();
    return largest_element(sum_of(term.second, mirrored, -1)) <= kAsymmetry * size;
  });
}

}  // namespace

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
  for (const model::Design::Unknown* unknown : Chosen(chosen)) {
    Chosen others = chosen;
    std::erase(others, unknown);
    if (!suffices(others)) return unknown;
    chosen = std::move(others);
  }
  return nullptr;
}

}  // namespace gainsmith::lmi
