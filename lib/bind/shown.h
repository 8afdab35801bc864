// Internal to bind: what a problem says of how its quantities are shown: units of elements, and the
// covariance that belongs to an estimate.
#pragma once

#include "bind/binding.h"

namespace gainsmith::bind {

/// InputError for `units` of a name that is none, or not as many as it has elements, and for
/// `covariance` of what is no column of states or signals, or that is not of its size. Names of
/// observers may be written with their observer or alone, for all that have them.
void check_shown(const Binding& binding);

}  // namespace gainsmith::bind
