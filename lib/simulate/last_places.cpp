#include "simulate/last_places.h"

#include <bit>
#include <cmath>

#include "base/whole_number.h"
#include "hybrid/scenario.h"
#include "hybrid/tolerances.h"

namespace gainsmith::simulate {

namespace {

/// More than what one result rounds, relative to the terms: the perturbed run is to differ by more
/// than the errors that it shows.
constexpr double size_of_move = hybrid::kTermRounding / 4;

}  // namespace

LastPlaces::LastPlaces(std::uint64_t seed, std::uint64_t run, std::uint64_t draw)
    : random_(hybrid::draw_stream(seed, run, hybrid::Purpose::last_places, draw)) {}

double LastPlaces::of(double value, double size) const {
  if (!std::isfinite(size) || is_exact_whole(value)) return 0;
  constexpr std::uint64_t odd = 0x9E3779B97F4A7C15;
  const std::uint64_t draw = std::bit_cast<std::uint64_t>(value) + odd * steps_;
  return random_.uniform_at(draw) < 0.5 ? -size_of_move * size : size_of_move * size;
}

}  // namespace gainsmith::simulate
