// Internal to bind: claims, of each member of a family and of each observer that has their names.
//
//   nonincreasing   v never rises, along flows and over jumps
//   shrinks         v(end) <= factor v(start)
//   below, above    v against a bound that no run changes
//   cost            the sum of flow_cost along flows and jump_cost at jumps, against v(start)
#pragma once

#include "bind/binding.h"

namespace gainsmith::bind {

/// InputError for an event that is none, for a bound that changes along a run, and for a claim that
/// reads a measurement where it has no value.
void bind_claims(Binding& binding);

}  // namespace gainsmith::bind
