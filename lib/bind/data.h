// Internal to bind: dimensions, data, parameters, assumptions and unknowns.
#pragma once

#include "bind/binding.h"

namespace gainsmith::bind {

void bind_data(Binding& binding);

}  // namespace gainsmith::bind
