#include "expr/text/text.h"

#include <gtest/gtest.h>

namespace gainsmith::expr {
namespace {

TEST(Text, CountsLinesAndColumnsFromItsStart) {
  const Text text("ab\nc", "f", {5, 9});
  EXPECT_EQ(text.place(0), (Place{"f", 5, 9}));
  EXPECT_EQ(text.place(2), (Place{"f", 5, 11}));
  EXPECT_EQ(text.place(3), (Place{"f", 6, 1}));
}

TEST(Text, CountsCharactersNotBytes) {
  const Text text("\xC3\xA4\xE2\x89\xA4x", "f");
  EXPECT_EQ(text.place(0).column, 1);
  EXPECT_EQ(text.place(2).column, 2);
  EXPECT_EQ(text.place(5).column, 3);
}

TEST(Text, PastTheEndIsThePlaceBehindTheText) {
  const Text text("ab", "f");
  EXPECT_EQ(text.place(2).column, 3);
  EXPECT_EQ(text.place(100).column, 3);
  EXPECT_EQ(Text().place(0), Place{});
}

TEST(Text, APartKeepsItsPlaces) {
  const Text part = Text("abc\ndef", "f").part(2, 6);
  EXPECT_EQ(part.str(), "c\nde");
  EXPECT_EQ(part.place(0), (Place{"f", 1, 3}));
  EXPECT_EQ(part.place(2), (Place{"f", 2, 1}));
  EXPECT_EQ(part.place(4), (Place{"f", 2, 3}));
}

}  // namespace
}  // namespace gainsmith::expr
