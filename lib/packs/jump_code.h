// The jumps of a System as code over lanes.
#pragma once

#include <cstddef>

#include "packs/pack_system.h"

namespace gainsmith::packs {

/// All values after the maps, then what must be 0: the parts of modes that are no whole numbers. `lost`: of the plant alone.
lanes::LaneCode jump_code(const PackSystem& pack, std::size_t event, bool lost);

}  // namespace gainsmith::packs
