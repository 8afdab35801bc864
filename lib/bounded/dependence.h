// What depends on what among coordinates: which of them the functions need, and which are clocks.
#pragma once

#include <cstddef>
#include <string>

#include "bounded/coordinates.h"

namespace gainsmith::bounded {

/// The number of the slot of that name; the number of slots where there is none.
std::size_t index_of(const hybrid::StateLayout& layout, const std::string& name);

/// Drops the coordinates on which no function depends, neither itself nor through flows and jumps.
void keep_needed(Coordinates& coordinates);

/// Marks the coordinates whose derivative is constant and whose jumps depend on such ones alone.
void mark_clocks(Coordinates& coordinates);

}  // namespace gainsmith::bounded
