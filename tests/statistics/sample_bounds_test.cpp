#include "statistics/sample_bounds.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gainsmith::statistics {
namespace {

/// P(at most k of n | p), term by term.
double binomial(int k, int n, double p) {
  double sum = 0;
  for (int i = 0; i <= k; ++i)
    sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(i + 1.0) - std::lgamma(n - i + 1.0) +
                    i * std::log(p) + (n - i) * std::log1p(-p));
  return sum;
}

TEST(Statistics, NoViolationHasTheClosedForm) {
  EXPECT_NEAR(violation_probability_bound(0, 10000, 0.95), 1 - std::pow(0.05, 1e-4), 1e-16);
  EXPECT_DOUBLE_EQ(violation_probability_bound(0, 1, 0.95), 0.95);
  // 1 - exp(x) = -x (1 + x/2 + ...) where runs are many.
  const double x = std::log(0.05) / 1e15;
  EXPECT_NEAR(violation_probability_bound(0, 1000000000000000, 0.95) / -x, 1 + x / 2, 1e-14);
}

TEST(Statistics, RunsForAProbabilityAreTheFewest) {
  for (const auto& [probability, confidence] :
       {std::pair{1e-3, 0.999}, {1e-4, 0.9999}, {0.5, 0.5}, {0.3, 0.95}, {1e-9, 0.95}}) {
    const std::uint64_t runs = runs_for(probability, confidence);
    EXPECT_LE(violation_probability_bound(0, runs, confidence), probability);
    if (runs == 1) continue;
    EXPECT_GT(violation_probability_bound(0, runs - 1, confidence), probability);
  }
  EXPECT_EQ(runs_for(1e-3, 0.999), 6905U);
  EXPECT_EQ(runs_for(1e-4, 0.9999), 92099U);
}

TEST(Statistics, BoundSolvesTheBinomialEquation) {
  for (const auto& [k, n] :
       {std::pair{1, 10}, {3, 1000}, {999, 1000}, {400, 1000}, {9, 10}, {2, 1000000}}) {
    const double bound = violation_probability_bound(static_cast<std::uint64_t>(k),
                                                     static_cast<std::uint64_t>(n), 0.95);
    // The logarithms of the factorials cancel, so their rounding grows with n.
    EXPECT_NEAR(binomial(k, n, bound), 0.05, 1e-10 + 1e-15 * n) << k << " of " << n;
  }
}

TEST(Statistics, NothingIsExcludedWhenAllRunsViolate) {
  EXPECT_EQ(violation_probability_bound(10, 10, 0.95), 1);
  EXPECT_EQ(violation_probability_bound(0, 0, 0.95), 1);
}

/// All runs but one: 1 - p^n = 1 - confidence.
TEST(Statistics, AllButOneHasTheClosedForm) {
  for (const double confidence : {0.5, 0.95, 0.999}) {
    for (const int n : {2, 10, 1000}) {
      const double bound = violation_probability_bound(static_cast<std::uint64_t>(n - 1),
                                                       static_cast<std::uint64_t>(n), confidence);
      EXPECT_NEAR(bound, std::pow(confidence, 1.0 / n), 1e-15) << n;
    }
  }
}

/// k of 2k + 1: by symmetry one half is as likely above as below.
TEST(Statistics, AtOneHalfTheBoundIsTheMiddle) {
  for (const std::uint64_t k : {1U, 7U, 500U, 500000U})
    EXPECT_NEAR(violation_probability_bound(k, 2 * k + 1, 0.5), 0.5, 1e-15) << k;
}

TEST(Statistics, MoreViolationsAndMoreConfidenceRaiseTheBound) {
  const double bound = violation_probability_bound(20, 1000, 0.95);
  EXPECT_GT(violation_probability_bound(21, 1000, 0.95), bound);
  EXPECT_GT(violation_probability_bound(20, 1000, 0.99), bound);
  EXPECT_GT(violation_probability_bound(20, 999, 0.95), bound);
}

}  // namespace
}  // namespace gainsmith::statistics
