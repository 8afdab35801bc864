// NLopt's searches without derivatives, near a start and over a whole box.
#pragma once

#include "search/optimizers.h"

namespace gainsmith::search {

/// Nelder and Mead's simplex, which only compares values and so passes along the boundary of what
/// is feasible; then, in two dimensions and more, Powell's BOBYQA from the best point, which
/// follows a smooth valley to its end. Deterministic. Loads the library (InputError where it is
/// not there).
LocalSearch nlopt_search();

/// Price's controlled random search (CRS2 with local mutation): points all over the box, then ever
/// closer to the best of them. The start is one of them. The tolerance does not matter, and there
/// may be a few more evaluations than allowed. The same seed makes the same search, on any thread.
/// Loads the library.
LocalSearch nlopt_global_search(unsigned long seed);

}  // namespace gainsmith::search
