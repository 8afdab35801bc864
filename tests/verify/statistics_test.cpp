#include "verify/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gainsmith::verify {
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
}

TEST(Statistics, BoundSolvesTheBinomialEquation) {
  for (const auto& [k, n] : {std::pair{1, 10}, {3, 1000}, {999, 1000}, {400, 1000}, {9, 10}}) {
    const double bound = violation_probability_bound(static_cast<std::uint64_t>(k),
                                                     static_cast<std::uint64_t>(n), 0.95);
    EXPECT_NEAR(binomial(k, n, bound), 0.05, 1e-10) << k << " of " << n;
  }
}

TEST(Statistics, NothingIsExcludedWhenAllRunsViolate) {
  EXPECT_EQ(violation_probability_bound(10, 10, 0.95), 1);
  EXPECT_EQ(violation_probability_bound(0, 0, 0.95), 1);
}

TEST(Statistics, IncompleteBetaOfClosedForms) {
  for (const double x : {0.0, 0.01, 0.3, 0.77, 1.0}) {
    EXPECT_NEAR(incomplete_beta(1, 1, x), x, 1e-14);
    EXPECT_NEAR(incomplete_beta(3, 1, x), x * x * x, 1e-14);
    EXPECT_NEAR(incomplete_beta(0.5, 0.5, x), 2 / M_PI * std::asin(std::sqrt(x)), 1e-13);
  }
}

}  // namespace
}  // namespace gainsmith::verify
