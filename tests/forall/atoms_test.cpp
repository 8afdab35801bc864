#include "forall/atoms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "forall/random_atom.h"

namespace gainsmith::forall {
namespace {

using testing::random_atom;

TEST(AtomsTest, ProductsOfAtomsAreCombinationsOfAtoms) {
  std::mt19937 generator(1);
  for (int trial = 0; trial < 300; ++trial) {
    const Atom a = random_atom(generator);
    const Atom b = trial % 5 == 0 ? a : random_atom(generator);
    for (const double t : {-1.3, 0.0, 0.4, 2.1}) {
      const double expected = evaluate(a, t) * evaluate(b, t);
      double found = 0;
      for (const auto& [factor, atom] : product(a, b)) found += factor * evaluate(atom, t);
      EXPECT_NEAR(found, expected, 1e-12 * (1 + std::abs(expected)));
    }
  }
}

TEST(AtomsTest, TheRangeHoldsEveryValueAndIsReached) {
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> number(0, 6);
  for (int trial = 0; trial < 200; ++trial) {
    const Atom atom = random_atom(generator);
    const double begin = number(generator);
    const double end = begin + number(generator);
    const Range found = range(atom, begin, end);
    double low = evaluate(atom, begin);
    double high = low;
    for (int i = 0; i <= 4000; ++i) {
      const double v = evaluate(atom, begin + (end - begin) * i / 4000);
      low = std::min(low, v);
      high = std::max(high, v);
    }
    const double size = std::max(std::abs(low), std::abs(high));
    EXPECT_LE(found.low, low + 1e-12 * size);
    EXPECT_GE(found.high, high - 1e-12 * size);
    const double slack = atom.power > 0 && atom.frequency != 0 ? 0.15 : 1e-4;
    EXPECT_NEAR(found.low, low, slack * size + 1e-300);
    EXPECT_NEAR(found.high, high, slack * size + 1e-300);
  }
}

TEST(AtomsTest, ExtremaInsideTheIntervalAreFound) {
  const Range wave = range({0, 0, 2, false}, 0.1, 3.0);
  EXPECT_DOUBLE_EQ(wave.low, -1);
  EXPECT_LT(wave.high, 1);
  const Range bump = range({1, -1, 0, false}, 0.0, 5.0);
  EXPECT_NEAR(bump.high, std::exp(-1.0), 1e-15);
}

/// The derivative is 0 at the start of the interval and the peak is far narrower than it.
TEST(AtomsTest, ANarrowPeakIsFound) {
  EXPECT_NEAR(range({2, -1000, 0, false}, 0, 10).high, 4e-6 * std::exp(-2.0), 1e-20);
  const Range fast = range({0, -0.1, 1e7, false}, 0, 100);
  EXPECT_NEAR(fast.low, -1, 1e-6);
}

TEST(AtomsTest, AtomsPrintAsTheyAreWritten) {
  EXPECT_EQ(to_string(Atom{}, "tau"), "1");
  EXPECT_EQ(to_string({1, 0.03, 2, true}, "tau"), "tau*exp(0.03*tau)*sin(2*tau)");
}

}  // namespace
}  // namespace gainsmith::forall
