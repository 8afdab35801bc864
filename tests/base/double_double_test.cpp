// Every operation against the 100-digit type on random arguments.
#include "base/double_double.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/random.h"
#include "base/scalars.h"

namespace gainsmith {
namespace {

constexpr double kUnit = 0x1p-106;  // u^2 of the header
constexpr int kSamples = 20000;

Decimal100 exact(const DoubleDouble& a) { return as<Decimal100>(a); }

class Random {
 public:
  explicit Random(std::uint64_t seed) : stream_(seed, 0) {}
  double between(double low, double high) { return low + (high - low) * stream_.uniform(); }
  /// Both halves full.
  DoubleDouble pair(double low, double high) {
    const double value = between(low, high);
    return DoubleDouble(value) + DoubleDouble(value * between(-0.9, 0.9) * 0x1p-54);
  }
  /// Of either sign, from 2^-power to 2^power.
  DoubleDouble wide(double power) {
    const DoubleDouble value = pair(1, 2) * std::exp2(std::floor(between(-power, power)));
    return stream_.uniform() < 0.5 ? -value : value;
  }

 private:
  RandomStream stream_;
};

/// |got - expected| / |expected|, and whether the halves of `got` do not overlap.
void expect_close(const DoubleDouble& got, const Decimal100& expected, double units,
                  const std::string& what) {
  ASSERT_TRUE(isfinite(got)) << what;
  const Decimal100 error = abs(exact(got) - expected);
  ASSERT_LE(error, units * kUnit * abs(expected)) << what << " = " << decimal(expected);
  ASSERT_EQ(got.hi() + got.lo(), got.hi()) << what;
}

TEST(DoubleDouble, AddsAndSubtractsWithinThreeUnits) {
  Random random(1);
  for (int k = 0; k < kSamples; ++k) {
    const DoubleDouble a = random.wide(40);
    // Every third time so near that most digits cancel.
    const DoubleDouble b = k % 3 == 0 ? a * random.pair(1 - 1e-12, 1 + 1e-12) : random.wide(40);
    const std::string what = decimal(a) + ", " + decimal(b);
    expect_close(a + b, exact(a) + exact(b), 3, "+ " + what);
    expect_close(a - b, exact(a) - exact(b), 3, "- " + what);
    expect_close(-a - b, -exact(a) - exact(b), 3, "-- " + what);
    DoubleDouble sum = a;
    sum += b;
    sum -= b;
    expect_close(sum, exact(DoubleDouble(a + b)) - exact(b), 3, "+= -= " + what);
  }
}

TEST(DoubleDouble, MultipliesWithinFiveUnitsAndDividesWithinTen) {
  Random random(2);
  for (int k = 0; k < kSamples; ++k) {
    const DoubleDouble a = random.wide(200), b = random.wide(200);
    const double c = b.hi();
    const std::string what = decimal(a) + ", " + decimal(b);
    expect_close(a * b, exact(a) * exact(b), 5, "* " + what);
    expect_close(a * c, exact(a) * c, 5, "* double " + what);
    expect_close(c * a, exact(a) * c, 5, "double * " + what);
    expect_close(a / b, exact(a) / exact(b), 10, "/ " + what);
    expect_close(1.0 / b, 1 / exact(b), 10, "1 / " + what);
    DoubleDouble product = a;
    product *= b;
    product /= a;
    expect_close(product, exact(DoubleDouble(a * b)) / exact(a), 10, "*= /= " + what);
  }
}

TEST(DoubleDouble, TakesRoots) {
  Random random(3);
  for (int k = 0; k < kSamples; ++k) {
    const DoubleDouble a = abs(random.wide(800));
    expect_close(sqrt(a), sqrt(exact(a)), 10, "sqrt " + decimal(a));
  }
  EXPECT_EQ(sqrt(DoubleDouble(0)).hi(), 0);
  EXPECT_EQ(sqrt(DoubleDouble(2.25)), DoubleDouble(1.5));
  EXPECT_TRUE(isnan(sqrt(DoubleDouble(-1))));
}

// The two share MPFR, so what is tested is the way there and back.
TEST(DoubleDouble, HasElementaryFunctions) {
  Random random(4);
  for (int k = 0; k < kSamples / 4; ++k) {
    const DoubleDouble a = random.pair(-600, 600), tiny = random.wide(100);
    const DoubleDouble turns = DoubleDouble(std::floor(a.hi())) * pi<DoubleDouble>();
    const DoubleDouble near_one = DoubleDouble(1) + random.wide(20) * 0x1p-30;
    expect_close(exp(a), exp(exact(a)), 2, "exp " + decimal(a));
    for (const DoubleDouble& x : {a, turns, a * 1e6, tiny}) {
      expect_close(sin(x), sin(exact(x)), 2, "sin " + decimal(x));
      expect_close(cos(x), cos(exact(x)), 2, "cos " + decimal(x));
    }
    for (const DoubleDouble& x : {abs(a), abs(tiny), near_one})
      expect_close(log(x), log(exact(x)), 2, "log " + decimal(x));
    for (const DoubleDouble& x : {a / 20, tiny})
      expect_close(tanh(x), tanh(exact(x)), 2, "tanh " + decimal(x));
    const DoubleDouble b = abs(random.wide(6)), power = random.pair(-90, 90);
    expect_close(pow(b, power), pow(exact(b), exact(power)), 2, "pow " + decimal(power));
    const DoubleDouble whole = floor(power);
    expect_close(pow(-b, whole), pow(Decimal100(-exact(b)), exact(whole)), 2,
                 "pow " + decimal(whole));
  }
}

TEST(DoubleDouble, FloorsByBothHalves) {
  Random random(5);
  for (int k = 0; k < kSamples; ++k) {
    const DoubleDouble a = random.wide(120);
    EXPECT_EQ(exact(floor(a)), floor(exact(a))) << decimal(a);
    const DoubleDouble whole(std::floor(random.between(-1e9, 1e9)));
    EXPECT_EQ(floor(whole), whole);
    EXPECT_EQ(floor(whole + DoubleDouble(1e-20)), whole);
    EXPECT_EQ(floor(whole - DoubleDouble(1e-20)), whole - DoubleDouble(1));
  }
}

TEST(DoubleDouble, OrdersByBothHalves) {
  Random random(6);
  for (int k = 0; k < kSamples; ++k) {
    const DoubleDouble a = random.wide(3);
    const DoubleDouble b =
        k % 2 == 0 ? a + DoubleDouble(a.hi() * random.between(-1, 1) * 0x1p-80) : random.wide(3);
    EXPECT_EQ(a < b, exact(a) < exact(b));
    EXPECT_EQ(a <= b, exact(a) <= exact(b));
    EXPECT_EQ(a > b, exact(a) > exact(b));
    EXPECT_EQ(a >= b, exact(a) >= exact(b));
    EXPECT_EQ(a == b, exact(a) == exact(b));
    EXPECT_EQ(a != b, exact(a) != exact(b));
    EXPECT_TRUE(a == a && a <= a && a >= a);
    EXPECT_EQ(exact(abs(a)), abs(exact(a)));
  }
}

TEST(DoubleDouble, TreatsWhatIsNoNumberAsCmathDoes) {
  const DoubleDouble infinite(INFINITY), none(std::nan(""));
  EXPECT_FALSE(isfinite(infinite) || isfinite(none));
  EXPECT_TRUE(isinf(infinite) && isnan(none) && isfinite(DoubleDouble(1e300)));
  EXPECT_FALSE(none == none || none < none || none <= DoubleDouble(1) || DoubleDouble(1) <= none);
  EXPECT_FALSE(isfinite(DoubleDouble(1) / DoubleDouble(0)));
  EXPECT_FALSE(isfinite(DoubleDouble(1e300) * DoubleDouble(1e300)));
  EXPECT_TRUE(isnan(none + DoubleDouble(1)) && isnan(floor(none)));
  EXPECT_EQ(floor(infinite), infinite);
  EXPECT_EQ(exp(-infinite), DoubleDouble(0));
  EXPECT_EQ(exp(infinite), infinite);
  EXPECT_EQ(exp(DoubleDouble(1000)), infinite);
  EXPECT_EQ(log(DoubleDouble(0)), -infinite);
  EXPECT_TRUE(isnan(log(DoubleDouble(-1))) && isnan(sin(infinite)) && isnan(exp(none)));
  EXPECT_EQ(tanh(infinite), DoubleDouble(1));
  EXPECT_EQ(pow(DoubleDouble(0), DoubleDouble(-1)), infinite);
  EXPECT_EQ(pow(none, DoubleDouble(0)), DoubleDouble(1));
  EXPECT_TRUE(isnan(pow(DoubleDouble(-2), DoubleDouble(0.5))));
}

}  // namespace
}  // namespace gainsmith
