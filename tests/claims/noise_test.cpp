// Down to which values a claim is compared, on tracks made by hand.
#include <gtest/gtest.h>

#include <vector>

#include "claims/claim_check.h"

namespace gainsmith::claims {
namespace {

/// One value that must not increase, at samples along a flow.
class Samples {
 public:
  explicit Samples(double accuracy) {
    track_.accuracy = accuracy;
    track_.size = 1;
  }

  Samples& add(double value, double error, bool within_instant = false) {
    if (track_.samples() > 0) track_.moves.push_back({});
    track_.t.push_back(static_cast<double>(track_.samples()));
    track_.j.push_back(0);
    track_.values.push_back(value);
    track_.bounds.push_back(error);
    track_.within_instant.push_back(within_instant ? 1 : 0);
    return *this;
  }

  Finding judged(bool holds = false) const { return ClaimCheck(JudgedClaim{})(track_, holds); }

 private:
  Track track_;
};

TEST(Noise, ACertainRiseCountsDownToAPartOfTheAccuracy) {
  const Finding found = Samples(1e-8).add(1, 0).add(1e-11, 1e-15).add(5e-11, 1e-15).judged();
  EXPECT_TRUE(found.violated());
  const Finding below = Samples(1e-8).add(1, 0).add(1e-13, 1e-17).add(5e-13, 1e-17).judged();
  EXPECT_EQ(below.judgement, Judgement::held);
  EXPECT_NEAR(below.floor, 5e-13, 1e-15);
}

TEST(Noise, AnUndecidedComparisonCountsDownToTheAccuracy) {
  const Finding found = Samples(1e-8).add(1, 0).add(1e-7, 1e-9).add(1e-7, 1e-9).judged();
  EXPECT_TRUE(found.undecided());
  const Finding below = Samples(1e-8).add(1, 0).add(5e-9, 1e-11).add(5e-9, 1e-11).judged();
  EXPECT_EQ(below.judgement, Judgement::held);
  EXPECT_NEAR(below.floor, 5e-9, 1e-10);
}

/// A run that is repeated more accurately leaves out no less.
TEST(Noise, WhatIsUndecidedIsLeftOutAlikeAtAllAccuracies) {
  for (const double accuracy : {1e-8, 1e-10, 1e-12}) {
    const Finding below = Samples(accuracy).add(1, 0).add(5e-9, 1e-11).add(5e-9, 1e-11).judged();
    EXPECT_EQ(below.judgement, Judgement::held);
    EXPECT_NEAR(below.floor, 5e-9, 1e-10);
    EXPECT_TRUE(Samples(accuracy).add(1, 0).add(5e-9, 0).add(6e-9, 0).judged().violated());
  }
}

TEST(Noise, IsNothingWhereAClaimIsKnownToHold) {
  Samples samples(1e-8);
  samples.add(1, 1e-9).add(1 + 1e-10, 1e-9).add(0.5, 1e-9);
  EXPECT_TRUE(samples.judged().undecided());
  const Finding held = samples.judged(true);
  EXPECT_EQ(held.judgement, Judgement::held);
  EXPECT_EQ(held.value, 0.5);
  EXPECT_EQ(held.bound, 1);
}

/// Two samples of one instant: a value that stays is no more certain than its error.
TEST(Noise, WithinAnInstantAValueHasGrownBeyondAPartOfItsError) {
  const auto judged = [](double rise) {
    return Samples(1e-8).add(1, 0).add(0.5, 1e-6).add(0.5 + rise, 1e-6, true).judged().judgement;
  };
  EXPECT_EQ(judged(0.05 * 2e-6), Judgement::held);
  EXPECT_EQ(judged(0.5 * 2e-6), Judgement::undecided);
  EXPECT_EQ(judged(3e-6), Judgement::violated);
}

}  // namespace
}  // namespace gainsmith::claims
