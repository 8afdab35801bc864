// One name, one meaning: the names of a method do not clash.
#pragma once

#include "model/method.h"

namespace gainsmith::model {

/// InputError when two things of the method share a name, when a name is reserved (a function, I,
/// pi, a dimension), is none, or when flow or jump maps name no state.
void check_names(const Method& method);

}  // namespace gainsmith::model
