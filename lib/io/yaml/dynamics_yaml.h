// Internal to io: plant, observers, events, inputs and noise of a method.
#pragma once

#include "io/yaml/yaml.h"
#include "model/method.h"

namespace gainsmith::io {

/// The keys plant, observer, observers, timer, events, order, inputs, noise of a method. A timer is
/// an event (model::kTimerEvent), and `jump` what a component does at it. InputError for what is
/// none of their forms.
void read_dynamics(const YamlFile& file, YamlMap& map, model::Method& method);

}  // namespace gainsmith::io
