// Blocks from the decimals of the file, as fractions: what exact reductions rest on.
#pragma once

#include <utility>
#include <vector>

#include "lmi/block.h"
#include "lmi/inequalities.h"
#include "numbers/rational.h"
#include "verdict/exact.h"

namespace gainsmith::verdict {

/// B(x) = B_0 + sum_i x_i B_i without rounding; coefficients that are 0 have no entry.
struct RationalBlock {
  int size = 0;
  bool strict = true;
  /// B is what the file says. Otherwise it is what double makes of it, good for finding a point
  /// and for nothing else.
  bool exact = true;
  std::vector<std::pair<int, numbers::RationalMatrix>> terms;

  numbers::RationalMatrix value(const std::vector<Rational>& x) const;
};

/// One for each block, in order. Not exact is a block that represents no point of its domain, and
/// one whose text has a value that is no fraction (numbers/rational.h).
std::vector<RationalBlock> rational_blocks(const lmi::Inequalities& of,
                                           const std::vector<lmi::Block>& blocks);

/// The rows `kept` in the units of a balance, where the block is number `at`.
ExactBlock<DoubleDouble> exact_block(const RationalBlock& block, const lmi::Balance& balance,
                                     std::size_t at, const std::vector<int>& kept);

/// Data and parameters; those that have no fraction are left out.
numbers::RationalValues rational_values(const model::Instance& instance);

/// The value of the text printed(value).
Rational printed_fraction(double value);

}  // namespace gainsmith::verdict
