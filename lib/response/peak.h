// The largest gain over all frequencies, the norm H-infinity, with a bracket that is proved.
#pragma once

#include <optional>

#include "response/frequency_response.h"

namespace gainsmith::response {

struct Peak {
  double value = 0;      ///< the largest singular value that was found
  double frequency = 0;  ///< there, radians per unit of time; infinite: beyond all bounds
  /// In ball arithmetic, of the matrices as they are in double: the gain at the frequency is at
  /// least `low`, and nowhere more than `high`. None where the proof fails.
  std::optional<double> low, high;
};

/// Of a stable system; nothing otherwise. The largest gain is followed by the level method of
/// Bruinsma and Steinbuch (Systems & Control Letters 14, 1990). `high` is 1e-6 above it, where the
/// bounded real lemma then holds with a P that solves its Riccati equation (theory: hinf-norm);
/// where it does not, 1e-5, 1e-4 or 1e-3 above it.
std::optional<Peak> peak(const StateSpace& system);

}  // namespace gainsmith::response
