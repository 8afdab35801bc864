// Stochastic arithmetic (Vignes 1993, CESTAC): what is computed is moved by random units in its
// last place. Two runs, of which one is moved, differ by what the dynamics make of rounding.
//
//   move = +-8 u size,   u = 2^-53, size: the sum of the absolute values of the terms
//
// The sign is a function of (seed, run, draw), the number of steps so far and the bits of the
// value: what is equal bit by bit at one time is moved alike, so that copies stay equal. A whole
// number is not moved, unless it is so large that rounding makes it one (base/whole_number.h).
#pragma once

#include <cstdint>

#include "base/random.h"

namespace gainsmith::simulate {

class LastPlaces {
 public:
  /// `draw`: one of the several moved runs of a run.
  LastPlaces(std::uint64_t seed, std::uint64_t run, std::uint64_t draw);

  /// A step has been taken.
  void next() { ++steps_; }
  /// How far a value of terms of this size is moved.
  double of(double value, double size) const;

 private:
  RandomStream random_;
  std::uint64_t steps_ = 0;
};

}  // namespace gainsmith::simulate
