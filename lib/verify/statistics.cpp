#include "verify/statistics.h"

#include <boost/math/special_functions/beta.hpp>

namespace gainsmith::verify {

double violation_probability_bound(std::uint64_t violations, std::uint64_t runs,
                                   double confidence) {
  if (violations >= runs) return 1;
  // P(at most k of n | p) = 1 - I_p(k + 1, n - k).
  const auto n = static_cast<double>(runs);
  const auto k = static_cast<double>(violations);
  return boost::math::ibeta_inv(k + 1, n - k, confidence);
}

}  // namespace gainsmith::verify
