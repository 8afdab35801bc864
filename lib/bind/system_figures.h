// Internal to bind: the pictures of linear systems that a problem asks for.
#pragma once

#include "bind/binding.h"

namespace gainsmith::bind {

/// InputError for what moves in a run, a system of several inputs or outputs where one is wanted,
/// and two figures of one name.
void bind_system_figures(Binding& binding);

}  // namespace gainsmith::bind
