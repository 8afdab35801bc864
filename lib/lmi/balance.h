// Units that suit blocks  B_k(x) = B_k0 + sum_i x_i B_ki:  powers of two s_kr for the rows of each
// block and d_i for the unknowns, with
//   S_k B_k(x) S_k = sum_i (x_i / d_i) (d_i S_k B_ki S_k),   S_k = diag(s_k),   d_0 = 1,
// such that the elements of the coefficients are as near to 1 as can be. The truth of B_k(x) > 0
// does not depend on them, and a solver's answer on the balanced blocks does not depend on the
// units of the problem (Curtis & Reid 1972, On the automatic scaling of matrices for Gaussian
// elimination).
//
//   minimise  sum over nonzero elements  w (log2 |B_ki[r,c]| + log2 s_kr + log2 s_kc + log2 d_i)^2
//
// The objective c'x is a row of its own. Blocks of one inequality and size share their rows' units;
// w is 1/(number of those blocks). Elements below 1e-8 in the units of a first pass do not count in
// the second, nor those below 1e-3 of that one in the third, unless nothing else is in their row
// or for their unknown: a plant that is sampled fast has couplings of 1e-10 that tell nothing of
// its units.
//
// Equivariant: other units that are powers of two give the same balanced numbers, bit for bit. So
// directions that nothing determines are pinned by the pattern alone, at rows whose whole changes
// are whole changes of all others, and exponents are rounded by floor(y + 0.5137): exact halves,
// which are common in data of whole numbers, must not fall to either side by a rounding of y.
#pragma once

#include <vector>

#include "lmi/block.h"

namespace gainsmith::lmi {

struct Balance {
  std::vector<std::vector<int>> rows;  ///< log2 s_kr, for each block
  std::vector<int> unknowns;           ///< log2 d_i of unknown i = 1..m at i - 1

  /// 2^(log2 s_kr + log2 s_kc + log2 d_i), with i = 0 the constant part.
  double factor(std::size_t block, int row, int column, int unknown) const;
  /// d_i, and s_kr.
  double unit(int unknown) const;
  double row(std::size_t block, int row) const;
};

/// `objective`: c, empty when there is none; it has at most `unknowns` elements.
Balance balance(const std::vector<const Block*>& blocks, int unknowns,
                const std::vector<double>& objective);

}  // namespace gainsmith::lmi
