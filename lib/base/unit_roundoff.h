// What one operation of doubles rounds by at most, relative to its result.
#pragma once

namespace gainsmith {

constexpr double kUnitRoundoff = 0x1p-53;

}  // namespace gainsmith
