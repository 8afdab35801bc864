// The best values of a few scalars, found outside the semidefinite programs.
#pragma once

#include "design/search_request.h"
#include "sdp/solver.h"
#include "search/known_values.h"

namespace gainsmith::design {

/// The design with the best figure of the request: the gains at the best values of `request.over`,
/// with the bracket of `request.extreme` when that is the figure. A value at which the problem is
/// infeasible, undecided, or refused by the method's assumptions is worse than every other. When
/// nothing feasible was found the verdict is undecided: that each value tried is infeasible says
/// nothing of those between. It is no where excluded_inequalities() are. Deterministic for any
/// number of threads.
/// What is in `known`, of an earlier search for the same, is not computed again, and what is
/// computed is added; the result does not depend on it.
/// InputError where the optimisation libraries are not installed.
model::Gains optimize(const model::Instance& own, const SearchRequest& request, unsigned threads,
                      const sdp::Options& solver, search::KnownValues& known);

/// The gains of a problem with everything that it wants searched: synthesize() for an empty
/// request, bisect() for one with a scalar to bisect alone, otherwise optimize().
model::Gains synthesize_searched(const model::Instance& own, const SearchRequest& request,
                                 unsigned threads, const sdp::Options& solver);

}  // namespace gainsmith::design
