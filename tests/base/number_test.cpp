#include "base/number.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

#include "base/known_digits.h"

namespace gainsmith {
namespace {

void expect_round_trip(double value) {
  const std::string text = decimal17(value);
  const auto back = parse_decimal(text);
  ASSERT_TRUE(back) << text;
  EXPECT_EQ(std::bit_cast<std::uint64_t>(*back), std::bit_cast<std::uint64_t>(value)) << text;
  EXPECT_EQ(decimal17(*back), text);
}

TEST(Decimal17, ReadsBackToTheSameBitsForRandomBitPatterns) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 100000; ++i) {
    const auto value = std::bit_cast<double>(random());
    if (std::isfinite(value)) expect_round_trip(value);
  }
}

TEST(Decimal17, ReadsBackToTheSameBitsAtTheEdges) {
  using Limits = std::numeric_limits<double>;
  for (const double value : {0.0, 0.1, 1.0, Limits::min(), Limits::max(), Limits::denorm_min(),
                             Limits::min() - Limits::denorm_min(), Limits::epsilon(), 1e308}) {
    expect_round_trip(value);
    expect_round_trip(-value);
  }
}

/// In 15 or 16 digits where they are read back as the same double, otherwise in 17.
std::string tried_in_turn(double value) {
  for (const int digits : {15, 16})
    if (std::string text = brief(value, digits); parse_decimal(text) == value) return text;
  return decimal17(value);
}

