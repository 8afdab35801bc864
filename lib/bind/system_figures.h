// Internal to bind: the pictures of linear systems that a problem asks for, such as poles or
// frequency responses.
#pragma once

#include "bind/binding.h"

namespace gainsmith::bind {

/// Pictures of linear systems over data, gains and unknowns (model::SystemFigure). InputError for
/// what moves in a run, and for a system of several inputs or outputs where one is wanted.
void bind_system_figures(Binding& binding);

}  // namespace gainsmith::bind
