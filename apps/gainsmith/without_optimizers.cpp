// Part of the static program.
#include "gainsmith/optimizers.h"

namespace gainsmith::app {

const search::Optimizers* linked_optimizers() { return nullptr; }

}  // namespace gainsmith::app
