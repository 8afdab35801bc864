// Units that a problem states, as they are shown.
#pragma once

#include <string>

#include "model/design.h"

namespace gainsmith::app {

/// "T2 [s]" where the problem states one unit for the name, otherwise the name.
std::string with_unit(const model::Design& design, const std::string& name);

}  // namespace gainsmith::app
