// Internal to bind: names under `data` and `parameters` that cannot be.
#pragma once

#include "bind/binding.h"

namespace gainsmith::bind {

/// InputError for a name that the method does not declare, with the nearest one, or where it
/// belongs.
void refuse_unknown_names(const Binding& binding);
/// InputError where the value of a datum uses data that the method declares after it.
void refuse_later_data(const Binding& binding, const model::Value& value);

}  // namespace gainsmith::bind
