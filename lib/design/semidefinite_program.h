// The semidefinite program of a problem, for other solvers.
#pragma once

#include <string>
#include <vector>

#include "model/instance.h"
#include "sdp/problem.h"

namespace gainsmith::design {

struct SemidefiniteProgram {
  sdp::Problem problem;
  std::vector<std::string> remarks;  ///< how its x, objective and blocks follow from the problem's
};

/// The one that synthesize() solves first, in balanced units (see lmi/formulation.h). InputError
/// when there is none or not one alone.
/// Blocks F_0, ..., F_m of sum_i x_i F_i - F_0 >= 0 and c of c'x, as in SDPA files.
SemidefiniteProgram semidefinite_program(const model::Instance& instance);

}  // namespace gainsmith::design
