// Moves of a second run in its last places: two runs that round alike then differ by what jumps may
// round, and by what the dynamics make of that. simulate/last_places.h does so in careful runs.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/whole_number.h"
#include "hybrid/system.h"
#include "lanes/steps.h"
#include "packs/tolerances.h"

namespace gainsmith::packs {

/// Random numbers in [-1, 1), a function of the run and of how many were drawn (xorshift, Marsaglia
/// 2003).
class Moves {
 public:
  explicit Moves(std::uint64_t run = 0) : state_((run + 1) * 0x9e3779b97f4a7c15U) {}

  /// The high 52 bits as the mantissa of a number in [2, 4), less 3.
  double next() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 7;
    state_ ^= state_ << 17;
    return std::bit_cast<double>(state_ >> 12 | 0x4000000000000000U) - 3;  // 52 bits behind 2
  }

 private:
  std::uint64_t state_;  ///< not 0
};

/// The elements of the states that jumps alone set: flows make the others differ.
std::vector<std::size_t> set_by_jumps(const hybrid::System& system);

/// Moves these elements of the values of some lanes by up to kMoved of their size; whole numbers
/// are exact. `of`: the moves of a lane.
template <class Of>
void move_elements(const std::vector<std::size_t>& elements, std::uint32_t lanes_moved,
                   const Of& of, double* values) {
  for (; lanes_moved != 0; lanes_moved &= lanes_moved - 1) {
    const auto l = static_cast<std::size_t>(std::countr_zero(lanes_moved));
    Moves& moves = of(l);
    for (const std::size_t element : elements) {
      double& value = values[element * lanes::kLanes + l];
      if (!is_exact_whole(value)) value *= 1 + moves.next() * kMoved;
    }
  }
}

}  // namespace gainsmith::packs
