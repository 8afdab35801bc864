// Points between those of an exchange.
//
// An exchange ends with the few points that its unknowns needed one after the other. What excludes
// every solution needs more of them where functions of a high degree bend between points: a
// certificate at t_1, t_2, ... is one at more points too, and of these there may be better ones.
#pragma once

#include <vector>

#include "forall/plan.h"

namespace gainsmith::forall {

/// The middles of the wide gaps between neighbouring points: those above half of what equidistant
/// points as many would have. None but for domains with one interval; points with different
/// elements of sets are no neighbours.
std::vector<Point> midpoints(const Imposed& imposed, const Domain& domain);

}  // namespace gainsmith::forall
