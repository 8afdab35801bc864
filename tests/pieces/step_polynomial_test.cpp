#include "pieces/step_polynomial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace gainsmith::pieces {
namespace {

/// Of sum c_k t^k on [0, length].
StepPolynomial of(std::vector<double> c, double length = 1) {
  // B_j = sum_k C(j, k) / C(n, k) c_k length^k.
  std::vector<double> b(c.size(), 0);
  const std::size_t n = c.size() - 1;
  for (std::size_t j = 0; j <= n; ++j) {
    double weight = 1;
    for (std::size_t k = 0; k <= j; ++k) {
      b[j] += weight * c[k] * std::pow(length, k);
      if (k < n) weight *= static_cast<double>(j - k) / static_cast<double>(n - k);
    }
  }
  return {b, 0};
}

TEST(StepPolynomial, IsItsSeries) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int k = 0; k < 100; ++k) {
    std::vector<double> c(1 + random() % StepPolynomial::kMostTerms);
    for (double& one : c) one = number(random);
    const double length = 0.1 + std::abs(number(random));
    const StepPolynomial along = of(c, length);
    double highest = -INFINITY;
    for (int i = 0; i <= 1000; ++i) {
      const double share = i / 1000.0;
      double exact = 0;
      for (std::size_t n = c.size(); n-- > 0;) exact = exact * share * length + c[n];
      EXPECT_NEAR(along(share), exact, 1e-13);
      EXPECT_NEAR(along.negated()(share), -exact, 1e-13);
      EXPECT_LE(exact, along.largest() + 1e-13);
      highest = std::max(highest, exact);
    }
    // What it attains is a value, and no bound of them; the other is.
    EXPECT_LE(along.highest().attained, highest + 1e-4);
    EXPECT_GE(along.highest().attained, highest - 1e-3);
    EXPECT_GE(along.highest().most, highest - 1e-13);
    EXPECT_LE(along.highest().most, highest + 1e-3);
  }
}

TEST(StepPolynomial, AddsUpItsRises) {
  EXPECT_EQ(of({1, -1, -1}).rise(), 0);
  // Down by 1/4 to t = 1/2, then up by as much.
  EXPECT_NEAR(of({0, -1, 1}).rise(), 0.25, 1e-3);
  // A short rise just after the start.
  EXPECT_GT(of({0, 1e-4, -1}).rise(), 2.5e-9 * (1 - 1e-9));
}

TEST(StepPolynomial, FallsAsMuchAsItDoes) {
  // The rate is -1 + 4 t - 4.2 t^2: coefficients rise, the value does not.
  const StepPolynomial along = of({0, -1, 2, -1.4});
  EXPECT_TRUE(along.falls(0.04));
  EXPECT_FALSE(along.falls(0.06));
  EXPECT_TRUE(of({0, -1}).falls(0.9));
  EXPECT_FALSE(of({0, 1}).falls(0));
  EXPECT_TRUE(of({3}).falls(0));
  EXPECT_FALSE(of({3}).falls(1e-9));
}

TEST(StepPolynomial, FindsWhereItChangesItsSide) {
  const std::vector<double> cubic = {0.3, -1, 0, 1};
  const auto value = [](double t) { return 0.3 - t + t * t * t; };
  ASSERT_TRUE(of(cubic, 0.5).first_change(1, 0));
  EXPECT_NEAR(value(0.5 * *of(cubic, 0.5).first_change(1, 0)), 0, 1e-15);
  EXPECT_FALSE(of(cubic, 0.25).first_change(1, 0));
  // From 0 up and back; also where rounding has left it beside 0.
  for (const double start : {0.0, 1e-17, -1e-17})
    EXPECT_NEAR(*of({start, 3, -5}, 8).first_change(0, 1e-16), 0.6 / 8, 1e-15) << start;
  // The first of two, and none of a value that touches 0.
  EXPECT_NEAR(*of({0.06, -0.5, 1}).first_change(1, 0), 0.2, 1e-14);
  EXPECT_FALSE(of({0.25, -1, 1}).first_change(1, 1e-15));
  EXPECT_FALSE(of({0}).first_change(0, 0));
}

}  // namespace
}  // namespace gainsmith::pieces
