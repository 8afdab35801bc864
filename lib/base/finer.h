// What 31 digits leave of a number in 100, as doubles: with its two leading ones they add up to it.
// Ten doubles have 530 bits, enough for its 500.
#pragma once

#include <array>

namespace gainsmith {

using Finer = std::array<double, 8>;

}  // namespace gainsmith
