// Several designs of one plant beside each other.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gainsmith/load.h"
#include "gainsmith/run_figure.h"
#include "drawing/figure.h"
#include "verify/replay.h"

namespace gainsmith::app {

/// Short names by which files are told apart: "a" of a.json, "out-a" of out-a/gains.json where both
/// are called so, otherwise the paths.
std::vector<std::string> names_of_files(const std::vector<std::string>& files);

/// A run of one of the designs.
struct DesignRun {
  std::string name;
  const model::Design* design = nullptr;
  const claims::RunSetup* setup = nullptr;
  DrawnRun run;
};

/// InputError, with the file as its place, for designs whose plants have other states than the first.
void require_same_plant(const std::vector<LoadedGains>& designs,
                        const std::vector<std::string>& files);

/// One picture: panels of one title are one, with the names of the designs before those of their
/// curves. What is the same in all, such as a plant that no observer drives, is drawn once.
drawing::Figure figure_of_designs(const std::vector<DesignRun>& runs,
                                 const std::function<RunView(const model::Design&)>& view);

}  // namespace gainsmith::app
