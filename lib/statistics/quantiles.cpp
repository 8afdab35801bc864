#include "statistics/quantiles.h"

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>

namespace gainsmith::statistics {

namespace {

/// P(B >= k) of a binomial B (n, p).
double at_least(std::uint64_t k, std::uint64_t n, double p) {
  if (k == 0) return 1;
  if (k > n) return 0;
  return boost::math::ibeta(static_cast<double>(k), static_cast<double>(n - k) + 1, p);
}

/// P(B < k).
double fewer(std::uint64_t k, std::uint64_t n, double p) {
  if (k == 0) return 0;
  if (k > n) return 1;
  return boost::math::ibetac(static_cast<double>(k), static_cast<double>(n - k) + 1, p);
}

/// The first of low, ..., high for which a condition is true; it is at high, and stays so.
template <class Condition>
std::uint64_t first_true(std::uint64_t low, std::uint64_t high, const Condition& condition) {
  while (low < high) {
    const std::uint64_t middle = low + (high - low) / 2;
    if (condition(middle))
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

}  // namespace

RankInterval rank_interval(std::uint64_t count, double probability, double confidence) {
  const double each = (1 - confidence) / 2;
  const std::uint64_t beyond = first_true(
      0, count + 1, [&](std::uint64_t k) { return fewer(k, count, probability) > each; });
  const std::uint64_t upper = first_true(
      0, count + 1, [&](std::uint64_t k) { return at_least(k, count, probability) <= each; });
  return {beyond - 1, upper};
}

Quantile quantile_of(const ValueSketch& values, double probability, double confidence,
                     std::uint64_t unknown) {
  Quantile quantile{probability, {}, {}, {}};
  const std::uint64_t count = values.count();
  if (count == 0) return quantile;
  const double place = probability * static_cast<double>(count);
  const auto rank = [&](double at) {
    return std::clamp<std::uint64_t>(static_cast<std::uint64_t>(at), 1, count);
  };
  const double first = values.ranked(rank(std::ceil(place))).middle();
  const double next = values.ranked(rank(std::floor(place) + 1)).middle();
  quantile.value = Enclosure{first, next}.middle();
  const RankInterval ranks = rank_interval(count + unknown, probability, confidence);
  if (ranks.lower > unknown) quantile.low = values.ranked(ranks.lower - unknown).low;
  if (ranks.upper <= count) quantile.high = values.ranked(ranks.upper).high;
  return quantile;
}

}  // namespace gainsmith::statistics
