// Moves in the last places: what a twin of a run differs by.
#include "simulate/last_places.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gainsmith::simulate {
namespace {

TEST(LastPlaces, MoveWhatIsNoWholeNumberByUnitsOfItsTerms) {
  LastPlaces places(1, 0, 0);
  for (int step = 0; step < 100; ++step, places.next()) {
    const double move = places.of(0.3, 5);
    EXPECT_GE(std::abs(move), 5 * 0x1p-53);
    EXPECT_LE(std::abs(move), 5 * 0x1p-48);
    EXPECT_EQ(places.of(3, 5), 0);
    EXPECT_EQ(places.of(0, 5), 0);
  }
}

TEST(LastPlaces, EqualValuesMoveAlikeAtOneTimeAndBothWaysInTime) {
  LastPlaces places(1, 0, 0);
  int up = 0;
  for (int step = 0; step < 1000; ++step, places.next()) {
    EXPECT_EQ(places.of(0.3, 1), places.of(0.3, 1));
    up += places.of(0.3, 1) > 0 ? 1 : 0;
  }
  EXPECT_GT(up, 400);
  EXPECT_LT(up, 600);
}

}  // namespace
}  // namespace gainsmith::simulate
