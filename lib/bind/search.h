// Internal to bind: what is searched, what is expected and what the command line asks for.
#pragma once

#include <optional>
#include <string>

#include "bind/binding.h"

namespace gainsmith::bind {

void bind_search(Binding& binding);
void bind_expectation(Binding& binding);
/// The figures that are shown for all observers side by side.
void bind_comparison(Binding& binding);

/// The event that a name means for an observer: its own, or one of all.
std::optional<std::size_t> find_event(const Binding& binding, const std::string& name,
                                      const std::string& observer);

}  // namespace gainsmith::bind
