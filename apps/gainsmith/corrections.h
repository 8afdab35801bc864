// Which measurement corrects which state of an observer.
#pragma once

#include <cstddef>
#include <vector>

#include "hybrid/system.h"
#include "verify/replay.h"

namespace gainsmith::app {

/// Columns of a run.
struct Correction {
  std::size_t measured = 0;
  std::size_t estimate = 0;

  bool operator==(const Correction&) const = default;
};

/// Of each difference y - h in the texts of the observers, where an element of an output or of
/// measured data is compared with one state alone: y(1) - xh(2). Differences that are not affine say
/// nothing, nor do outputs that are a state of the plant.
std::vector<Correction> corrections(const hybrid::System& system, const verify::Replay& replay);

}  // namespace gainsmith::app
