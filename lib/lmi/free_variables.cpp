#include "lmi/free_variables.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include "lmi/correlation.h"

namespace gainsmith::lmi {

namespace {

/// The coefficient of scalar i in a block, or nullptr.
const Sparse* coefficient(const Block& block, int i) {
  const auto found =
      std::lower_bound(block.terms.begin(), block.terms.end(), i,
                       [](const auto& term, int wanted) { return term.first < wanted; });
  return found != block.terms.end() && found->first == i ? &found->second : nullptr;
}

/// +1 or -1 when the matrix is diagonal with elements of that sign, else 0.
double diagonal_sign(const Sparse& matrix) {
  double sign = 0;
  for (int k = 0; k < matrix.outerSize(); ++k) {
    for (Sparse::InnerIterator it(matrix, k); it; ++it) {
      const double found = it.value() > 0 ? 1 : -1;
      if (it.row() != it.col() || (sign != 0 && found != sign)) return 0;
      sign = found;
    }
  }
  return sign;
}

/// The common sign of all coefficients of scalar i, or 0.
double release_sign(const Lmi& lmi, int i) {
  double sign = 0;
  for (const Block& block : lmi.blocks) {
    const Sparse* matrix = coefficient(block, i);
    if (matrix == nullptr) continue;
    const double found = diagonal_sign(*matrix);
    if (found == 0 || (sign != 0 && found != sign)) return 0;
    sign = found;
  }
  return sign;
}

/// The rows of a block that stay when scalar i is free.
std::vector<int> without_rows(const Block& block, int i, std::vector<int> rows) {
  if (const Sparse* matrix = coefficient(block, i))
    std::erase_if(rows, [&](int row) { return matrix->coeff(row, row) != 0; });
  return rows;
}

std::vector<std::vector<int>> all_rows(const Lmi& lmi) {
  std::vector<std::vector<int>> kept;
  for (const Block& block : lmi.blocks) {
    kept.emplace_back(static_cast<std::size_t>(block.size));
    std::iota(kept.back().begin(), kept.back().end(), 0);
  }
  return kept;
}

/// The unit-free margin of the rows of a block.
double margin_of_rows(const numbers::Matrix& whole, const std::vector<int>& rows) {
  const numbers::Matrix part = whole(rows, rows);
  return correlation_margin(part);
}

/// The rows of each block that the search for one scalar examines.
using Rows = std::vector<std::vector<int>>;

void add_rows(const Rows& more, Rows& rows) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    rows[k].insert(rows[k].end(), more[k].begin(), more[k].end());
    std::sort(rows[k].begin(), rows[k].end());
  }
}

/// Whether each block that holds scalar i has at least half of `wanted`.
bool is_large_enough(const Lmi& lmi, int i, const Rows& rows, const std::vector<double>& wanted,
                     const std::vector<double>& x) {
  // Of the margin that the rows have without those of scalar i.
  constexpr double kShare = 0.5;
  for (std::size_t k = 0; k < lmi.blocks.size(); ++k)
    if (coefficient(lmi.blocks[k], i) != nullptr &&
        !(margin_of_rows(lmi.blocks[k].value(x), rows[k]) >= kShare * wanted[k]))
      return false;
  return true;
}

}  // namespace

bool FreeVariables::contains(int unknown) const {
  return std::any_of(list.begin(), list.end(),
                     [&](const FreeVariable& free) { return free.unknown == unknown; });
}

FreeVariables find_free_variables(const Lmi& lmi, const std::vector<Block>& others,
                                  bool objective) {
  FreeVariables result;
  result.kept = all_rows(lmi);
  for (int i = 1; i <= lmi.unknowns; ++i) {
    const bool elsewhere = std::any_of(others.begin(), others.end(), [&](const Block& block) {
      return coefficient(block, i) != nullptr;
    });
    const bool priced =
        objective && lmi.has_objective && lmi.objective[static_cast<std::size_t>(i) - 1] != 0;
    const double sign = release_sign(lmi, i);
    if (priced || elsewhere || sign == 0) continue;
    // The rows that stay without those of scalar i, and the rows that it takes out.
    std::vector<std::vector<int>> rest;
    std::vector<std::vector<int>> removed;
    for (std::size_t k = 0; k < lmi.blocks.size(); ++k) {
      const std::vector<int>& before = result.kept[k];
      rest.push_back(without_rows(lmi.blocks[k], i, before));
      std::set_difference(before.begin(), before.end(), rest.back().begin(), rest.back().end(),
                          std::back_inserter(removed.emplace_back()));
    }
    if (std::any_of(rest.begin(), rest.end(), [](const auto& rows) { return rows.empty(); }))
      continue;
    result.kept = std::move(rest);
    result.list.push_back({i, sign, std::move(removed)});
  }
  return result;
}

void restore(const Lmi& lmi, const FreeVariables& free_variables, const Balance& balance,
             std::vector<double>& x) {
  // Powers of two of the unknown's unit: from 1e-12 to 1e24 of it.
  constexpr int kSmallest = -40;
  constexpr int kLargest = 80;
  Rows rows = free_variables.kept;
  for (const FreeVariable& free : free_variables.list) {
    std::vector<double> wanted;
    for (std::size_t k = 0; k < lmi.blocks.size(); ++k)
      wanted.push_back(margin_of_rows(lmi.blocks[k].value(x), rows[k]));
    add_rows(free.rows, rows);
    double& value = x[static_cast<std::size_t>(free.unknown) - 1];
    for (int k = kSmallest; k <= kLargest; ++k) {
      value = free.sign * std::ldexp(balance.unit(free.unknown), k);
      if (is_large_enough(lmi, free.unknown, rows, wanted, x)) break;
    }
  }
}

}  // namespace gainsmith::lmi
