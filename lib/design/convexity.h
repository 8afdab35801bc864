// Whether the squares e'*Q*e of a design are convex: Q >= 0, without a tolerance. Their matrix
// inequalities say so too (bind/quadratic_forms.h), and would be infeasible for no other reason.
#pragma once

#include "model/instance.h"

namespace gainsmith::design {

/// InputError at the weight Q of a square that is not convex, or not known to be.
void require_convex(const model::Instance& instance);

}  // namespace gainsmith::design
