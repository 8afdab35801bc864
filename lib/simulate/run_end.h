// What ends a run from within.
#pragma once

#include <stdexcept>
#include <string>

#include "hybrid/trajectory.h"

namespace gainsmith::simulate {

/// The run ends here. The message is without time and place of the run.
struct RunEnd : std::runtime_error {
  RunEnd(hybrid::Ending why, const std::string& message)
      : std::runtime_error(message), ending(why) {}
  hybrid::Ending ending;
};

}  // namespace gainsmith::simulate
