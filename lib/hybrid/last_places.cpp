#include "hybrid/last_places.h"

#include <bit>
#include <cmath>
#include <limits>

#include "hybrid/scenario.h"

namespace gainsmith::hybrid {

namespace {

/// More than what one result rounds: a twin is to differ by more than the errors that it shows.
constexpr double kMove = 8 * std::numeric_limits<double>::epsilon() / 2;

}  // namespace

LastPlaces::LastPlaces(std::uint64_t seed, std::uint64_t run, std::uint64_t draw)
    : random_(draw_stream(seed, run, Purpose::last_places, draw)) {}

double LastPlaces::of(double value, double size) const {
  if (!std::isfinite(size) || std::rint(value) == value) return 0;
  constexpr std::uint64_t kOdd = 0x9E3779B97F4A7C15;
  const std::uint64_t draw = std::bit_cast<std::uint64_t>(value) + kOdd * steps_;
  return random_.uniform_at(draw) < 0.5 ? -kMove * size : kMove * size;
}

}  // namespace gainsmith::hybrid
