// A problem with fewer requirements, as a problem of its own: it takes the same way to the solver
// as the original.
#pragma once

#include <functional>
#include <set>
#include <string>

#include "model/problem.h"

namespace gainsmith::design {

/// The problem with a changed copy of its method.
model::Problem with_method(model::Problem problem,
                           const std::function<void(model::Method&)>& change);

/// The problem without gains (and so without bounds on them), nothing searched or expected.
model::Problem without_gains(const model::Problem& problem);

/// The problem without its objective: any solution will do.
model::Problem without_objective(model::Problem problem);

/// The problem with the requirements named, the others left out.
model::Problem with_requirements(model::Problem problem, const std::set<std::string>& names);

}  // namespace gainsmith::design
