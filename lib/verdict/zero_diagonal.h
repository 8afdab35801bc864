// A no that no multipliers show.
#pragma once

#include <optional>
#include <string>

#include "lmi/balance.h"
#include "lmi/compile.h"
#include "lmi/inequalities.h"

namespace gainsmith::verdict {

/// A block with >= has a diagonal element that is 0 for every x and in its row a constant that is
/// not: its name and the row, from 1. No multiplier shows this (the inequalities are only weakly
/// infeasible).
struct ZeroDiagonal {
  std::string inequality;
  int row = 0;
  int column = 0;
};
std::optional<ZeroDiagonal> find_zero_diagonal(const lmi::Inequalities& of, const lmi::Lmi& lmi,
                                               const lmi::Balance& balance);

}  // namespace gainsmith::verdict
