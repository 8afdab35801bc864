// Runs as tables and pictures.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/json/json_text.h"
#include "verify/replay.h"

namespace gainsmith::app {

struct RunView;  // run_figure.h

/// A run of a campaign as CSV, with points of its flows as the integration went.
std::string run_csv(const verify::Setup& setup, const hybrid::Trajectory& run);

/// Columns t, j, event, variables, signals, claims; what is no number is an empty cell.
std::string events_csv(const verify::Replay& replay);
/// With the units of the columns, where some are stated.
io::Json events_json(const verify::Replay& replay, const RunView& view);

/// The run of that number, which is used and given back, as SVG (run_figure.h): the usual panels,
/// with the units and bands that the problem states.
std::string run_picture(const model::Design& design, const verify::Setup& setup,
                        std::uint64_t number, hybrid::Trajectory& run);

}  // namespace gainsmith::app
