// Free variables: scalars that cost nothing and only help. x_i has cost 0 and every coefficient B_i
// is diagonal with elements of one sign, so that sending x_i to +-infinity satisfies the rows where
// B_i is not zero. Example: g of [P, Y; *, g I] > 0 when g has no price. With them the dual has no
// interior and a solver stalls; without them and their rows the problem is the same:
//   [ M , N ; N' , x_i D ] >= 0 for some x_i, D > 0   <=>   M >= 0 (up to its closure).
#pragma once

#include <vector>

#include "lmi/balance.h"
#include "lmi/compile.h"

namespace gainsmith::lmi {

struct FreeVariable {
  int unknown = 0;  ///< i
  double sign = 1;  ///< towards +infinity or -infinity
  /// For each block of the Lmi the rows that it takes out, in order.
  std::vector<std::vector<int>> rows;
};

struct FreeVariables {
  std::vector<FreeVariable> list;
  /// For each block of the Lmi the rows that stay, in order.
  std::vector<std::vector<int>> kept;

  bool contains(int unknown) const;
};

/// The scalars that are free; what would, with those before it, leave a block without rows is not.
/// Scalars that occur in one of the `others` (bounds on gains) are not, nor those that have a price
/// when the `objective` counts.
FreeVariables find_free_variables(const Lmi& lmi, const std::vector<Block>& others, bool objective);

/// Gives the free scalars of x a size, one after the other: in each block that holds one, the
/// rows that stay, those of the ones before it and its own must have half the unit-free margin
/// (correlation.h) that they have without its own. Found by doubling from 2^-40 of the unknown's
/// unit d_i, so that it does not depend on units; left at 2^80 of it when that does not happen: the
/// margins then show it.
void restore(const Lmi& lmi, const FreeVariables& free_variables, const Balance& balance,
             std::vector<double>& x);

}  // namespace gainsmith::lmi