TEST(Shortest, IsTheFirstThatReadsBack) {
  std::mt19937_64 random(2);
  std::uniform_int_distribution<int> tenth(-30, 30);
  std::uniform_real_distribution<double> inside(-10, 10);
  for (int k = 0; k < 100000; ++k) {
    const auto bits = std::bit_cast<double>(random());
    const double values[] = {bits, inside(random), std::round(1e4 * inside(random)) / 1e4,
                             std::round(inside(random)) * std::pow(10.0, tenth(random))};
    for (const double value : values)
      if (std::isnormal(value)) {
        ASSERT_EQ(shortest(value), tried_in_turn(value));
      }
  }
  EXPECT_EQ(shortest(0), "0");
  EXPECT_EQ(shortest(0.3), "0.3");
  EXPECT_EQ(shortest(-0.001), "-0.001");
  EXPECT_EQ(shortest(1e15), "1e+15");
  EXPECT_EQ(shortest(123456789012345678.0), "1.2345678901234568e+17");
  EXPECT_EQ(shortest(std::numeric_limits<double>::denorm_min()), "5e-324");
  EXPECT_EQ(shortest(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(shortest(std::numeric_limits<double>::quiet_NaN()), "nan");
}

TEST(Decimal17, WritesAsPrintfDoes) {
  EXPECT_EQ(decimal17(0.1), "0.10000000000000001");
  EXPECT_EQ(decimal17(-2), "-2");
  EXPECT_EQ(decimal17(1e100), "1e+100");
  EXPECT_EQ(decimal17(1e-5), "1.0000000000000001e-05");
  EXPECT_EQ(decimal17(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(decimal17(-std::numeric_limits<double>::infinity()), "-inf");
}

TEST(Brief, RoundsAndDropsTrailingZeros) {
  EXPECT_EQ(brief(0.1), "0.1");
  EXPECT_EQ(brief(1.0 / 3), "0.333333");
  EXPECT_EQ(brief(1234567, 3), "1.23e+06");
}

TEST(ParseDecimal, TakesWholeDecimals) {
  EXPECT_EQ(parse_decimal("0"), 0.0);
  EXPECT_EQ(parse_decimal("+1.5"), 1.5);
  EXPECT_EQ(parse_decimal("-.5"), -0.5);
  EXPECT_EQ(parse_decimal("5."), 5.0);
  EXPECT_EQ(parse_decimal("1e3"), 1000.0);
  EXPECT_EQ(parse_decimal("1E+3"), 1000.0);
  EXPECT_EQ(parse_decimal("1.e-3"), 0.001);
  EXPECT_EQ(parse_decimal("0001"), 1.0);
  EXPECT_TRUE(std::signbit(parse_decimal("-0").value()));
}

TEST(ParseDecimal, RefusesWhatIsNoDecimal) {
  for (const char* text :
       {"",    "+",    "-",    ".",        "e5",    "1e",    "1e+", "1 ",      " 1",
        "1x",  "0x10", "1,5",  "1_000",    "--1",   "++1",   "+-1", "-+1",     "nan",
        "NaN", "inf",  "-inf", "Infinity", "1.2.3", "1e2e3", "1-2", "\xC2\xA0"})
    EXPECT_EQ(parse_decimal(text), std::nullopt) << "'" << text << "'";
}

TEST(ParseDecimal, BeyondTheRangeIsEmptyAndBelowItIsZero) {
  EXPECT_EQ(parse_decimal("1e309"), std::nullopt);
  EXPECT_EQ(parse_decimal("-1e309"), std::nullopt);
  EXPECT_EQ(parse_decimal("1e99999999999999999999"), std::nullopt);
  EXPECT_EQ(parse_decimal("1e-400"), 0.0);
  EXPECT_EQ(parse_decimal("1e-1000"), 0.0);
  EXPECT_EQ(parse_decimal("1" + std::string(400, '0')), std::nullopt);
  EXPECT_EQ(parse_decimal("0." + std::string(400, '0') + "1"), 0.0);
}

// Wider numbers would lose what double rounds to zero at another place each, 100 digits at 1e-323228497.
TEST(ParseDecimal, RefusesExponentsBeyond1000) {
  for (const char* text :
       {"1e-1001", "-1e-2147483648", "1e-99999999999999999999", "0.1E-2000", "1e+1001"})
    EXPECT_EQ(parse_decimal(text), std::nullopt) << text;
  const std::string zeros(1100, '0');
  EXPECT_EQ(parse_decimal("0." + zeros + "1e+1101"), std::nullopt);
  for (const char* text : {"0e-1001", "-0.00e-99999999999999999999", "0e2147483648"})
    EXPECT_EQ(parse_decimal(text), 0.0) << text;
}

TEST(ParseDecimal, RoundsToTheNearestDouble) {
  // 2^53 + 1 lies between two doubles and goes to the even one.
  EXPECT_EQ(parse_decimal("9007199254740993"), 9007199254740992.0);
  EXPECT_EQ(parse_decimal("9007199254740993.0000000000000000001"), 9007199254740994.0);
}

/// Whatever the truth within the error: the last digit is right within one, or the error behind it holds.
TEST(Brief, OfABoundIsOnItsSide) {
  EXPECT_EQ(brief_below(0.63582855), "0.635828");
  EXPECT_EQ(brief_above(0.6358281), "0.635829");
  EXPECT_EQ(brief_below(-0.6358281), "-0.635829");
  EXPECT_EQ(brief_above(-0.63582855), "-0.635828");
  EXPECT_EQ(brief_above(0.5), "0.5");
  EXPECT_EQ(brief_above(0), "0");
  EXPECT_EQ(brief_below(999999.9), "999999");
  EXPECT_EQ(brief_above(999999.1), "1e+06");
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> exponent(-300, 300), factor(-10, 10);
  for (int k = 0; k < 10000; ++k) {
    const double value = factor(random) * std::pow(10, exponent(random));
    const double below = parse_decimal(brief_below(value, 10)).value();
    const double above = parse_decimal(brief_above(value, 10)).value();
    EXPECT_LE(below, value);
    EXPECT_GE(above, value);
    EXPECT_LE(above - below, 1.1e-9 * std::abs(value));
  }
}

TEST(Brief, HasNoMoreDigitsThanAreKnown) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> part(-1, 1);
  for (int k = 0; k < 100000; ++k) {
    const double value = part(random) * std::pow(10.0, std::floor(20 * part(random)));
    const double error = std::abs(value) * std::pow(10.0, 12 * part(random) - 6);
    const std::string text = brief(value, 6, error);
    const std::size_t behind = text.find(" +- ");
    const std::string number = text.substr(0, behind);
    const double printed = *parse_decimal(number);
    if (behind == std::string::npos) {
      const double last = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 5);
      EXPECT_EQ(text, brief(value, 6));
      EXPECT_LE(std::abs(printed - value) + error, last * (1 + 1e-9)) << text;
      continue;
    }
    const double shown = *parse_decimal(text.substr(behind + 4));
    EXPECT_GE(shown, std::abs(printed - value) + error * (1 - 1e-9)) << text << " " << value;
    // Down to the place of the error, and not beyond it.
    const double place = std::pow(10.0, std::floor(std::log10(error)));
    EXPECT_LE(std::abs(printed - value), (number == "0" ? 1 : 0.5) * place * (1 + 1e-9)) << text;
    const double last = printed / place;
    EXPECT_NEAR(last, std::round(last), 1e-9 * std::abs(last)) << text;
  }
  EXPECT_EQ(brief(2.5, 6, 0), "2.5");
  EXPECT_EQ(brief(std::numeric_limits<double>::infinity(), 6, 0), "inf");
}

}  // namespace
}  // namespace gainsmith
