#include "claims/parting.h"

#include <gtest/gtest.h>

namespace gainsmith::claims {
namespace {

using Eigen::Vector2d;

TEST(PartingTest, ADifferenceOfAPartOfTheRangeIsNoErrorAnyMore) {
  Parting parting(Vector2d(0, 1), 1e-8, 0);
  parting.see(1, Vector2d(1, 1), Vector2d(1 + 1e-4, 1));
  EXPECT_FALSE(parting.has_parted(0));
  parting.see(2, Vector2d(0.5, 1), Vector2d(0.5 + 2e-3, 1));
  parting.see(3, Vector2d(0.5, 1), Vector2d(0.5, 1));
  EXPECT_EQ(parting.since()(0), 2);
  EXPECT_FALSE(parting.has_parted(1));
}

/// A difference of two filters is 1e-14 and nothing else: both compute it from terms near 1.
TEST(PartingTest, WhatIsNothingButRoundingOfItsTermsHasNotParted) {
  for (const bool from_terms : {false, true}) {
    Parting parting(Vector2d(0, 0), 1e-8, 0);
    if (from_terms) parting.compute(Vector2d(1, 0));
    parting.see(1, Vector2d(1e-14, 1e-14), Vector2d(-1e-14, -1e-14));
    EXPECT_EQ(parting.has_parted(0), !from_terms);
    EXPECT_TRUE(parting.has_parted(1));
  }
}

TEST(PartingTest, WithinTheAbsoluteAccuracyNothingParts) {
  Parting parting(Vector2d(0, 0), 1e-8, 1e-8);
  parting.see(1, Vector2d(1e-6, 1e-3), Vector2d(-1e-6, -1e-3));
  EXPECT_FALSE(parting.has_parted(0));
  EXPECT_TRUE(parting.has_parted(1));
}

}  // namespace
}  // namespace gainsmith::claims
