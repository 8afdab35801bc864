#include "packs/claim_lane.h"

#include <gtest/gtest.h>

#include <cmath>

#include "packs/polynomial_through.h"

namespace gainsmith::packs {
namespace {

using model::ClaimKind;

/// A claim over v along steps of one length; both runs differ by `difference`.
struct Follower {
  PackClaim claim;
  PackSystem system;
  ClaimLane lane;
  double difference = 1e-9;

  Follower(ClaimKind kind, double limit, double tolerance = 0) {
    claim.kind = kind;
    claim.tolerance = tolerance;
    system.accuracy = 1e-8;
    lane.begin(claim, system, {1, 1}, limit);
  }
  Reading reading(double value) const { return {value, value + difference, std::abs(value)}; }

  template <class Value, class Rate>
  ClaimLane along(const Value& value, const Rate& rate, double end, double length) {
    lane.at(0, {value(0.0), value(0.0), std::abs(value(0.0))}, {});
    const auto at = [&](double t) { return Sample{value(t), rate(t)}; };
    for (double t = 0; t < end - length / 2; t += length)
      lane.along(t + length, {length, at(t), at(t + length / 2), at(t + length)},
                 polynomial_through(value, rate, t, length), reading(value(t + length)), false,
                 false);
    lane.finish();
    return lane;
  }
};

const auto kDecay = [](double t) { return std::exp(-t); };
const auto kDecayRate = [](double t) { return -std::exp(-t); };
const auto kSine = [](double t) { return std::sin(t); };
const auto kCosine = [](double t) { return std::cos(t); };

TEST(ClaimLane, ComparesWithABound) {
  // The largest value, 1, lies within a step.
  EXPECT_FALSE(
      Follower(ClaimKind::below, 1.001).along(kSine, kCosine, 3, 0.3).finding().violated());
  EXPECT_FALSE(Follower(ClaimKind::below, 1.001).along(kSine, kCosine, 3, 0.3).open());
  EXPECT_TRUE(Follower(ClaimKind::below, 0.999).along(kSine, kCosine, 3, 0.3).finding().violated());
  EXPECT_TRUE(Follower(ClaimKind::below, 1 + 1e-9).along(kSine, kCosine, 3, 0.3).open());
  EXPECT_NEAR(Follower(ClaimKind::below, 2).along(kSine, kCosine, 3, 0.3).finding().score, -0.5,
              1e-4);
  EXPECT_TRUE(Follower(ClaimKind::above, 0.2).along(kSine, kCosine, 3, 0.3).finding().violated());
  EXPECT_FALSE(Follower(ClaimKind::above, -0.1).along(kSine, kCosine, 3, 0.3).finding().violated());
}

/// x' = 1 on a step that ends at a wall at 1, and passes it by 1e-11: x is no more than 1.
TEST(ClaimLane, AStepThatPassesARootViolatesNothing) {
  const auto x = [](double t) { return 1e-11 + t; };
  const auto rate = [](double) { return 1.0; };
  for (const double late : {0.0, 1e-11}) {
    Follower follower(ClaimKind::below, 1);
    follower.lane.at(0, {x(0), x(0), x(0)}, {});
    const Reading end{x(1), x(1), 1, late};
    follower.lane.along(1, {1, {x(0), 1}, {x(0.5), 1}, {x(1), 1}},
                        polynomial_through(x, rate, 0, 1), end, false, false);
    EXPECT_EQ(follower.lane.finding().violated(), late == 0) << late;
    EXPECT_EQ(follower.lane.open(), late > 0) << late;
  }
}

TEST(ClaimLane, AValueThatNeverRises) {
  Follower held(ClaimKind::nonincreasing, 0);
  EXPECT_FALSE(held.along(kDecay, kDecayRate, 5, 0.25).open());
  EXPECT_FALSE(held.lane.finding().violated());
  EXPECT_NEAR(held.lane.finding().score, std::exp(-5) - 1, 1e-9);
  EXPECT_TRUE(
      Follower(ClaimKind::nonincreasing, 0).along(kSine, kCosine, 1, 0.25).finding().violated());
  // It turns within a step, and both ends are lower than the start.
  const auto turns = [](double t) { return -t + 0.9 * std::sin(1.5 * t); };
  const auto rate = [](double t) { return -1 + 1.35 * std::cos(1.5 * t); };
  const ClaimLane lane = Follower(ClaimKind::nonincreasing, 0).along(turns, rate, 5, 1);
  EXPECT_TRUE(lane.finding().violated() || lane.open());
}

TEST(ClaimLane, AToleranceCountsBetweenPointsToo) {
  const auto wavers = [](double t) { return 1 + 1e-4 * std::sin(t); };
  const auto rate = [](double t) { return 1e-4 * std::cos(t); };
  const auto lane = [&](double tolerance) {
    return Follower(ClaimKind::nonincreasing, 0, tolerance).along(wavers, rate, 7, 0.5);
  };
  EXPECT_FALSE(lane(1e-3).open());
  EXPECT_FALSE(lane(1e-3).finding().violated());
  EXPECT_TRUE(lane(1e-4).finding().violated());
  // The start is 1, the top of the first step lies within it.
  const auto bump = [](double t) { return 1 - 1e-4 * (t - 0.2) * (t - 0.2) * 25 + 1e-4; };
  const auto slope = [](double t) { return -5e-3 * (t - 0.2); };
  Follower follower(ClaimKind::nonincreasing, 0, 0.9e-4);
  const ClaimLane found = follower.along(bump, slope, 0.5, 0.5);
  EXPECT_TRUE(found.open() || found.finding().violated());
}

TEST(ClaimLane, AJumpThatChangesAValueByRoundingLeavesIt) {
  Follower follower(ClaimKind::nonincreasing, 0);
  const auto after_jump = [&](double value) {
    ClaimLane lane;
    lane.begin(follower.claim, follower.system, {1, 1}, 0);
    lane.at(0, {1, 1, 1}, {});
    lane.at(0.5, {value, value + 1e-9, 1}, 0);
    return lane;
  };
  EXPECT_FALSE(after_jump(1 + 2e-16).open());
  EXPECT_TRUE(after_jump(1 + 1e-10).open());
  EXPECT_TRUE(after_jump(1 + 1e-6).finding().violated());
}

TEST(ClaimLane, AValueThatShrinks) {
  EXPECT_FALSE(
      Follower(ClaimKind::shrinks, 0.01).along(kDecay, kDecayRate, 5, 0.25).finding().violated());
  EXPECT_TRUE(
      Follower(ClaimKind::shrinks, 0.001).along(kDecay, kDecayRate, 5, 0.25).finding().violated());
  EXPECT_TRUE(Follower(ClaimKind::shrinks, std::exp(-5)).along(kDecay, kDecayRate, 5, 0.25).open());
}

TEST(ClaimLane, ACostThatIsNeverPositiveCountsAsAWhole) {
  const auto falls = [](double t) { return std::exp(-t) - 1; };
  const ClaimLane lane = Follower(ClaimKind::cost, 2).along(falls, kDecayRate, 5, 0.25);
  EXPECT_FALSE(lane.open());
  EXPECT_NEAR(lane.finding().score, (std::exp(-5) - 1 - 2) / 2, 1e-9);
}

TEST(ClaimLane, RunsThatHavePartedSayNothing) {
  Follower follower(ClaimKind::below, 100);
  follower.difference = 0.1;
  EXPECT_TRUE(follower.along(kSine, kCosine, 3, 0.3).open());
}

TEST(ClaimLane, WhatDoesNotCountYetIsNotCompared) {
  Follower follower(ClaimKind::below, 0.5);
  follower.claim.after = 2.8;
  follower.lane.begin(follower.claim, follower.system, {1, 1}, 0.5);
  EXPECT_FALSE(follower.along(kSine, kCosine, 3, 0.1).finding().violated());
}

}  // namespace
}  // namespace gainsmith::packs
