// NLopt's searches without derivatives.
#pragma once

#include "search/optimizers.h"

namespace gainsmith::search {

/// Nelder and Mead's simplex, which only compares values and so passes along the border of what is
/// feasible; then, in two dimensions and more, Powell's BOBYQA from the best point, which follows a
/// smooth valley to its end. Deterministic. Loads the library (InputError where it is not there).
LocalSearch nlopt_search();

}  // namespace gainsmith::search
