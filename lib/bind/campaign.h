// Internal to bind: how to simulate.
#pragma once

#include "bind/binding.h"

namespace gainsmith::bind {

void bind_campaign(Binding& binding);

}  // namespace gainsmith::bind
