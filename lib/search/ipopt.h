// Ipopt's interior-point method for smooth programs.
#pragma once

#include "search/optimizers.h"

namespace gainsmith::search {

/// Loads the library (InputError where it is not there).
/// Ipopt with a quasi-Newton Hessian (limited memory) and the linear solver that it takes by
/// default (MUMPS in Debian's package); silent.
SmoothSolver ipopt_solver();

}  // namespace gainsmith::search
