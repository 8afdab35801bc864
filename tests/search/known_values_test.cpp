#include "search/known_values.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace gainsmith::search {
namespace {

TEST(KnownValues, AskOncePerFunctionAndPoint) {
  KnownValues known;
  int asked = 0, grown = 0;
  known.grown = [&] { ++grown; };
  const auto value = [&](const std::string& name, const std::vector<double>& point) {
    return known.value(name, point, [&]() -> KnownValues::Value {
      ++asked;
      if (point[0] < 0) return std::nullopt;
      return point[0] + (name == "g" ? 1 : 0);
    });
  };
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (int again = 0; again < 3; ++again) {
    EXPECT_EQ(value("f", {2, none}), 2);
    EXPECT_EQ(value("g", {2, none}), 3);
    EXPECT_EQ(value("f", {0.0}), 0);
    EXPECT_EQ(value("f", {-0.0}), 0);
    EXPECT_EQ(value("f", {-1}), std::nullopt);
  }
  EXPECT_EQ(asked, 5);
  EXPECT_EQ(grown, 5);
}

TEST(KnownValues, AnExceptionLeavesNothing) {
  KnownValues known;
  EXPECT_THROW(known.value("f", {1}, []() -> KnownValues::Value { throw std::runtime_error("x"); }),
               std::runtime_error);
  EXPECT_TRUE(known.all().empty());
  EXPECT_EQ(known.value("f", {1}, [] { return 4.0; }), 4);
}

TEST(KnownValues, TakenFromElsewhereAreNotAsked) {
  KnownValues first, second;
  first.value("f", {1, 2}, [] { return 5.0; });
  for (const auto& [key, value] : first.all()) second.add(key, value);
  EXPECT_EQ(second.value("f", {1, 2}, [] { return 6.0; }), 5);
}

}  // namespace
}  // namespace gainsmith::search
