// Where the points of an exchange draw together.
//
// At the solution of an inequality for all tau the multipliers are at the contact points t*,
// where the inequality holds with nothing to spare. The points t_k of an exchange lie around
// them and share their multipliers: to first order in t_k - t* the multipliers Y_k balance,
//   sum_k tr(Y_k) (t_k - t*) = 0,
// so the mean of neighbouring points, weighted by tr(Y_k), is t* up to the square of their
// distance, while the worst point for the unknowns at hand merely halves that distance.
#pragma once

#include <vector>

#include "forall/plan.h"

namespace gainsmith::forall {

/// The weighted means of the runs of two or more neighbouring points with multipliers, `sizes`
/// being tr(Y_k), one a point. None but for domains with one interval; points with different
/// elements of sets are no neighbours.
std::vector<Point> centres(const Imposed& imposed, const Domain& domain,
                           const std::vector<double>& sizes);

}  // namespace gainsmith::forall
