#include "base/scalars.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/number.h"
#include "base/random.h"

namespace gainsmith {
namespace {

template <typename T>
class Scalars : public ::testing::Test {};
using Types = ::testing::Types<double, DoubleDouble, Decimal100>;
TYPED_TEST_SUITE(Scalars, Types);

/// A number with all the digits that T has, from 2^-power to 2^power.
template <typename T>
T random_number(RandomStream& stream, int power) {
  T value(1 + stream.uniform()), step(1);
  for (int k = 0; k < 7; ++k) {
    step *= T(0x1p-53);
    value += step * T(stream.uniform());
  }
  const double exponent = std::floor(power * (2 * stream.uniform() - 1));
  return value * T(std::exp2(exponent)) * T(stream.uniform() < 0.5 ? -1.0 : 1.0);
}

TYPED_TEST(Scalars, ReadBackWhatTheyWrite) {
  RandomStream stream(1, 0);
  for (int k = 0; k < 3000; ++k) {
    const auto value = random_number<TypeParam>(stream, 300);
    const std::string text = decimal(value);
    const auto back = parse_as<TypeParam>(text);
    ASSERT_TRUE(back) << text;
    if constexpr (std::is_same_v<TypeParam, DoubleDouble>) {
      EXPECT_LE(abs(*back - value).hi(), 0x1p-106 * abs(value).hi()) << text;
    } else {
      EXPECT_EQ(*back, value) << text;
      EXPECT_EQ(decimal(*back), text);
    }
  }
}

TYPED_TEST(Scalars, AreTheNearestToADecimal) {
  // With P = 10^25 and whole numbers M below 2^53, M / P once as text and once divided.
  RandomStream stream(2, 0);
  const Decimal100 power = Decimal100(1e10) * 1e15;
  for (int k = 0; k < 3000; ++k) {
    const double whole = std::floor(stream.uniform() * 0x1p53);
    const auto read = parse_as<TypeParam>(decimal17(whole) + "e-25");
    ASSERT_TRUE(read);
    const Decimal100 exact = whole / power;
    const Decimal100 error = abs(as<Decimal100>(*read) - exact);
    const int bits = std::numeric_limits<TypeParam>::digits;
    EXPECT_LE(error, ldexp(abs(exact), -std::min(bits, 330)));
  }
}

TYPED_TEST(Scalars, ReadTheTextsThatDoubleReads) {
  for (const char* text : {"0", "+1.5", "-.5", "5.", "1e3", "1E+3", "1.e-3", "0001", "-0", "1e-400",
                           "1e-999", "1", "12345678901234567890123456789012345"}) {
    const auto narrow = parse_decimal(text);
    const auto value = parse_as<TypeParam>(text);
    ASSERT_TRUE(narrow && value) << text;
    EXPECT_EQ(static_cast<double>(*value), *narrow) << text;
  }
  for (const char* text : {"", "+", ".", "1e", " 1", "1 ", "1x", "0x10", "1,5", "+-1", "nan", "inf",
                           "1e309", "1e99999999999999999999"})
    EXPECT_FALSE(parse_as<TypeParam>(text)) << text;
}

TYPED_TEST(Scalars, KnowPi) {
  // Machin (1706): pi/4 = 4 atan(1/5) - atan(1/239), by the series of atan.
  const auto atan_of_inverse = [](int inverse) {
    const TypeParam x = TypeParam(1) / TypeParam(inverse);
    TypeParam sum(0), power = x;
    for (int k = 0; k < 120; ++k, power = -power * x * x) sum += power / TypeParam(2 * k + 1);
    return sum;
  };
  const TypeParam machin = TypeParam(16) * atan_of_inverse(5) - TypeParam(4) * atan_of_inverse(239);
  const TypeParam error = abs(TypeParam(pi<TypeParam>() - machin));
  EXPECT_LT(static_cast<double>(error),
            20 * static_cast<double>(std::numeric_limits<TypeParam>::epsilon()));
}

TEST(Scalars, WriteShortNumbersShortly) {
  EXPECT_EQ(decimal(DoubleDouble(0.5)), "0.5");
  EXPECT_EQ(decimal(Decimal100(-3)), "-3");
  EXPECT_EQ(decimal(DoubleDouble(0x1p-20)), "9.5367431640625e-07");
  EXPECT_EQ(decimal(DoubleDouble(1) + DoubleDouble(1e-20)), "1.00000000000000000001");
  EXPECT_EQ(decimal(DoubleDouble(1e25)), "10000000000000000905969664");
  EXPECT_EQ(decimal(0.1), "0.10000000000000001");
  EXPECT_EQ(decimal(DoubleDouble(-INFINITY)), "-inf");
  EXPECT_EQ(decimal(DoubleDouble(std::nan(""))), "nan");
}

TEST(Scalars, KeepTheDigitsThatDoubleDrops) {
  const auto tenth = *parse_as<DoubleDouble>("0.1");
  EXPECT_EQ(tenth.hi(), 0.1);
  // The double nearest to 0.1 is 0.1000000000000000055511151231257827...
  EXPECT_DOUBLE_EQ(tenth.lo(), -5.5511151231257827e-18);
}

TEST(Scalars, ConvertExactlyToWiderAndRoundToNarrower) {
  RandomStream stream(3, 0);
  for (int k = 0; k < 1000; ++k) {
    const auto pair = random_number<DoubleDouble>(stream, 100);
    EXPECT_EQ(as<DoubleDouble>(as<Decimal100>(pair)), pair);
    const auto wide = random_number<Decimal100>(stream, 100);
    const Decimal100 lost = abs(as<Decimal100>(as<DoubleDouble>(wide)) - wide);
    EXPECT_LE(lost, ldexp(abs(wide), -106));
    EXPECT_EQ(as<DoubleDouble>(wide).hi(), as<double>(wide));
  }
}

TEST(Scalars, HaveNames) {
  EXPECT_EQ(name_of<double>(), "double");
  EXPECT_EQ(name_of<DoubleDouble>(), "31 digits");
  EXPECT_EQ(name_of<Decimal100>(), "100 digits");
}

}  // namespace
}  // namespace gainsmith
