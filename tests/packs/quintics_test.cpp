#include "packs/quintics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "packs/polynomial_through.h"

namespace gainsmith::packs {
namespace {

TEST(Quintic, IsThePolynomialItself) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int k = 0; k < 100; ++k) {
    std::array<double, 6> a{};
    for (double& one : a) one = number(random);
    const auto value = [&](double t) {
      return a[0] + t * (a[1] + t * (a[2] + t * (a[3] + t * (a[4] + t * a[5]))));
    };
    const auto rate = [&](double t) {
      return a[1] + t * (2 * a[2] + t * (3 * a[3] + t * (4 * a[4] + t * 5 * a[5])));
    };
    const pieces::StepPolynomial along = polynomial_through(value, rate, -0.4, 1.3);
    double highest = -INFINITY;
    for (int i = 0; i <= 1000; ++i) {
      const double share = i / 1000.0;
      const double exact = value(-0.4 + 1.3 * share);
      EXPECT_NEAR(along(share), exact, 1e-12);
      EXPECT_LE(exact, along.largest() + 1e-12);
      highest = std::max(highest, exact);
    }
    // What it attains is a value, and no bound of them; the other is.
    EXPECT_LE(along.highest().attained, highest + 1e-5);
    EXPECT_GE(along.highest().attained, highest - 1e-4);
    EXPECT_GE(along.highest().most, highest - 1e-12);
    EXPECT_LE(along.highest().most, highest + 1e-4);
  }
}

TEST(Quintic, EstimatesItsErrorWithAMargin) {
  for (const double rate : {0.5, 1.0, 2.0, 3.0}) {
    const auto value = [&](double t) { return std::sin(rate * t + 0.3) + std::exp(-rate * t); };
    const auto slope = [&](double t) {
      return rate * std::cos(rate * t + 0.3) - rate * std::exp(-rate * t);
    };
    for (double from = 0; from < 3; from += 0.1) {
      const pieces::StepPolynomial along = polynomial_through(value, slope, from, 0.5);
      double worst = 0;
      for (int i = 0; i <= 100; ++i)
        worst = std::max(worst, std::abs(along(i / 100.0) - value(from + i / 200.0)));
      // Where the fifth difference passes 0 the error is not 0: a step has a neighbour's estimate.
      const double around =
          std::max({along.error(), polynomial_through(value, slope, from - 0.2, 0.5).error(),
                    polynomial_through(value, slope, from + 0.2, 0.5).error()});
      EXPECT_LE(worst, around);
    }
  }
}

TEST(FirstRoot, IsTheFirstOfTheQuartic) {
  const auto through = [](const auto& value) {
    return first_root({value(0.0), value(0.25), value(0.5), value(0.75), value(1.0)});
  };
  const auto quartic = [](double x) { return (x - 0.3) * (x + 1) * (x - 0.9) * (2 - x); };
  ASSERT_TRUE(through(quartic));
  EXPECT_NEAR(*through(quartic), 0.3, 1e-14);
  EXPECT_NEAR(*through([](double x) { return std::exp(x) - 2; }), std::log(2.0), 1e-4);
  EXPECT_FALSE(through([](double x) { return x + 0.1; }));
  EXPECT_FALSE(through([](double) { return -1.0; }));
}

}  // namespace
}  // namespace gainsmith::packs
