// What a command line says of the picture of runs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gainsmith/run_figure.h"

namespace gainsmith::app {

struct PictureOptions {
  std::string file;                 ///< --plot
  std::vector<std::string> planes;  ///< --phase x1,x2
  std::vector<std::string> bands;   ///< --band xh:P
  std::string panels;               ///< --panels x1,e,claims
  std::string runs;                 ///< --runs 0,3,17 or 0:9

  /// Whether something is asked for that only a picture shows.
  bool only_drawn() const;
};

/// What the problem says, changed as the options say. InputError, with the option as its place, for
/// texts of another form, and for a name twice. That the names are quantities is checked with the run.
RunView view_of(const PictureOptions& options, const model::Design& design);

/// The runs of --runs, or `otherwise` without it. InputError for texts of another form, a run twice
/// and more than a picture shows, or a comparison takes. A campaign with more runs has each of them.
std::vector<std::uint64_t> runs_of(const PictureOptions& options, bool compared,
                                   std::uint64_t otherwise);

}  // namespace gainsmith::app
