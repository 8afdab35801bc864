// Internal to bind: dimensions, data, parameters, assumptions and unknowns.
//
// Dimensions are learnt in the order of the declarations: a datum of shape n x p fixes n and p
// where they are not known, and is checked against them where they are.
#pragma once

#include "bind/binding.h"

namespace gainsmith::bind {

/// Fills the scopes known and design, and the values of data and parameters. InputError as of
/// bind().
void bind_data(Binding& binding);

}  // namespace gainsmith::bind
