// What operations in each arithmetic count for, in the unit of base/stop.h.
#pragma once

#include <type_traits>

#include "base/scalars.h"
#include "base/stop.h"

namespace gainsmith::sdp {

/// In products with the halves of numbers apart (pairs.h), a tenth of what single operations take.
constexpr double kPairWork = kQuadWork / 10;

/// Counts multiplications with additions in T. Throws what spend() throws.
template <typename T>
void spend_on(double operations) {
  if constexpr (std::is_same_v<T, double>)
    spend(operations * kDoubleWork);
  else if constexpr (std::is_same_v<T, DoubleDouble>)
    spend(operations * kPairWork);
  else
    spend(operations * kWideWork);
}

}  // namespace gainsmith::sdp
