// Internal to bind: plant, observers and events, outputs, signals and reports.
//
// Signals are named values along a run; a report has values of the design.
#pragma once

#include <optional>
#include <set>
#include <string>

#include "bind/binding.h"

namespace gainsmith::bind {

/// Binds the dynamics where the method has them, then the report. Adds states, signals and rates to
/// the scope running.
void bind_components(Binding& binding);

/// What no program asks for is left out; all texts are bound.
void finish_dynamics(Binding& binding);

/// The events at which alone the outputs and signals exist that a text reads; with `measured` those
/// of measurements.
std::set<std::size_t> events_read(const Binding& binding, const expr::Expression& text,
                                  bool measured = false);

/// InputError for a text that reads what is measured at another event than `at` alone.
void check_measured(const Binding& binding, const expr::Expression& text,
                    std::optional<std::size_t> at, const Place& place, const std::string& advice);

/// The index of a state; the number of states when it is none.
std::size_t state_of(const model::Design& design, const std::string& name);

}  // namespace gainsmith::bind
