// What of dynamics and of their campaign has no effect, where that is sure.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "hybrid/scenario.h"
#include "hybrid/system.h"

namespace gainsmith::hybrid {

/// Events with a clock that is first due after the horizon, in every run.
std::vector<std::size_t> late_events(const System& system, const Scenario& scenario);

/// How many different runs there are: run k is run k modulo this number. 1: nothing is drawn, and
/// no list gives the runs different values. None: something is drawn at random.
std::optional<std::uint64_t> different_runs(const System& system, const Scenario& scenario);

}  // namespace gainsmith::hybrid
