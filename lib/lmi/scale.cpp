#include "lmi/scale.h"

#include <algorithm>
#include <utility>

namespace gainsmith::lmi {

namespace {

/// The diagonal element (row, row) of a block as c x_q; none where another or no unknown is in it.
std::optional<std::pair<int, double>> alone_on_diagonal(const Block& block, int row) {
  std::optional<std::pair<int, double>> found;
  for (const auto& [i, matrix] : block.terms) {
    const double c = matrix.coeff(row, row);
    if (c == 0) continue;
    if (found) return std::nullopt;
    found = {i, c};
  }
  return found;
}

}  // namespace

std::optional<Scale> find_scale(const Lmi& lmi, const Unknowns& unknowns) {
  if (!is_homogeneous(lmi.blocks)) return std::nullopt;
  std::vector<Eigen::Index> elements(static_cast<std::size_t>(lmi.unknowns) + 1, 0);
  for (const Block& block : lmi.blocks)
    for (const auto& [i, matrix] : block.terms)
      elements[static_cast<std::size_t>(i)] += matrix.nonZeros();
  const auto is_number = [&](int i) {
    return std::any_of(unknowns.list().begin(), unknowns.list().end(), [&](const Unknown& unknown) {
      return unknown.first == i && unknown.shape.rows == 1 && unknown.shape.cols == 1;
    });
  };
  std::optional<Scale> best;
  for (std::size_t k = 0; k < lmi.blocks.size(); ++k)
    for (int row = 0; lmi.blocks[k].strict && row < lmi.blocks[k].size; ++row) {
      const auto found = alone_on_diagonal(lmi.blocks[k], row);
      if (!found || !is_number(found->first)) continue;
      const auto [i, c] = *found;
      if (best && elements[static_cast<std::size_t>(i)] <=
                      elements[static_cast<std::size_t>(best->unknown)])
        continue;
      best = Scale{i, c > 0 ? 1 : -1, k, row};
    }
  return best;
}

// Without the objective, and with scalars in place of products.
Lmi scaled(const Lmi& lmi, const Scale& scale) {
  Lmi result;
  result.unknowns = lmi.unknowns - 1;
  for (const Block& block : lmi.blocks) {
    Block& moved = result.blocks.emplace_back(block);
    moved.products.reset();
    moved.terms.clear();
    moved.constant_size = moved.coefficient_size = 0;
    for (const auto& [i, matrix] : block.terms) {
      const int number = scaled_number(i, scale);
      double& size = number == 0 ? moved.constant_size : moved.coefficient_size;
      size = std::max(size, numbers::Matrix(matrix).cwiseAbs().maxCoeff());
      if (number == 0)
        moved.terms.emplace(moved.terms.begin(), 0, Sparse(scale.sign * matrix));
      else
        moved.terms.emplace_back(number, matrix);
    }
  }
  return result;
}

}  // namespace gainsmith::lmi
