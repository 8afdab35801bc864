// Yes and no on the decimals as they are written.
//
// The inequalities B_k(x) = B_k0 + sum_i x_i B_ki > 0 (or >= 0), k the block, i = 1 ... m, have
// symmetric coefficients B_ki, n_k x n_k. A solver's answer has rounding errors. This folder
// decides what its answer proves of the decimals in the file.
//   yes    B_k at the printed x has a Cholesky factor with all errors subtracted (printed_check.h),
//          in double, then in 31 and 100 digits, for all values of the variables (margins.h)
//   no     multipliers Y_k >= 0 with sum_k <B_ki, Y_k> = 0 for i >= 1 (refutation.h): near those
//          of a solver in 31 or 100 digits (exact.h, exactness.h), on the boundary of the cone
//          (boundary_pair.h), by a root of a rational polynomial (algebraic_multipliers.h), or on
//          faces in fractions (faces.h)
//   bound  a lower bound of the objective by weak duality (weak_duality.h).
// What none of these shows stays open. Sources: Oettli & Prager 1964 (backward errors), Demmel 1989
// and Rump 2006 (proofs by Cholesky factors), Borwein & Wolkowicz 1981 (faces).
//
// In this file are blocks as fractions: what exact reductions rest on.
#pragma once

#include <utility>
#include <vector>

#include "lmi/block.h"
#include "lmi/inequalities.h"
#include "numbers/types/rational.h"
#include "verdict/exact.h"

namespace gainsmith::verdict {

/// B(x) = B_0 + sum_i x_i B_i without rounding; coefficients that are 0 have no entry.
struct RationalBlock {
  int size = 0;
  bool strict = true;
  /// B is what the file says. Otherwise it is what double makes of it, good for finding a point
  /// and for nothing else.
  bool exact = true;
  /// (i, B_i), size x size and symmetric, in the order of i.
  std::vector<std::pair<int, numbers::RationalMatrix>> terms;

  /// B(x), size x size; x_1 is x[0].
  numbers::RationalMatrix value(const std::vector<Rational>& x) const;
};

/// One for each block, in order. Not exact is a block that represents no point of its domain, and
/// one whose text has a value that is no fraction (numbers/types/rational.h).
std::vector<RationalBlock> rational_blocks(const lmi::Inequalities& of,
                                           const std::vector<lmi::Block>& blocks);

/// The rows `kept` in the units of a balance, where the block is number `at`.
ExactBlock<DoubleDouble> exact_block(const RationalBlock& block, const lmi::Balance& balance,
                                     std::size_t at, const std::vector<int>& kept);

/// Data and parameters; those that have no fraction are left out.
numbers::RationalValues rational_values(const model::Instance& instance);

/// The value of the text printed(value).
/// std::invalid_argument where the text is no number, as of an infinity.
Rational printed_fraction(double value);

}  // namespace gainsmith::verdict
