// A problem with fewer or with relaxed requirements, as a problem of its own: it takes the same way
// to the solver as the original.
#pragma once

#include <map>
#include <set>
#include <string>

#include "model/problem.h"

namespace gainsmith::design {

/// The problem without gains (and so without bounds on them), nothing searched or expected.
model::Problem without_gains(const model::Problem& problem);

/// The problem without its objective: any solution will do.
model::Problem without_objective(model::Problem problem);

/// The problem with the requirements named, the others left out.
model::Problem with_requirements(model::Problem problem, const std::set<std::string>& names);

/// The problem with every requirement k of `scales` relaxed by an unknown slack t_k >= 0,
///   a < b   becomes   a < b + t_k s_k I
/// (each comparison of a chain), and minimize: the sum of the slacks. `slacks` receives the names
/// of the unknowns t_k by requirement.
model::Problem elastic(model::Problem problem, const std::map<std::string, double>& scales,
                       std::map<std::string, std::string>& slacks);

}  // namespace gainsmith::design
