// What runs: plant, observers, events, noise, claims, in mathematics.
#pragma once

#include <string>

#include "page/notation.h"

namespace gainsmith::page {

/// Plant, observers, events, inputs, noise, signals; nothing for a method without dynamics.
std::string dynamics(const model::Problem& problem, const Notation& notation);

/// The claims, and where runs start.
std::string claimed(const model::Problem& problem, const Notation& notation);

}  // namespace gainsmith::page
