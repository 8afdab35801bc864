#include "drawing/axis.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/number.h"
#include "base/random.h"
#include "drawing/extremes.h"

namespace gainsmith::drawing {
namespace {

Extent extent(std::initializer_list<double> values) {
  Extent all;
  for (const double value : values) all.add(value);
  return all;
}

std::string labels(const Axis& axis) {
  std::string text;
  for (const Tick& tick : axis.ticks)
    text += (text.empty() ? "" : " ") + tick.text + (tick.power.empty() ? "" : "^" + tick.power);
  return text;
}

TEST(LinearAxis, ShowsItsValuesBetweenItsEnds) {
  RandomStream draw(1, 0);
  for (int k = 0; k < 5000; ++k) {
    const double size = std::pow(10, 600 * draw.uniform() - 300);
    const double low = size * (draw.uniform() - 0.5),
                 high = low + size * std::pow(10, -14 * draw.uniform());
    const Axis axis = linear_axis(extent({low, high}), 0.1, 8);
    ASSERT_LT(axis.low, axis.high);
    ASSERT_GE(axis.share(low), 0);
    ASSERT_GT(axis.share(high), axis.share(low) - 1e-12);
    ASSERT_LE(axis.share(high), 1);
    ASSERT_GE(axis.ticks.size(), 3) << low << " " << high;
    ASSERT_LE(axis.ticks.size(), 8);
    for (const Tick& tick : axis.ticks) {
      ASSERT_GT(tick.share, -1e-3);
      ASSERT_LT(tick.share, 1.001);
      ASSERT_LE(tick.text.size(), 3U + 16U) << tick.text;
    }
  }
}

TEST(LinearAxis, WithoutMarginEndsWithItsValues) {
  const Axis axis = linear_axis(extent({0.125, 19.7}), 0, 10);
  EXPECT_EQ(axis.low, 0.125);
  EXPECT_EQ(axis.high, 19.7);
  EXPECT_EQ(axis.share(19.7), 1);
}

TEST(LinearAxis, OneValueStandsInTheMiddle) {
  for (const double value : {5.5, -3e-7, 2.5e200, 7.0, 0.0, 1e-310, -1.5e308})
    EXPECT_NEAR(linear_axis(extent({value}), 0.1, 6).share(value), 0.5, 0.03) << value;
}

TEST(LinearAxis, LastDigitsLookConstant) {
  const Axis axis = linear_axis(extent({0.3, std::nextafter(0.3, 1)}), 0.1, 6);
  EXPECT_NEAR(axis.share(0.3), 0.5, 1e-4);
  EXPECT_NEAR(axis.share(std::nextafter(0.3, 1)), 0.5, 1e-4);
}

TEST(LinearAxis, OfTheWholeRangeOfDouble) {
  const Axis axis = linear_axis(extent({-largest, largest}), 0.1, 6);
  EXPECT_EQ(axis.share(-largest), 0);
  EXPECT_EQ(axis.share(0), 0.5);
  EXPECT_EQ(axis.share(largest), 1);
  EXPECT_EQ(axis.factor, 306);
}

TEST(LinearAxis, LongNumbersShareAFactor) {
  const std::string minus = "\xE2\x88\x92";
  const Axis large = linear_axis(extent({-4e6, 5e6}), 0.1, 6);
  EXPECT_EQ(large.factor, 6);
  EXPECT_EQ(labels(large), minus + "4 " + minus + "2 0 2 4");
  const Axis small = linear_axis(extent({1e-5, 4.9e-5}), 0.1, 6);
  EXPECT_EQ(small.factor, -6);
  EXPECT_EQ(labels(small), "10 20 30 40 50");
  EXPECT_EQ(linear_axis(extent({-0.02, 0.03}), 0.1, 6).factor, 0);
  EXPECT_EQ(linear_axis(extent({0, 9e4}), 0.1, 6).factor, 0);
}

TEST(LinearAxis, ModesAreWholeNumbers) {
  EXPECT_EQ(labels(linear_axis(extent({0, 1}), 0.1, 8)), "0 1");
  EXPECT_EQ(labels(linear_axis(extent({3}), 0.1, 8)), "2 3 4");
  EXPECT_EQ(labels(linear_axis(extent({0, 1, 0.5}), 0.1, 6)), "0 0.2 0.4 0.6 0.8 1.0");
}

TEST(LogarithmicAxis, HasWholeDecadesAroundItsValues) {
  RandomStream draw(2, 0);
  for (int k = 0; k < 5000; ++k) {
    const double a = 580 * draw.uniform() - 300;
    const double low = std::pow(10, a),
                 high = low * std::pow(10, 25 * draw.uniform() * draw.uniform());
    const Axis axis = logarithmic_axis(extent({low, high}), 8);
    ASSERT_EQ(axis.low, std::floor(std::log10(low)));
    ASSERT_LT(axis.high - std::log10(high), 1 + 1e-9);
    ASSERT_GE(axis.share(low), 0);
    ASSERT_LE(axis.share(high), 1);
    ASSERT_GE(axis.ticks.size(), 2);
    ASSERT_LE(axis.ticks.size(), 8);
    for (const Tick& tick : axis.ticks) {
      const double decade = axis.low + tick.share * (axis.high - axis.low);
      ASSERT_NEAR(decade, std::round(decade), 1e-9);
      std::string power = tick.power;
      if (power.starts_with("\xE2\x88\x92")) power.replace(0, 3, "-");
      ASSERT_EQ(parse_decimal(power), std::round(decade));
    }
  }
}

TEST(LogarithmicAxis, DecadesThemselvesAreEnds) {
  for (int decade = -300; decade <= 300; ++decade) {
    const auto power = [](int d) { return *parse_decimal("1e" + std::to_string(d)); };
    const Axis axis = logarithmic_axis(extent({power(decade), power(decade + 2)}), 8);
    EXPECT_EQ(axis.low, decade);
    EXPECT_EQ(axis.high, decade + 2);
    const double below = std::nextafter(power(decade), 0),
                 above = std::nextafter(power(decade), 1e308);
    EXPECT_EQ(logarithmic_axis(extent({below, above}), 8).low, decade - 1);
    EXPECT_EQ(logarithmic_axis(extent({below, above}), 8).high, decade + 1);
  }
}

TEST(LogarithmicAxis, TwelveDecades) {
  const std::string minus = "\xE2\x88\x92";
  const Axis axis = logarithmic_axis(extent({3e-12, 0.7}), 8);
  EXPECT_EQ(labels(axis), "10^" + minus + "12 10^" + minus + "10 10^" + minus + "8 10^" + minus +
                              "6 10^" + minus + "4 10^" + minus + "2 10^0");
  EXPECT_EQ(axis.between.size(), 12);
  EXPECT_EQ(logarithmic_axis(extent({1, 999}), 8).between.size(), 27);
}

TEST(LogarithmicAxis, ConstantAndExtremeValues) {
  EXPECT_EQ(logarithmic_axis(extent({1}), 8).share(1), 0.5);
  const Axis whole = logarithmic_axis(extent({5e-324, largest}), 8);
  EXPECT_EQ(whole.low, -324);
  EXPECT_EQ(whole.high, 309);
  EXPECT_GE(whole.share(5e-324), 0);
  EXPECT_LE(whole.share(largest), 1);
}

TEST(Axis, ShowsFiniteNumbers) {
  const Axis linear = linear_axis(extent({0, 1}), 0, 8),
             logarithmic = logarithmic_axis(extent({1}), 8);
  for (const double value : {infinite, -infinite, std::nan("")}) {
    EXPECT_FALSE(linear.shows(value));
    EXPECT_FALSE(logarithmic.shows(value));
  }
  EXPECT_TRUE(linear.shows(-1));
  EXPECT_FALSE(logarithmic.shows(0));
  EXPECT_FALSE(logarithmic.shows(-1));
  EXPECT_TRUE(logarithmic.shows(1e-320));
}

TEST(Axis, WithoutValuesIsThereAllTheSame) {
  EXPECT_GE(linear_axis({}, 0.1, 6).ticks.size(), 3);
  EXPECT_GE(logarithmic_axis({}, 6).ticks.size(), 2);
}

TEST(CloseAxis, EndsAtTheValues) {
  const Axis axis = close_axis(extent({2e-3, 5e4}), true, 0, 10);
  EXPECT_NEAR(axis.share(2e-3), 0, 1e-12);
  EXPECT_NEAR(axis.share(5e4), 1, 1e-12);
  EXPECT_EQ(labels(axis),
            "10^\xE2\x88\x92"
            "2 10^\xE2\x88\x92"
            "1 10^0 10^1 10^2 10^3 10^4");
  EXPECT_EQ(labels(close_axis(extent({0, 1}), false, 0.1, 8)), "0 1");
}

TEST(CloseAxis, OfFewDecadesHasOneTwoFive) {
  EXPECT_EQ(labels(close_axis(extent({0.04, 3}), true, 0, 10)), "0.05 0.1 0.2 0.5 1 2");
  EXPECT_EQ(labels(close_axis(extent({3e7, 3e8}), true, 0, 10)),
            "5\xC3\x97"
            "10^7 10^8 2\xC3\x97"
            "10^8");
}

TEST(CloseAxis, OfHardlyAnyWidthHasTicksToo) {
  for (const auto& [low, high] : std::vector<std::pair<double, double>>{
           {3, 3.1}, {7, 7}, {1e-300, 1.5e-300}, {2, 2 + 1e-12}, {6e300, 7e300}}) {
    const Axis axis = close_axis(extent({low, high}), true, 0.03, 8);
    EXPECT_GE(axis.ticks.size(), 2) << low;
    EXPECT_LE(axis.ticks.size(), 9) << low;
    for (const Tick& tick : axis.ticks) {
      EXPECT_GE(tick.share, -1e-3);
      EXPECT_LE(tick.share, 1 + 1e-3);
    }
    EXPECT_GE(axis.share(low), -1e-9);
    EXPECT_LE(axis.share(high), 1 + 1e-9);
  }
}

}  // namespace
}  // namespace gainsmith::drawing
