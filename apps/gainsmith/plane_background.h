// What a plane of two states of the plant shows behind the runs: its vector field, and the level
// curves of its claims.
#pragma once

#include "claims/run_setup.h"
#include "gainsmith/run_panels.h"

namespace gainsmith::app {

/// Adds to the panel of a plane whose axes are these two columns, where they are states of the plant
/// and its flow depends on its states alone:
///   - the field (x', y'),
///   - of a claim `below` or `above` about states of the plant, where its value is the bound,
///   - where there is none, of a claim `nonincreasing` about them, where its value is that at the
///     start of each run.
/// Other states of the plant are 0. With more than two states the field is left out where there is
/// no level curve, and the title says what the others are.
void add_background(const claims::RunSetup& setup, const std::vector<DrawnRun>& runs,
                    std::size_t across, std::size_t up, drawing::Panel& panel);

/// The two states of a plant that has no more, where a claim has level curves: the plane of the
/// usual picture.
std::optional<std::pair<std::string, std::string>> usual_plane(const claims::RunSetup& setup,
                                                               const verify::Replay& replay);

}  // namespace gainsmith::app
