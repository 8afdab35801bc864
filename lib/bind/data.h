// Internal to bind: dimensions, data, parameters, assumptions and unknowns.
#pragma once

#include <string>

#include "bind/binding.h"

namespace gainsmith::bind {

void bind_data(Binding& binding);

/// Asks it of the values now, and of all that come later. `text` is what messages say.
void add_assumption(Binding& binding, const model::Named& assumption, std::string text);

}  // namespace gainsmith::bind
