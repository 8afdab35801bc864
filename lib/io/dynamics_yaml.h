// Internal to io: plant, observers, events, inputs and noise of a method.
#pragma once

#include "io/yaml.h"
#include "model/method.h"

namespace gainsmith::io {

/// The keys plant, observer, observers, timer, events, order, inputs, noise of a method.
/// InputError for what is none of their forms, and for a mixture of the short form (timer) with the
/// one with events.
void read_dynamics(const YamlFile& file, YamlMap& map, model::Method& method);

}  // namespace gainsmith::io
