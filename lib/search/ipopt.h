// Ipopt's interior-point method for smooth programs.
#pragma once

#include "search/optimizers.h"

namespace gainsmith::search {

/// Ipopt with a quasi-Newton Hessian (limited memory) and its linear solver MUMPS; silent.
SmoothSolver ipopt_solver();

}  // namespace gainsmith::search
