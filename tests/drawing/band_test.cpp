#include "drawing/band.h"
#include "drawing/extremes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace gainsmith::drawing {
namespace {

/// 100 x 100 pixels for times from 0 to 10 and values from 0 to 1.
std::string shape(const Band& band) {
  return drawn(band, {false, 0, 10, {}, {}, 0}, {false, 0, 1, {}, {}, 0}, {0, 0, 100, 100});
}

std::ptrdiff_t shapes(const std::string& text) { return std::count(text.begin(), text.end(), 'z'); }

TEST(Band, GoesAroundWhatLiesBetween) {
  const std::string text = shape({"", {0, 10}, {0.2, 0.3}, {0.6, 0.8}, {}, 2});
  EXPECT_NE(text.find("d=\"M0,40l100-20 0,50-100,10z\""), std::string::npos) << text;
  EXPECT_NE(text.find("#009e73"), std::string::npos) << text;
}

TEST(Band, OfEachFlowIsAShape) {
  EXPECT_EQ(shapes(shape({"", {0, 5, 5, 10}, {0, 0, 0.4, 0.4}, {1, 1, 0.6, 0.6}, {1}, 0})), 2);
}

TEST(Band, GapsPartIt) {
  EXPECT_EQ(shapes(shape({"", {0, 2, 4, 6, 8}, {0, 0, nan, 0, 0}, {1, 1, 1, 1, 1}, {}, 0})), 2);
  EXPECT_EQ(shape({"", {0, 2}, {nan, nan}, {1, 1}, {}, 0}), "");
  EXPECT_EQ(shape({}), "");
}

TEST(Band, BeyondTheAxisItLiesAtItsEnd) {
  EXPECT_EQ(shape({"", {0, 10}, {-50, -50}, {70, 70}, {}, 0}),
            shape({"", {0, 10}, {0, 0}, {1, 1}, {}, 0}));
}

TEST(Band, OfManyJumpsIsOneShape) {
  Band band;
  for (int k = 0; k <= 500; ++k) {
    band.t.insert(band.t.end(), {0.02 * k, 0.02 * k});
    band.low.insert(band.low.end(), {0.1, 0.3});
    band.high.insert(band.high.end(), {0.9, 0.6});
    band.jumps.push_back(static_cast<std::size_t>(2 * k));
  }
  EXPECT_EQ(shapes(shape(band)), 1);
}

}  // namespace
}  // namespace gainsmith::drawing
