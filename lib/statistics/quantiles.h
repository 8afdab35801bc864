// Quantiles with intervals that hold for every distribution.
//
// X_(1) <= ... <= X_(n) are the values of n independent runs, B is binomial (n, p), and x_p a
// p-quantile, P(X < x_p) <= p <= P(X <= x_p). Whatever the distribution, discrete ones too,
//
//   P(x_p < X_(l)) = P(fewer than l values <= x_p) <= P(B < l)
//   P(x_p > X_(u)) = P(u values or more < x_p)     <= P(B >= u)
//
// So [X_(l), X_(u)], with l the largest and u the smallest rank for which the right sides are at
// most (1 - confidence)/2, holds x_p with that confidence (David and Nagaraja, Order Statistics,
// 7.1). Where runs take laws or starts in turn the values are independent, but not of one
// distribution. If each has the same number of runs, the count of values <= x_p of their mixture
// lies nearer to n p than B does (Hoeffding 1956), and the interval is only more cautious.
#pragma once

#include <cstdint>
#include <optional>

#include "statistics/value_sketch.h"

namespace gainsmith::statistics {

/// Ranks l and u. 0 and count + 1 represent minus and plus infinity: there are too few runs.
struct RankInterval {
  std::uint64_t lower = 0;
  std::uint64_t upper = 0;
};
/// Probability and confidence in (0, 1).
RankInterval rank_interval(std::uint64_t count, double probability, double confidence);

struct Quantile {
  double probability = 0;
  /// X_(ceil(p n)), or the mean of X_(p n) and X_(p n + 1) where p n is whole; none of no values.
  std::optional<double> value;
  std::optional<double> low, high;  ///< none: no value of so few runs is known to be beyond it
};

/// Of a sketch that is not exact the interval is as wide as the enclosures of its ends need.
/// `unknown`: values more, which may lie anywhere: the interval holds for all, the value is of the others.
Quantile quantile_of(const ValueSketch& values, double probability, double confidence,
                     std::uint64_t unknown = 0);

}  // namespace gainsmith::statistics
