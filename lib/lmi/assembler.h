// Fills a semidefinite program X = sum x_i F_i - F_0 from blocks in balanced units. A block
// B_0 + sum_i y_i B_i >= 0 gives F_i = B_i and F_0 = -B_0; this sign is set here alone.
#pragma once

#include <vector>

#include "lmi/balance.h"
#include "sdp/problem.h"

namespace gainsmith::lmi {

/// The rows of a block that are solved, in balanced units: elements of the upper triangle.
struct BalancedBlock {
  struct Element {
    int unknown = 0;  ///< i; 0: of the constant part
    int row = 0;
    int column = 0;
    double value = 0;
    double rest = 0;  ///< what rounding to double took from it, where that is known
  };
  int size = 0;
  std::vector<Element> elements;
  std::vector<Finer> finer;  ///< what value + rest leave of each element; or empty
};

/// The rows `kept` of a block; `at` is its place in the balance.
BalancedBlock balanced(const Block& block, const Balance& balance, std::size_t at,
                       const std::vector<int>& kept);

/// Calls visit(unknown, row, column, value) for the same elements.
template <class Visit>
void for_each_balanced(const Block& block, const Balance& balance, std::size_t at,
                       const std::vector<int>& kept, Visit visit) {
  constexpr int kDropped = -1;
  std::vector<int> moved(static_cast<std::size_t>(block.size), kDropped);
  for (std::size_t k = 0; k < kept.size(); ++k)
    moved[static_cast<std::size_t>(kept[k])] = static_cast<int>(k);
  for (const auto& [i, matrix] : block.terms)
    for (int c = 0; c < matrix.outerSize(); ++c) {
      const int column = moved[static_cast<std::size_t>(c)];
      if (column == kDropped) continue;
      for (Sparse::InnerIterator it(matrix, c); it; ++it) {
        const auto r = static_cast<int>(it.row());
        const int row = moved[static_cast<std::size_t>(r)];
        if (row == kDropped || row > column) continue;
        visit(i, row, column, it.value() * balance.factor(at, r, c, i));
      }
    }
}

/// S B(x) S at the variables y of the program, the constant part times `one`.
numbers::Matrix value_of(const BalancedBlock& block, const std::vector<double>& y, double one);

/// Collects one problem in the variables 1 ... `variables`, which have the cost 0 at first.
class Assembler {
 public:
  explicit Assembler(int variables);

  /// A block without entries; returns its index.
  int add_block(int size, bool diagonal = false);

  /// B(x) as a new block. Its constant part is multiplied by variable `constant` (0: by 1), its
  /// diagonals by `diagonal`.
  int add(const BalancedBlock& block, int constant, double diagonal);

  /// The coefficient of variable i (0: the constant) at one place of the upper triangle.
  void add_entry(int i, int block, int row, int column, double value, double rest = 0,
                 const Finer* finer = nullptr);

  /// Of variable i, from 1.
  void set_cost(int i, double cost);

  /// The problem with entries of one place merged, in 31 digits, and without zeros. Only once.
  sdp::Problem take();

 private:
  sdp::Problem problem_;
};

/// 0, 1, ..., size - 1.
std::vector<int> all_rows(const Block& block);

}  // namespace gainsmith::lmi
