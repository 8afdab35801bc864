// Where the lengths of the sampling intervals come from.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/random.h"
#include "base/sine.h"
#include "hybrid/system.h"

namespace gainsmith::hybrid {

/// The length of the law `sinusoid` at time t, of sine(t / high).
inline double sinusoid_of(double sine, double low, double high) {
  return std::min(std::max((high - low) / 2 * sine + (high + low) / 2, low), high);
}

/// A sampling law with its numbers, for reset values in [low, high].
struct Law {
  model::LawKind kind = model::LawKind::uniform;
  double low = 0;
  double high = 0;
  std::vector<double> values;  ///< constant, list

  /// The timer's reset value at jump number `jump` (0, 1, ...) at time t. uniform and extremes take
  /// one draw; the others take none.
  double reset_value(std::size_t jump, double t, RandomStream& random) const;
};

/// Laws of a campaign for lengths in [low, high], in order. Without any: uniform, extremes and
/// constant high; where low > 0 also sinusoid and constant low. InputError for a value outside
/// [low, high] (1e-12 high is forgiven as rounding) and for a constant or list without a value.
std::vector<Law> make_laws(const std::vector<model::Design::Law>& given, double low, double high,
                           const System& system);

}  // namespace gainsmith::hybrid
