// More points for the inequalities that are imposed by exchange, an outer approximation of a
// semi-infinite program: the inequality holds at finitely many points of its domain, and points
// where its solution fails are added until it holds everywhere (Hettich & Kortanek 1993).
#pragma once

#include "design/attempt.h"

namespace gainsmith::design {

/// Adds to each exchange of the plan the worst points at which the attempt's point fails, and those
/// where its points draw together (forall/centres.h); false when there is none.
/// At most 24 points that fail are added at once, the worst first, and the centres.
bool grow(forall::Plan& plan, const lmi::Inequalities& inequalities, const lmi::Lmi& lmi,
          const Attempt& attempt);

/// Whether the largest margin at the points so far is below what points found in double could raise
/// above 0: more of them would be added without end.
bool is_out_of_reach(const Attempt& attempt);

}  // namespace gainsmith::design
