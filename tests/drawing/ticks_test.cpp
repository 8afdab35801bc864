#include "drawing/ticks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "base/number.h"
#include "base/random.h"

namespace gainsmith::drawing {
namespace {

/// What a label says, the minus sign of typography read as well.
double read(std::string label) {
  if (label.starts_with("\xE2\x88\x92")) label.replace(0, 3, "-");
  return parse_decimal(label).value();
}

/// Ends of all sizes, at most a factor 1e9 closer to each other than to 0.
std::pair<double, double> random_range(RandomStream& draw) {
  const double span = std::pow(10, 200 * draw.uniform() - 100);
  const double low = (2 * draw.uniform() - 1) * span * std::pow(10, 10 * draw.uniform() - 1);
  return {low, low + span * (0.1 + draw.uniform())};
}

TEST(Ticks, AreFourToTenMultiplesThatCoverTheRange) {
  RandomStream draw(1, 0);
  for (int k = 0; k < 20000; ++k) {
    const auto [low, high] = random_range(draw);
    const Ticks found = ticks(low, high, 10);
    const double step = found.multiplier * std::pow(10, found.exponent);
    ASSERT_GE(found.count(), 4) << low << " " << high;
    ASSERT_LE(found.count(), 10) << low << " " << high;
    ASSERT_TRUE(found.multiplier == 1 || found.multiplier == 2 || found.multiplier == 5);
    ASSERT_GE(found.value(found.first), low - 2e-4 * step);
    ASSERT_LE(found.value(found.last), high + 2e-4 * step);
    ASSERT_LT(low, found.value(found.first - 1) + step);
    ASSERT_LT(found.value(found.first) - low, 1.001 * step);
    ASSERT_LT(high - found.value(found.last), 1.001 * step);
    for (auto i = found.first; i <= found.last; ++i)
      ASSERT_NEAR(found.value(i), static_cast<double>(i) * step, 1e-14 * std::abs(found.value(i)));
  }
}

TEST(Ticks, WithinFewerKeepTwoFifths) {
  RandomStream draw(2, 0);
  for (int most = 5; most <= 12; ++most)
    for (int k = 0; k < 2000; ++k) {
      const auto [low, high] = random_range(draw);
      const Ticks found = ticks(low, high, most);
      ASSERT_LE(found.count(), most);
      ASSERT_GE(found.count(), 2 * most / 5) << low << " " << high;
    }
}

TEST(Ticks, OfDegreesArePartsOfATurn) {
  const auto labels = [](double low, double high, int most) {
    const Ticks found = ticks_of_degrees(low, high, most);
    std::vector<std::string> all;
    for (auto k = found.first; k <= found.last; ++k) all.push_back(found.label(k));
    return all;
  };
  using Labels = std::vector<std::string>;
  EXPECT_EQ(labels(-5, 275, 8), (Labels{"0", "45", "90", "135", "180", "225", "270"}));
  EXPECT_EQ(labels(0, 100, 8), (Labels{"0", "15", "30", "45", "60", "75", "90"}));
  EXPECT_EQ(labels(0, 30, 5), (Labels{"0", "10", "20", "30"}));
  EXPECT_EQ(labels(0, 1500, 5), (Labels{"0", "360", "720", "1080", "1440"}));
  EXPECT_EQ(labels(0, 36e3, 6), (Labels{"0", "7200", "14400", "21600", "28800", "36000"}));
  RandomStream draw(7, 0);
  for (int k = 0; k < 2000; ++k) {
    const auto [low, high] = random_range(draw);
    const Ticks found = ticks_of_degrees(low, high, 10);
    ASSERT_LE(found.count(), 10) << low << " " << high;
    ASSERT_GE(found.count(), 3) << low << " " << high;
  }
}

TEST(Ticks, LabelsAreTheNumbers) {
  RandomStream draw(3, 0);
  for (int k = 0; k < 2000; ++k) {
    const auto [low, high] = random_range(draw);
    const Ticks found = ticks(low, high, 10);
    for (auto i = found.first; i <= found.last; ++i) {
      ASSERT_EQ(read(found.label(i)), found.value(i));
      ASSERT_EQ(read(found.label(i, 6)), *parse_decimal(std::to_string(i * found.multiplier) + "e" +
                                                        std::to_string(found.exponent - 6)));
    }
  }
}

TEST(Ticks, LabelsOfOneAxisHaveAsManyPlaces) {
  const Ticks found = ticks(-1, 1.2, 10);
  std::string labels;
  for (auto i = found.first; i <= found.last; ++i) labels += found.label(i) + " ";
  EXPECT_EQ(labels,
            "\xE2\x88\x92"
            "1.0 \xE2\x88\x92"
            "0.5 0 0.5 1.0 ");
}

TEST(Ticks, EndsThatMissByRoundingAreThere) {
  const Ticks found = ticks(0.1 + 0.2, 20 * (1 - 1e-15), 10);
  EXPECT_EQ(found.value(found.last), 20);
  EXPECT_EQ(ticks(1.1, 2.0, 10).value(ticks(1.1, 2.0, 10).first), 1.1);
}

TEST(Ticks, OfTheWholeRangeOfDouble) {
  const double most = std::numeric_limits<double>::max();
  const Ticks found = ticks(-most, most, 10);
  EXPECT_EQ(found.count(), 7);
  EXPECT_EQ(found.value(found.last), 1.5e308);
  const Ticks small = ticks(-1e-300, 1e-300, 10);
  EXPECT_EQ(small.count(), 5);
  EXPECT_EQ(small.value(small.last), 1e-300);
}

TEST(Ticks, StepIsNotBelowTheSmallest) {
  const Ticks found = ticks(-3, -1, 10, 0);
  EXPECT_EQ(found.count(), 3);
  EXPECT_EQ(found.exponent, 0);
  EXPECT_EQ(ticks(-12, 1, 7, 0).count(), 7);
}

}  // namespace
}  // namespace gainsmith::drawing
