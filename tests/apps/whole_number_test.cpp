#include "gainsmith/whole_number.h"

#include <gtest/gtest.h>

namespace gainsmith::app {
namespace {

TEST(WholeNumber, IsReadInDigitsAndWithAnExponent) {
  EXPECT_EQ(parse_whole("0"), 0U);
  EXPECT_EQ(parse_whole("007"), 7U);
  EXPECT_EQ(parse_whole("1e4"), 10000U);
  EXPECT_EQ(parse_whole("1E+04"), 10000U);
  EXPECT_EQ(parse_whole("2.50e2"), 250U);
  EXPECT_EQ(parse_whole("120e0"), 120U);
  EXPECT_EQ(parse_whole("18446744073709551615"), 18446744073709551615U);
  EXPECT_EQ(parse_whole("1e19"), 10000000000000000000U);
}

TEST(WholeNumber, IsNothingElse) {
  for (const char* text : {"",
                           "e",
                           "e4",
                           "1e",
                           "-1",
                           "+1",
                           "1.5e0",
                           "1.25e1",
                           "1e-2",
                           "1e20",
                           "1e99",
                           "1e99999999999999999999",
                           "18446744073709551616",
                           "0x10",
                           "1 000",
                           " 1",
                           "1e 4",
                           ".",
                           ".5e1",
                           "1..0e3",
                           "1.2.3e5",
                           "nan",
                           "inf",
                           "ten"})
    EXPECT_FALSE(parse_whole(text)) << text;
}

}  // namespace
}  // namespace gainsmith::app
