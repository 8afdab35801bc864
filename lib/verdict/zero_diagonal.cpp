#include "verdict/zero_diagonal.h"

#include <algorithm>
#include <cmath>

#include "verdict/exact.h"

namespace gainsmith::verdict {

std::optional<ZeroDiagonal> find_zero_diagonal(const lmi::Inequalities& of, const lmi::Lmi& lmi,
                                               const lmi::Balance& balance) {
  std::optional<ExactBlocks<Decimal100>> exact;
  for (std::size_t k = 0; k < lmi.blocks.size(); ++k) {
    const lmi::Block& block = lmi.blocks[k];
    if (!block.where) continue;
    for (int row = 0; row < block.size; ++row) {
      const bool zero = std::all_of(block.terms.begin(), block.terms.end(), [&](const auto& term) {
        return term.second.coeff(row, row) == 0;
      });
      if (!zero) continue;
      if (!exact) exact.emplace(of, balance);
      const ExactBlock<Decimal100> known = exact->block(block, k, all_rows(block));
      // The element (row, column) is certainly the same constant other than 0 for every x.
      for (int column = 0; column < block.size; ++column) {
        bool vanishes = true;
        bool constant = false;
        for (const auto& [i, elements] : known.terms) {
          const numbers::Enclosed<Decimal100> B = dense(elements, known.size);
          vanishes &= B.ball(row, row).is_zero();
          if (i == 0)
            constant = std::abs(static_cast<double>(as<double>(B.mid(row, column)))) * (1 - 1e-12) >
                       B.rad(row, column);
          else
            vanishes &= B.ball(row, column).is_zero();
        }
        if (column != row && vanishes && constant)
          return ZeroDiagonal{block.name, row + 1, column + 1};
      }
    }
  }
  return std::nullopt;
}

}  // namespace gainsmith::verdict
