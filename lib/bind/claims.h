// Internal to bind: claims, of each member of a family and of each observer that has their names.
#pragma once

#include "bind/binding.h"

namespace gainsmith::bind {

void bind_claims(Binding& binding);

}  // namespace gainsmith::bind
