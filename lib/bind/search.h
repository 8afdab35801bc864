// Internal to bind: what is searched, what is expected and what the command line asks for.
//
// A search is over scalars of the problem: the largest or smallest value of one for which gains
// exist, or the least of a figure over ranges.
#pragma once

#include <optional>
#include <string>

#include "bind/binding.h"

namespace gainsmith::bind {

/// Ranges that are negotiable, open or asked for, figures, and the search of the problem.
/// InputError for a range whose ends are not in order, where checks are made, and for a scalar that
/// is searched twice.
void bind_search(Binding& binding);
/// What a problem expects of verdict, status, values and runs.
void bind_expectation(Binding& binding);
/// The figures that are shown for all observers side by side.
void bind_comparison(Binding& binding);

/// The event that a name means for an observer: its own, or one of all.
std::optional<std::size_t> find_event(const Binding& binding, const std::string& name,
                                      const std::string& observer);

}  // namespace gainsmith::bind
