// The pictures of linear systems that a problem asks for, and the numbers that one reads from them.
#pragma once

#include <string>
#include <vector>

#include "gainsmith/load.h"
#include "io/json/json_text.h"
#include "drawing/figure.h"

namespace gainsmith::app {

/// A number that one reads from a picture, by which designs are compared.
struct SystemNumber {
  std::size_t design = 0;
  std::string what;  ///< "loop, P*K: phase margin"
  double value = 0;
};

/// A picture that is made.
struct SystemResult {
  std::string name;
  drawing::Figure figure;           ///< without panels: see `missing`
  std::vector<std::string> facts;  ///< a line each: margins, peaks, what a step does, modes
  std::vector<SystemNumber> numbers;
  std::string missing;  ///< why there is none: a gain has no value
  io::Json data;        ///< the curves and the facts
};

/// The figures of the first design with these names, or all in its order; those of the others with
/// the same name and kind are drawn in the same picture, but scans and bands in one for each
/// design. InputError for a name that is none, and at the place of a figure whose range or matrices
/// are no numbers of use.
std::vector<SystemResult> system_results(const std::vector<NamedDesign>& designs,
                                         const std::vector<std::string>& names = {});

}  // namespace gainsmith::app
