#include "statistics/sample_bounds.h"

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>

namespace gainsmith::statistics {

double violation_probability_bound(std::uint64_t violations, std::uint64_t runs,
                                   double confidence) {
  if (violations >= runs) return 1;
  // P(at most k of n | p) = 1 - I_p(k + 1, n - k).
  const auto n = static_cast<double>(runs);
  const auto k = static_cast<double>(violations);
  return boost::math::ibeta_inv(k + 1, n - k, confidence);
}

std::uint64_t runs_for(double probability, double confidence) {
  const double runs = std::log1p(-confidence) / std::log1p(-probability);
  auto least = static_cast<std::uint64_t>(std::max(std::floor(runs), 1.0));
  while (violation_probability_bound(0, least, confidence) > probability) ++least;
  return least;
}

}  // namespace gainsmith::statistics
