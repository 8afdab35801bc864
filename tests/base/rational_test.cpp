#include "base/rational.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/number.h"

namespace gainsmith {
namespace {

TEST(RationalTest, ReadsDecimals) {
  EXPECT_EQ(parse_rational("0.1"), Rational(1, 10));
  EXPECT_EQ(parse_rational("-2.50e-3"), Rational(-1, 400));
  EXPECT_EQ(parse_rational("+7E2"), Rational(700));
  EXPECT_EQ(parse_rational("08"), Rational(8));
  for (const char* text : {"0.000", "0.0e-2147483648", "0e99999999999999999999"})
    EXPECT_EQ(parse_rational(text), Rational(0)) << text;
  EXPECT_EQ(*parse_rational("1e-30") * Rational(power_of_ten(30)), Rational(1));
  for (const char* text : {"", "one", "1e400", "1,5", "0x10", "1e-2000"})
    EXPECT_FALSE(parse_rational(text)) << text;
}

TEST(RationalTest, RoundsToTheNearestWholeNumberAndDouble) {
  EXPECT_EQ(nearest_integer(Rational(7, 2)), 4);
  EXPECT_EQ(nearest_integer(Rational(-7, 2)), -3);
  EXPECT_EQ(nearest_integer(Rational(-10, 3)), -3);
  for (const char* text : {"0.1", "-0.3", "1e22", "123456789.123456789", "5e-324", "1e-400"})
    if (const auto x = parse_rational(text)) {
      EXPECT_EQ(nearest_double(*x), *parse_decimal(text)) << text;
    }
  const DoubleDouble third = nearest_double_double(Rational(1, 3));
  EXPECT_EQ(third.hi(), 1.0 / 3);
  EXPECT_LE(abs(Rational(Rational(third.hi()) + Rational(third.lo()) - Rational(1, 3))),
            Rational(std::ldexp(1.0, -106)));
}

TEST(RationalTest, FindsShortFractions) {
  const Rational noise(1e-16);
  EXPECT_EQ(short_fraction(Rational(Rational(-22, 7) + noise), 1e-12, 1e9), Rational(-22, 7));
  EXPECT_EQ(short_fraction(Rational(Rational(3, 1000) + noise / 1000), 1e-12, 1e9),
            Rational(3, 1000));
  EXPECT_EQ(short_fraction(Rational((Rational(5, 2) + noise) * power_of_ten(-10)), 1e-12, 100),
            Rational(Rational(5, 2) * power_of_ten(-10)));
  EXPECT_EQ(short_fraction(Rational(Rational(1024) + noise), 1e-12, 2000), Rational(1024));
  EXPECT_EQ(short_fraction(Rational(0), 1e-12, 1e9), Rational(0));
  EXPECT_FALSE(short_fraction(Rational(std::sqrt(2.0)), 1e-12, 1e9));
}

}  // namespace
}  // namespace gainsmith
