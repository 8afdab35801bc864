// Whole numbers that are exact: counts, modes and values that a text sets.
#pragma once

#include <cmath>

namespace gainsmith {

/// Whether x is a whole number, and small enough not to be one by rounding: of numbers beyond 2^52
/// all are whole, and of those beyond 2^32 more than one in a million.
inline bool is_exact_whole(double x) {
  constexpr double largest = 0x1p32;
  return std::abs(x) <= largest && std::rint(x) == x;
}

}  // namespace gainsmith
