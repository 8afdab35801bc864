// A semidefinite program in the SDPA standard form:
//   primal:  minimise c'x        subject to  X = sum_i x_i F_i - F_0 >= 0
//   dual:    maximise F_0 . Y    subject to  F_i . Y = c_i (i = 1..m),  Y >= 0
// over block-diagonal symmetric matrices; a diagonal block is a set of linear inequalities. F . Y
// is trace(F Y). For feasible x and Y weak duality says c'x - F_0 . Y = X . Y >= 0. Other rooms
// state matrix inequalities as the primal and sums of squares as the dual.
#pragma once

#include <vector>

#include "base/finer.h"

namespace gainsmith::sdp {

/// One block: `size` rows. A dense symmetric block has size(size+1)/2 free entries, a diagonal one
/// has `size`.
struct Block {
  int size = 0;
  bool diagonal = false;

  bool operator==(const Block&) const = default;
};

/// One entry of a symmetric F_i: rows and columns count from 0 and row <= column; an off-diagonal
/// entry represents both of its mirror places (the value is that of one place, as in SDPA files).
/// `rest` is what rounding to double took from the number as written (0 where nothing is known):
/// ill posed problems have another answer without it. Arithmetics wider than double use value +
/// rest, 100 digits also Problem::finer.
struct Entry {
  int block = 0;  ///< index in Problem::blocks
  int row = 0;
  int column = 0;
  double value = 0;
  double rest = 0;
  int finer = 0;  ///< place in Problem::finer, from 1; 0: none

  bool operator==(const Entry&) const = default;
};

struct Problem {
  std::vector<Block> blocks;
  std::vector<double> c;              ///< m costs
  std::vector<double> c_rest;         ///< as Entry::rest; empty means zeros
  std::vector<std::vector<Entry>> f;  ///< f[0] = F_0, f[i] = F_i for i = 1..m

  std::vector<Finer> finer;  ///< what value + rest leave of entries

  int m() const { return static_cast<int>(c.size()); }
};

/// Throws std::invalid_argument unless `problem` is well formed: f has m + 1 lists, blocks have
/// positive sizes, entries lie in the upper triangle of their block (on the diagonal of a diagonal
/// one), values and costs are finite, Entry::finer is a place, c_rest is empty or has m entries.
void validate(const Problem& problem);

}  // namespace gainsmith::sdp
