// What is said of single runs: how they ended, their claims, what is odd.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/instance.h"
#include "verify/replay.h"

namespace gainsmith::app {

/// How a run ended, and its claims.
std::string run_text(std::uint64_t seed, std::uint64_t run, const verify::Replay& replay);

/// The design's notes, and events that do not happen in runs that came to their ends; each once.
std::string notes_text(const model::Instance& instance, const std::vector<std::uint64_t>& runs,
                       const std::vector<verify::Replay>& replays);

}  // namespace gainsmith::app
