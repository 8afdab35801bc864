// On which sides of 0 the watched differences of one lane are, and what follows from it.
#pragma once

#include <cstdint>
#include <vector>

#include "packs/pack_system.h"

namespace gainsmith::packs {

/// By watch: -1, 0 or 1. 0: not known, of what moves; of what does not, exactly 0.
using Sides = std::vector<std::int8_t>;

/// What is said of that which moves and is not known to be above or below 0.
enum class Zeros : std::uint8_t {
  unknown,
  exact,  ///< it is 0
  still   ///< nothing, and nothing of all else that moves
};

/// The truth of a condition for these sides. It is unknown where a comparison of it hangs on a side
/// that is 0 of a difference that moves, unless the other parts decide.
Truth truth(const WatchedCondition& condition, const std::vector<Watch>& watches,
            const Sides& sides, Zeros zeros = Zeros::unknown);

/// Marks the watches of a condition.
void mark(const WatchedCondition& condition, std::vector<char>& marked);

}  // namespace gainsmith::packs
