// Numbers that figures must bear.
#pragma once

#include <limits>

namespace gainsmith::drawing {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double largest = std::numeric_limits<double>::max();

}  // namespace gainsmith::drawing
