#include "packs/step_polynomial.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "packs/polynomial_through.h"

namespace gainsmith::packs {
namespace {

TEST(StepPolynomial, IsTheQuinticItself) {
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
    const StepPolynomial along = polynomial_through(value, rate, -0.4, 1.3);
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

TEST(StepPolynomial, EstimatesItsErrorWithAMargin) {
  for (const double rate : {0.5, 1.0, 2.0, 3.0}) {
    const auto value = [&](double t) { return std::sin(rate * t + 0.3) + std::exp(-rate * t); };
    const auto slope = [&](double t) {
      return rate * std::cos(rate * t + 0.3) - rate * std::exp(-rate * t);
    };
    for (double from = 0; from < 3; from += 0.1) {
      const StepPolynomial along = polynomial_through(value, slope, from, 0.5);
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

TEST(StepPolynomial, AddsUpItsRises) {
  const auto falls = [](double t) { return 1 - t - t * t; };
  const auto falls_at = [](double t) { return -1 - 2 * t; };
  EXPECT_EQ(polynomial_through(falls, falls_at, 0, 1).rise(), 0);
  // Down by 1/4 to t = 1/2, then up by as much.
  const auto dips = [](double t) { return t * t - t; };
  const auto dips_at = [](double t) { return 2 * t - 1; };
  EXPECT_NEAR(polynomial_through(dips, dips_at, 0, 1).rise(), 0.25, 1e-3);
  // A short rise just after the start.
  const auto short_rise = [](double t) { return 1e-4 * t - t * t; };
  const auto short_rate = [](double t) { return 1e-4 - 2 * t; };
  EXPECT_GT(polynomial_through(short_rise, short_rate, 0, 1).rise(), 2.5e-9);
}

TEST(StepPolynomial, FallsAsMuchAsItDoes) {
  // The rate is -1 + 0.99 sin^2: coefficients rise, the value does not.
  const auto value = [](double t) { return -t + 0.99 * (t / 2 - std::sin(6 * t) / 12); };
  const auto rate = [](double t) { return -1 + 0.99 * std::pow(std::sin(3 * t), 2); };
  const StepPolynomial along = polynomial_through(value, rate, 0, 1);
  EXPECT_FALSE(along.falls(0.05));
  const StepPolynomial half = polynomial_through(value, rate, 0.35, 0.3);
  EXPECT_TRUE(half.falls(0.3 * 0.005));
  EXPECT_FALSE(half.falls(0.3 * 0.02));
  EXPECT_TRUE(polynomial_through([](double t) { return -t; }, [](double) { return -1.0; }, 0, 1)
                  .falls(0.9));
}

TEST(StepPolynomial, FindsItsRoot) {
  const auto value = [](double t) { return 0.3 - t + t * t * t; };
  const auto rate = [](double t) { return -1 + 3 * t * t; };
  const StepPolynomial along = polynomial_through(value, rate, 0, 0.5);
  EXPECT_NEAR(value(0.5 * along.root(1)), 0, 1e-15);
  // From 0 up and back.
  const auto flies = [](double t) { return 3 * t - 5 * t * t; };
  const auto flies_at = [](double t) { return 3 - 10 * t; };
  EXPECT_NEAR(polynomial_through(flies, flies_at, 0, 8).root(1), 0.6 / 8, 1e-15);
  EXPECT_NEAR(polynomial_through(flies, flies_at, 0.2, 8).root(1), 0.4 / 8, 1e-15);
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
