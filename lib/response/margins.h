// How far a loop L, one input and one output, is from instability under u = -y.
#pragma once

#include <optional>

#include "response/sweep.h"

namespace gainsmith::response {

struct Margin {
  double value = 0;
  double frequency = 0;  ///< radians per unit of time
};

struct Margins {
  /// By which factor the gain may change until L is -1: the nearest to 1 in decibels.
  std::optional<Margin> gain;
  /// By how many degrees, in the direction in which it is least: positive where L lags before -180
  /// degrees.
  std::optional<Margin> phase;
  /// The shortest delay, in the unit of time, that turns L to -1.
  std::optional<Margin> delay;
  /// Whether L/(1 + L) is stable; the margins say nothing else where it is not.
  bool stable = false;
};

/// range_of() and the frequencies beyond it at which |L| becomes 1.
std::pair<double, double> range_with_crossover(const StateSpace& loop);

/// The crossings of |L| = 1 and of the negative real axis on that range, each found to the last
/// digits. At the frequencies 0 and infinity, and at half of the sampling frequency, L is real too.
Margins margins(const StateSpace& loop);

}  // namespace gainsmith::response
