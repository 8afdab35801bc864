// The jumps of a System as code over lanes.
#pragma once

#include <cstddef>

#include "packs/pack_system.h"

namespace gainsmith::packs {

/// Result 0: all values after the maps, `whole` of them. Result 1: what must be 0, the fractional
/// parts of modes. `lost`: the maps of the plant alone, where the event is lost to the observers.
/// All maps read the values before the jump; within one component a later pass reads those of the
/// pass before.
lanes::LaneCode jump_code(const PackSystem& pack, std::size_t event, bool lost);

}  // namespace gainsmith::packs
