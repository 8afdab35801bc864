// What a number of violations says about the probability of one.
#pragma once

#include <cstdint>

namespace gainsmith::statistics {

/// The one-sided Clopper-Pearson bound: with probability `confidence` over the draws of the runs,
/// the probability of a violation is at most this p,
///     P(at most `violations` of `runs` | p) = 1 - confidence,
/// I_p(violations + 1, runs - violations) = confidence with the regularised incomplete beta
/// function: 1 - (1 - confidence)^(1/runs) without violations, and 1 when every run violates (or
/// there is no run).
double violation_probability_bound(std::uint64_t violations, std::uint64_t runs, double confidence);

/// The least number of runs of which none violates that bounds the probability of a violation by
/// this one: log(1 - confidence) / log(1 - probability), rounded up. Both in (0, 1).
std::uint64_t runs_for(double probability, double confidence);

}  // namespace gainsmith::statistics
