// Fills a semidefinite program X = sum x_i F_i - F_0 from blocks in balanced units.
#pragma once

#include <functional>
#include <vector>

#include "lmi/balance.h"
#include "sdp/problem.h"

namespace gainsmith::lmi {

class Assembler {
 public:
  Assembler(int variables, const Balance& balance);

  int add_block(int size, bool diagonal = false);

  /// B(x) in the rows `kept` as a new block; `at` is its place in the balance. Its constant part
  /// is multiplied by variable `constant` (0: by 1), its diagonals by `diagonal`.
  int add(const Block& block, std::size_t at, const std::vector<int>& kept, int constant,
          double diagonal);

  /// The coefficient of variable i (0: the constant) at one place of the upper triangle.
  void add_entry(int i, int block, int row, int column, double value);

  void set_cost(int i, double cost);

  /// The problem with entries of one place merged.
  sdp::Problem take();

 private:
  const Balance& balance_;
  sdp::Problem problem_;
};

std::vector<int> all_rows(const Block& block);

}  // namespace gainsmith::lmi
