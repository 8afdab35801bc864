#include "io/json/json_place.h"

#include <gtest/gtest.h>

#include "support/input_error.h"

namespace gainsmith::io {
namespace {

TEST(JsonPlace, IsWhereTheKeyOrTheElementBegins) {
  const std::string text =
      "{\n"
      "  \"a\": [1, 22 , {\"\xC3\xA4\": -3.5, \"name\": null}, [[], [true]]],\n"
      "  \"b\": {\"c\": {\"d\": \"x\"}}\n"
      "}\n";
  const auto place = [&](const char* path) { return place_in(text, "f", path); };
  EXPECT_EQ(place("a"), (Place{"f", 2, 3}));
  EXPECT_EQ(place("a[0]"), (Place{"f", 2, 9}));
  EXPECT_EQ(place("a[1]"), (Place{"f", 2, 12}));
  EXPECT_EQ(place("a[2]"), (Place{"f", 2, 17}));
  EXPECT_EQ(place("a[2].name"), (Place{"f", 2, 29}));
  EXPECT_EQ(place("a[3][1][0]"), (Place{"f", 2, 50}));
  EXPECT_EQ(place("b.c.d"), (Place{"f", 3, 15}));
  EXPECT_EQ(place("b.x"), Place{"f"});
  EXPECT_EQ(place(""), Place{"f"});
  const std::string deep =
      "{\"a\": " + std::string(100'000, '[') + std::string(100'000, ']') + ", \"b\": 1}";
  EXPECT_EQ(place_in(deep, "f", "b"), (Place{"f", 1, 200'009}));
  EXPECT_EQ(place_in("", "f", "a"), Place{"f"});
}

}  // namespace
}  // namespace gainsmith::io
