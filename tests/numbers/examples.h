// What the examples of the table of operations (expr/operations.def) stand on.
#pragma once

#include "numbers/types/real.h"

namespace gainsmith::numbers {

/// x in an example.
inline Values example_inputs() { return {{"x", (Matrix(2, 1) << 2, 3).finished()}}; }

}  // namespace gainsmith::numbers
