// A frequency response over a range, as densely as it bends.
#pragma once

#include <utility>
#include <vector>

#include "response/frequency_response.h"

namespace gainsmith::response {

struct Sweep {
  std::vector<double> frequency;  ///< ascending, radians per unit of time
  std::vector<ComplexMatrix> response;
};

/// From a tenth of the slowest pole or zero to ten times the fastest one, those at 0 aside; of a
/// sampled system to half of the sampling frequency. Of one without any: from 0.01 to 100.
std::pair<double, double> range_of(const StateSpace& system);

/// Neighbours are so near that between them the logarithm of each element of H, size and phase, is
/// linear in log w to 0.01: 0.1 dB, 0.6 degrees; at a resonance or a notch as near as 1e-7 of w. A
/// pole on the axis is left out. 0 < low < high, which are the first and last frequencies; beyond
/// 20 000 points the grid of 20 a decade is refined no further.
Sweep sweep(const StateSpace& system, double low, double high);

/// The phase of element (i, j) in degrees, one a frequency, without jumps: neighbours differ by at
/// most 180. Where the size begins as w^k it begins within half a turn of 90 k, as at -270 of 1/s^3;
/// elsewhere in (-180, 180].
std::vector<double> phase(const Sweep& sweep, Eigen::Index i, Eigen::Index j);

}  // namespace gainsmith::response
