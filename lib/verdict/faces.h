// Facial reduction: blocks B_k(x) >= 0 that no x satisfies with room to spare, on the affine space
// and the rows that all their solutions share (Borwein & Wolkowicz 1981).
//
// Multipliers Y_k >= 0, not all 0, with
//   sum_k <B_ki, Y_k> = 0 for all i >= 1,   v = -sum_k <B_k0, Y_k> >= 0
// say for every solution x that sum_k <B_k(x), Y_k> = -v:
//   v > 0, or a strict block with Y_k != 0   there is no solution
//   v = 0, only blocks with >=               B_k(x) Y_k = 0 for every solution
// The equations B_k(x) V = 0, the columns of V a basis of the range of Y_k, are linear in x: with
// them x = x_0 + N y, y some of the x. Where V has the identity in its rows P, and the equations
// hold, B_k >= 0 exactly when its rows and columns other than P are. So what is left is of the same
// kind, with fewer unknowns and rows: blocks G_k(y) on the rows that stay, and it begins again.
//
// Everything is in fractions: an equation is one of the file's decimals, and a chain of such steps
// that ends without a solution excludes the inequalities themselves. A diverging Y never does.
// Only exact blocks have multipliers; what they share, all solutions of all the blocks share.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "verdict/rational_blocks.h"

namespace gainsmith::verdict {

/// What an exact multiplier of one block says: the rows P, and V with the identity in them. Its
/// rows are counted in the rows that stay of the block.
struct FaceOfBlock {
  std::size_t block = 0;
  std::vector<int> pivots;
  numbers::RationalMatrix V;
};

/// Y_k = V_k S_k V_k' of the blocks of `faces`.
struct FaceMultipliers {
  std::vector<FaceOfBlock> faces;
  std::vector<numbers::RationalMatrix> S;  ///< one for each of them
};

/// The blocks on the affine space x = x_0 + N y after the steps so far. Always: blocks()[k] as a
/// function of y is B_k(x_0 + N y) on the rows that stay.
class Faces {
 public:
  /// `names` of the blocks, for why().
  /// Before any step: y = x, N = I, all rows stay.
  Faces(std::vector<RationalBlock> blocks, std::vector<std::string> names, int unknowns);

  /// Steps whose multipliers are read off the blocks: of a pair of blocks B and -c B, c > 0, Y =
  /// (c I, I); of a diagonal element that is 0 or a constant below it, Y = e e'. Until there are no
  /// more.
  void find_plain();

  /// What the next step is, for why().
  void note(std::string step) { steps_.push_back(std::move(step)); }
  /// The step of exact multipliers with v = 0, none of a strict block. Without S it is only
  /// guessed.
  void restrict_to(const FaceMultipliers& by);

  /// Sets those y to 0 on which, with the others, no block depends: solutions stay solutions.
  void drop_dependent();

  /// No x satisfies the blocks: by these exact multipliers.
  void exclude(const std::string& why, const FaceMultipliers& by);
  /// Nothing is left to choose, and a block is not as it must be.
  void exclude_numbers();

  bool excluded() const { return excluded_; }
  /// The multipliers of all steps, the columns of V in all rows of the blocks as they were given.
  /// The sums of a step are 0 modulo the equations B_k(x) V = 0 of the steps before. The last step
  /// has v > 0 or a strict block, or leaves equations without a solution.
  const std::vector<FaceMultipliers>& chain() const { return chain_; }
  /// "corner: element (2, 2) is 0 for all unknowns"; the steps so far, the last one first.
  std::string why() const;
  /// How many steps were made.
  std::size_t steps() const { return steps_.size(); }

  /// G_k of y, with the rows that stay.
  const std::vector<RationalBlock>& blocks() const { return blocks_; }
  const std::vector<std::string>& names() const { return names_; }
  /// The number of y.
  int unknowns() const { return static_cast<int>(free_.size()); }
  /// The unknowns x, counted from 1, that the y are.
  const std::vector<int>& free() const { return free_; }

  /// The equations so far, as they came: sum over (i, a) of a x_i = right, i counted from 1.
  struct Equation {
    std::vector<std::pair<int, Rational>> terms;
    Rational right;
  };
  const std::vector<Equation>& equations() const { return equations_; }

  /// x_0 + N y.
  std::vector<Rational> point(const std::vector<Rational>& y) const;
  /// x_0, m elements; N, m x unknowns().
  const std::vector<Rational>& origin() const { return origin_; }
  const numbers::RationalMatrix& directions() const { return directions_; }

 private:
  /// Whether a step of its kind was made, or excludes.
  bool find_pair();
  bool find_zero();
  bool pairs(std::size_t k, std::size_t l);
  /// Whether there is one more to drop: element (row, row) is 0; or it excludes the block.
  bool is_zero_diagonal(std::size_t k, int row);
  void keep(const numbers::RationalMatrix& equations);
  /// equations . (1, y) = 0; false when no y satisfies them.
  bool impose(const numbers::RationalMatrix& equations);
  /// `rows` count from 0 in the rows that stay.
  void drop_rows(std::size_t block, const std::vector<int>& rows);
  /// Adds a step to chain(), with V in all rows of the blocks as given.
  void record(FaceMultipliers by);

  std::vector<RationalBlock> blocks_;
  std::vector<std::vector<int>> kept_;  ///< the rows of each block that stay, from 0
  std::vector<std::string> names_;
  std::vector<int> free_;
  std::vector<Equation> equations_;
  std::vector<Rational> origin_;
  numbers::RationalMatrix directions_;
  std::vector<std::string> steps_;
  std::vector<FaceMultipliers> chain_;
  std::vector<int> sizes_;  ///< of the blocks as they were given
  bool excluded_ = false;
};

/// Whether the exact blocks are certainly as they must be at x.
bool satisfies(const std::vector<RationalBlock>& blocks, const std::vector<Rational>& x);

}  // namespace gainsmith::verdict
