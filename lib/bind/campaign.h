// Internal to bind: how to simulate. A campaign is many runs of one hybrid system, each a function
// of the seed and its number.
#pragma once

#include "bind/binding.h"

namespace gainsmith::bind {

/// Horizon, runs, starts, laws of clocks and accuracy (model::Design::Campaign). InputError for a
/// value outside of its range, a state or an event that is none, and a campaign without a horizon.
void bind_campaign(Binding& binding);

}  // namespace gainsmith::bind
