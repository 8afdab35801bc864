#include "lmi/block.h"

#include <algorithm>
#include <cmath>

namespace gainsmith::lmi {

numbers::Matrix Block::value(const std::vector<double>& x) const {
  numbers::Matrix result = numbers::Matrix::Zero(size, size);
  for (const auto& [i, matrix] : terms)
    add_multiple(result, i == 0 ? 1.0 : x[static_cast<std::size_t>(i) - 1], matrix);
  return result;
}

bool is_homogeneous(const std::vector<Block>& blocks) {
  return std::all_of(blocks.begin(), blocks.end(),
                     [](const Block& block) { return block.constant_size == 0; });
}

namespace {

/// InputError when a product or sum of the data left the range of double.
void check_finite(const Sparse& matrix, const Place& place, const std::string& name) {
  for (int k = 0; k < matrix.outerSize(); ++k)
    for (Sparse::InnerIterator it(matrix, k); it; ++it)
      if (!std::isfinite(it.value()))
        throw InputError(place, "the inequality '" + name +
                                    "' has a coefficient that is not "
                                    "finite: its data are too large for double");
}

/// Makes a coefficient exactly symmetric; InputError when it is not so up to rounding.
Sparse symmetric_part(const Sparse& matrix, double scale, const Place& place,
                      const std::string& name) {
  if (is_symmetric(matrix)) return matrix;
  const Sparse mirrored = matrix.transpose();
  const Sparse difference = matrix - mirrored;
  for (int k = 0; k < difference.outerSize(); ++k)
    for (Sparse::InnerIterator it(difference, k); it; ++it)
      if (std::abs(it.value()) > 1e-12 * scale)
        throw InputError(place,
                         "the inequality '" + name + "' is not symmetric: elements (" +
                             std::to_string(it.row() + 1) + ", " + std::to_string(it.col() + 1) +
                             ") and (" + std::to_string(it.col() + 1) + ", " +
                             std::to_string(it.row() + 1) + ") differ; M + M' is written He(M)");
  return 0.5 * (matrix + mirrored);
}

}  // namespace

Block block_of(const AffineForm& form, std::string name, std::string point, bool strict,
               const Place& place) {
  Block block;
  block.name = std::move(name);
  block.point = std::move(point);
  block.strict = strict;
  block.size = form.shape.rows;
  if (block.size == 0) throw InputError(place, "the inequality '" + block.name + "' has no rows");
  for (const auto& [key, matrix] : form.terms) {
    check_finite(matrix, place, block.name);
    double& size = key.second == 0 ? block.constant_size : block.coefficient_size;
    size = std::max(size, largest_element(matrix));
  }
  const double scale = std::max(block.constant_size, block.coefficient_size);
  for (const auto& [key, matrix] : form.terms)
    block.terms.emplace_back(key.second, symmetric_part(matrix, scale, place, block.name));
  return block;
}

}  // namespace gainsmith::lmi
