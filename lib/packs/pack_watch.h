// On which sides of 0 the watched differences of one lane are, and what follows from it.
#pragma once

#include <cstdint>
#include <vector>

#include "packs/pack_system.h"

namespace gainsmith::packs {

enum class Truth : std::int8_t { no, unknown, yes };

/// By watch: -1, 0 or 1. 0: not known, of what moves; of what does not, exactly 0.
using Sides = std::vector<std::int8_t>;

/// `still`: only what does not move is known.
Truth truth(const WatchedCondition& condition, const std::vector<Watch>& watches,
            const Sides& sides, bool still = false);

/// Marks the watches of a condition.
void mark(const WatchedCondition& condition, std::vector<char>& marked);

}  // namespace gainsmith::packs
