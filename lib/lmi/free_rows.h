// Internal to lmi: the rows whose units nothing determines.
#pragma once

#include <vector>

#include "lmi/balance_elements.h"

namespace gainsmith::lmi {

/// The rows that nothing else determines. A change of all units that leaves every element as it is
/// satisfies  s_r + s_c = s_p + s_q  for the elements (r, c), (p, q) of one unknown and
/// s_r + s_c = 0 for those of the constant part. Each equation gives one row as a sum of whole
/// multiples of others wherever one of its factors is +-1, so that whole changes of the rows that
/// are left are whole changes of all. Equations without such a factor come last. Of the row of the
/// objective it is twice the unit that may change by a whole number.
///
/// Equations are solved in their own order, smallest first. Nearly all follow from few of them:
/// the search ends when every one does.
std::vector<int> free_rows(const BalanceElements& elements);

/// The same from all equations, one by one.
std::vector<int> free_rows_of_all(const BalanceElements& elements);

}  // namespace gainsmith::lmi
