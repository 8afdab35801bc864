// Runs as tables and pictures.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/json_text.h"
#include "verify/expected_run.h"
#include "verify/replay.h"

namespace gainsmith::app {

/// One run of a campaign as CSV, with points of its flows as the integration went.
std::string run_csv(const verify::Setup& setup, std::uint64_t seed, std::uint64_t run);

/// Columns t, j, event, variables, signals, claims; what is no number is an empty cell.
std::string events_csv(const verify::Replay& replay);
io::Json events_json(const verify::Replay& replay);

/// States with their estimates, errors and claims over time (SVG).
std::string run_figure(const std::string& title, const verify::Replay& replay);

/// The same of a run of a campaign, with what lies between the ends of its steps.
std::string run_picture(const std::string& title, const verify::Setup& setup, std::uint64_t seed,
                        std::uint64_t run);

/// Figures of observers side by side.
std::string comparison_text(const std::vector<verify::FoundFigure>& figures);

}  // namespace gainsmith::app
