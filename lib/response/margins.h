// How far a loop L, one input and one output, is from instability under u = -y.
//
//   gain    k with k L(i w) = -1:         k = -1/L(i w) where L(i w) is real and negative
//   phase   arg(-L(i w)) where |L(i w)| = 1, in (-180, 180] degrees
//   delay   arg(-L(i w))/w there, with the angle in [0, 2 pi)
//
// Of several crossings the nearest to instability counts. Of a sampled loop z = exp(i w T).
#pragma once

#include <optional>

#include "response/sweep.h"

namespace gainsmith::response {

struct Margin {
  double value = 0;
  double frequency = 0;  ///< radians per unit of time
};

struct Margins {
  /// By which factor the gain may change until L is -1: the nearest to 1 in decibels. None where L
  /// is nowhere real and negative.
  std::optional<Margin> gain;
  /// By how many degrees, in the direction in which it is least: positive where L lags before -180
  /// degrees. None, as of the delay, where |L| is nowhere 1.
  std::optional<Margin> phase;
  /// The shortest delay, in the unit of time, that turns L to -1.
  std::optional<Margin> delay;
  /// Whether L/(1 + L) is stable; the margins say nothing else where it is not.
  bool stable = false;
};

/// The lowest and highest frequency: range_of(), extended by up to 15 decades on each side to where
/// |L| becomes 1. A sampled loop ends at half of its sampling frequency.
std::pair<double, double> range_with_crossover(const StateSpace& loop);

/// The crossings of |L| = 1 and of the negative real axis on that range, each found to the last
/// digits. At the frequencies 0 and infinity, and at half of the sampling frequency, L is real too.
Margins margins(const StateSpace& loop);

}  // namespace gainsmith::response
