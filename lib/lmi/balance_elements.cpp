#include "lmi/balance_elements.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "base/stop.h"

namespace gainsmith::lmi {

namespace {

/// A coefficient in a block.
struct Coefficient {
  int unknown;
  int first_row;
  double weight;
  const Sparse* matrix;
};

}  // namespace

BalanceElements::BalanceElements(const std::vector<const Block*>& blocks, int unknowns,
                                 const std::vector<double>& objective) {
  constexpr double kLeast = 1e-290;  // units for less than this would not be doubles
  std::map<std::pair<std::string, int>, std::pair<int, int>> shared;  // first row, blocks
  // Blocks of one name and size have common rows; each of q such blocks counts as 1/q.
  for (const Block* block : blocks) {
    const auto [found, fresh] = shared.try_emplace({block->name, block->size}, rows_, 0);
    if (fresh) rows_ += block->size;
    ++found->second.second;
    first_rows_.push_back(found->second.first);
  }
  if (!objective.empty()) objective_ = rows_++;
  std::vector<Coefficient> coefficients;
  Eigen::Index most = 0;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const double weight = 1.0 / shared.at({blocks[k]->name, blocks[k]->size}).second;
    for (const auto& [i, matrix] : blocks[k]->terms) {
      coefficients.push_back({i, first_rows_[k], weight, &matrix});
      most += matrix.nonZeros() / 2 + matrix.rows();
    }
  }
  std::stable_sort(coefficients.begin(), coefficients.end(),
                   [](const auto& a, const auto& b) { return a.unknown < b.unknown; });
  elements_.reserve(static_cast<std::size_t>(most) + objective.size());
  auto next = coefficients.begin();
  for (int i = 0; i <= unknowns; ++i) {
    check_stop();
    starts_.push_back(parts_.size());
    for (; next != coefficients.end() && next->unknown == i; ++next) {
      parts_.push_back({elements_.size(), next->weight});
      for (int c = 0; c < next->matrix->outerSize(); ++c)
        for (Sparse::InnerIterator it(*next->matrix, c); it; ++it)
          if (it.row() >= c && std::abs(it.value()) >= kLeast)
            elements_.push_back({next->first_row + static_cast<int>(it.row()), next->first_row + c,
                                 std::log2(std::abs(it.value()))});
    }
    // Its unit, log2 s_c, enters with both rows: half of it is what is fitted.
    const double cost = i == 0 || objective.size() < static_cast<std::size_t>(i)
                            ? 0
                            : objective[static_cast<std::size_t>(i) - 1];
    if (cost == 0) continue;
    parts_.push_back({elements_.size(), 1});
    elements_.push_back({objective_, objective_, std::log2(std::abs(cost))});
  }
  starts_.push_back(parts_.size());
  parts_.push_back({elements_.size(), 1});
}

}  // namespace gainsmith::lmi
