// Internal to bind: plant, observers and events, outputs, signals and reports.
#pragma once

#include <string>

#include "bind/binding.h"

namespace gainsmith::bind {

void bind_components(Binding& binding);

/// What no program asks for is left out; all texts are bound.
void finish_dynamics(Binding& binding);

/// The index of a state; the number of states when it is none.
std::size_t state_of(const model::Design& design, const std::string& name);

}  // namespace gainsmith::bind
