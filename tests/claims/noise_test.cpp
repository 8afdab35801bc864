// Down to which values a claim is compared, on tracks made by hand.
#include <gtest/gtest.h>

#include <vector>

#include "bounded/polynomial.h"
#include "claims/claim_check.h"

namespace gainsmith::claims {
namespace {

/// One value that must not increase, at samples along a flow.
template <class Scalar>
class Samples {
 public:
  explicit Samples(double accuracy) { track_.accuracy = accuracy; }

  Samples& add(double value, double error, bool within_instant = false) {
    if (track_.samples() > 0) track_.moves.push_back({});
    track_.t.push_back(static_cast<double>(track_.samples()));
    track_.j.push_back(0);
    track_.timer.push_back(Scalar(0));
    track_.timer_bound.push_back(0);
    track_.stacked.push_back(Scalar(value));
    track_.bounds.push_back(error);
    track_.within_instant.push_back(within_instant ? 1 : 0);
    track_.size = 1;
    return *this;
  }

  Finding judged() const {
    bounded::Coordinates coordinates;
    const expr::Program own = bounded::input_program("v", {});
    coordinates.layout.slots.push_back({"v", {}, 0});
    coordinates.layout.size = 1;
    coordinates.affine = false;
    coordinates.list.push_back({own, own, own, false});
    const bounded::BoundedSystem<Scalar> system(coordinates, std::nullopt);
    JudgedClaim claim;
    claim.sampled_for = 0;
    claim.value = make_function(own, coordinates);
    return ClaimCheck<Scalar>(claim, system)(track_);
  }

 private:
  bounded::Track<Scalar> track_;
};

using InDouble = Samples<double>;
using InDigits = Samples<DoubleDouble>;

TEST(Noise, ACertainRiseCountsDownToAPartOfTheAccuracy) {
  const Finding found = InDouble(1e-8).add(1, 0).add(1e-11, 1e-15).add(5e-11, 1e-15).judged();
  EXPECT_TRUE(found.violated());
  const Finding below = InDouble(1e-8).add(1, 0).add(1e-13, 1e-17).add(5e-13, 1e-17).judged();
  EXPECT_EQ(below.judgement, Judgement::held);
  EXPECT_NEAR(below.floor, 5e-13, 1e-15);
}

TEST(Noise, AnUndecidedComparisonCountsDownToTheAccuracy) {
  const Finding found = InDouble(1e-8).add(1, 0).add(1e-7, 1e-9).add(1e-7, 1e-9).judged();
  EXPECT_TRUE(found.undecided());
  const Finding below = InDouble(1e-8).add(1, 0).add(5e-9, 1e-11).add(5e-9, 1e-11).judged();
  EXPECT_EQ(below.judgement, Judgement::held);
  EXPECT_NEAR(below.floor, 5e-9, 1e-10);
}

/// A run that is repeated more accurately leaves out no less.
TEST(Noise, WhatIsUndecidedIsLeftOutAlikeAtAllAccuracies) {
  for (const double accuracy : {1e-8, 1e-10, 1e-12}) {
    const Finding below = InDouble(accuracy).add(1, 0).add(5e-9, 1e-11).add(5e-9, 1e-11).judged();
    EXPECT_EQ(below.judgement, Judgement::held);
    EXPECT_NEAR(below.floor, 5e-9, 1e-10);
    EXPECT_TRUE(InDouble(accuracy).add(1, 0).add(5e-9, 0).add(6e-9, 0).judged().violated());
  }
}

TEST(Noise, InDigitsAnUndecidedComparisonCountsDownToTheirFloor) {
  EXPECT_TRUE(InDigits(0).add(1, 0).add(1e-22, 1e-24).add(1e-22, 1e-24).judged().undecided());
  const Finding below = InDigits(0).add(1, 0).add(1e-25, 1e-27).add(1e-25, 1e-27).judged();
  EXPECT_EQ(below.judgement, Judgement::held);
  EXPECT_GT(below.floor, 0);
  const Finding rise = InDigits(0).add(1, 0).add(1e-25, 1e-27).add(2e-25, 1e-27).judged();
  EXPECT_TRUE(rise.violated());
}

TEST(Noise, InDoubleNothingIsLeftOutWithoutIntegration) {
  EXPECT_TRUE(InDouble(0).add(1, 0).add(1e-25, 1e-27).add(1e-25, 1e-27).judged().undecided());
}

/// Two samples of one instant: a value that stays is no more certain than its error.
TEST(Noise, WithinAnInstantAValueHasGrownBeyondAPartOfItsError) {
  const auto judged = [](double rise) {
    return InDouble(1e-8).add(1, 0).add(0.5, 1e-6).add(0.5 + rise, 1e-6, true).judged().judgement;
  };
  EXPECT_EQ(judged(0.05 * 2e-6), Judgement::held);
  EXPECT_EQ(judged(0.5 * 2e-6), Judgement::undecided);
  EXPECT_EQ(judged(3e-6), Judgement::violated);
}

}  // namespace
}  // namespace gainsmith::claims
