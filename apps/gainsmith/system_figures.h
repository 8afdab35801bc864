// The pictures of linear systems that a problem asks for, and the numbers that one reads from them.
#pragma once

#include <string>
#include <vector>

#include "gainsmith/load.h"
#include "io/json_text.h"

namespace gainsmith::app {

/// A picture that is made.
struct SystemResult {
  std::string name;
  std::string svg;                 ///< empty: see `missing`
  std::vector<std::string> facts;  ///< a line each: margins, peaks, what a step does, modes
  std::string missing;             ///< why there is none: a gain has no value
  io::Json data;                   ///< the curves and the facts
};

/// The figures of the design with these names, or all in its order. InputError for a name that is
/// none, and at the place of a figure whose range or matrices are no numbers of use.
std::vector<SystemResult> system_results(const LoadedGains& loaded,
                                         const std::vector<std::string>& names = {});

}  // namespace gainsmith::app
