#include "linear/block.h"

#include "linear/error_graph.h"

namespace gainsmith::linear {

BlockBounds block_bounds(const LengthTable& table, std::size_t rank, bool constant,
                         std::int64_t flows) {
  const std::size_t count = rank + (constant ? 1 : 0);
  const auto n = static_cast<Eigen::Index>(count);
  numbers::Matrix M = numbers::Matrix::Zero(n, n), K = M;
  const double rounding =
      rounding_of_product(count) + 4 * (static_cast<double>(rank) + 2) * kUnitRoundoff;
  for (std::size_t i = 0; i < rank; ++i)
    for (std::size_t j = 0; j < count; ++j) {
      const LengthTable::Polynomial& function = table.functions[i * count + j];
      const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
      M(row, column) = function.size * kBoundSlack;
      K(row, column) = kBoundSlack * (function.error + rounding * function.size);
    }
  if (constant) M(n - 1, n - 1) = 1;
  BlockBounds bounds{numbers::Matrix::Identity(n, n), numbers::Matrix::Zero(n, n)};
  // |z| + rho + b grows by M + 2 K at most.
  numbers::Matrix size = bounds.growth, added = bounds.added;
  for (std::int64_t k = 0; k < flows; ++k) {
    added = M * added + K * size;
    size = (M + 2 * K) * size;
    bounds.growth = bounds.growth.cwiseMax(size);
    bounds.added = bounds.added.cwiseMax(added);
  }
  bounds.growth *= kBoundSlack;
  bounds.added *= kBoundSlack;
  return bounds;
}

}  // namespace gainsmith::linear
