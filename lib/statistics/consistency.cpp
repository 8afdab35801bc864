#include "statistics/consistency.h"

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>
#include <limits>

#include "base/words.h"

namespace gainsmith::statistics {

std::string to_string(Fit fit) {
  return word_of<Fit::undecided>(fit,
                                 {"consistent", "too optimistic", "too pessimistic", "undecided"});
}

void SquaredErrors::add(const claims::Squares& run) {
  count += run.count;
  improper += run.improper;
  // Finite squares may have an infinite sum.
  sum.add(std::min(run.sum, std::numeric_limits<double>::max()));
}

void SquaredErrors::add(const SquaredErrors& more) {
  count += more.count;
  improper += more.improper;
  sum.add(more.sum);
}

Consistency consistency_of(const SquaredErrors& errors, double probability) {
  Consistency found;
  found.probability = probability;
  if (errors.count == 0) return found;
  // The chi-square distribution of d degrees at x is P(d/2, x/2), the incomplete gamma function.
  const auto count = static_cast<double>(errors.count);
  const double shape = static_cast<double>(errors.elements) * count / 2;
  const double each = (1 - probability) / 2;
  found.mean = errors.sum.value() / count;
  found.low = 2 * boost::math::gamma_p_inv(shape, each) / count;
  found.high = 2 * boost::math::gamma_q_inv(shape, each) / count;
  if (errors.improper > 0) return found;
  found.fit = found.mean > found.high  ? Fit::too_optimistic
              : found.mean < found.low ? Fit::too_pessimistic
                                       : Fit::consistent;
  return found;
}

}  // namespace gainsmith::statistics
