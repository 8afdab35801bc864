#include "response/time_response.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "response/systems.h"

namespace gainsmith::response {
namespace {

TEST(Steps, OfOneStateAreExponentials) {
  const StateSpace system{Matrix{{-2}}, Matrix{{3}}, Matrix{{4}}, Matrix{{0.5}}, 0};
  const TimeResponse step = time_response(system, Stimulus::step, 0, 3, 31);
  const TimeResponse impulse = time_response(system, Stimulus::impulse, 0, 3, 31);
  for (std::size_t k = 0; k < step.t.size(); ++k) {
    const double t = 0.1 * static_cast<double>(k);
    const auto at = static_cast<Eigen::Index>(k);
    EXPECT_NEAR(step.t[k], t, 1e-12);
    EXPECT_NEAR(step.y(0, at), 0.5 + 6 * (1 - std::exp(-2 * t)), 1e-12);
    EXPECT_NEAR(impulse.y(0, at), 12 * std::exp(-2 * t), 1e-12);
  }
}

TEST(Steps, OfSampledSystemsAreSums) {
  const StateSpace system{Matrix{{0.5}}, Matrix{{1}}, Matrix{{2}}, Matrix{{0}}, 0.25};
  const TimeResponse step = time_response(system, Stimulus::step, 0, 2);
  const TimeResponse impulse = time_response(system, Stimulus::impulse, 0, 2);
  ASSERT_EQ(step.t.size(), 9U);
  EXPECT_EQ(step.t[3], 0.75);
  EXPECT_EQ(step.y, (Matrix{{0, 2, 3, 3.5, 3.75, 3.875, 3.9375, 3.96875, 3.984375}}));
  EXPECT_EQ(impulse.y.leftCols(4), (Matrix{{0, 8, 4, 2}}));
}

TEST(Steps, HaveTheFactsOfTheBook) {
  for (const double damping : {0.01, 0.2, 0.5, 0.7}) {
    const auto facts = step_facts(oscillator(2, damping), 0, 0);
    ASSERT_TRUE(facts);
    EXPECT_NEAR(facts->final_value, 1, 1e-12);
    const double root = std::sqrt(1 - damping * damping);
    EXPECT_NEAR(facts->overshoot, std::exp(-damping * std::numbers::pi / root), 1e-6);
    EXPECT_NEAR(facts->largest_at, std::numbers::pi / (2 * root), 1e-4);
    EXPECT_NEAR(facts->largest, 1 + facts->overshoot, 1e-12);
    // The envelope is at 2 % then.
    EXPECT_LT(facts->settling, -std::log(0.02 * root) / (2 * damping) + 1e-3);
    EXPECT_GT(facts->settling, 1 / (2 * damping));
  }
  EXPECT_FALSE(step_facts(oscillator(2, 1e-6), 0, 0));
}

TEST(Steps, OfLagsAreThatOfTheirMode) {
  for (const double rate : {1e-6, 1.0, 1e6}) {
    const StateSpace lag{Matrix{{-rate}}, Matrix{{rate}}, Matrix{{1}}, Matrix{{0}}, 0};
    const auto facts = step_facts(lag, 0, 0);
    ASSERT_TRUE(facts);
    EXPECT_NEAR(facts->rise * rate, std::log(9), 1e-4);
    EXPECT_NEAR(facts->settling * rate, std::log(50), 1e-4);
    EXPECT_LT(facts->overshoot, 1e-6);
  }
}

/// A fast mode beside a slow one is seen, whatever the slow one takes.
TEST(Steps, OfSeveralModesSeeEach) {
  const StateSpace both{Matrix{{-100, 0}, {0, -1e-3}}, Matrix{{100}, {1e-3}}, Matrix{{1, 0.01}},
                        Matrix{{0}}, 0};
  const auto facts = step_facts(both, 0, 0);
  ASSERT_TRUE(facts);
  EXPECT_NEAR(facts->final_value, 1.01, 1e-12);
  EXPECT_NEAR(facts->rise, (std::log(1 - 0.101) - std::log(1 - 0.909)) / 100, 1e-4);
  // A fast lag less a slow one: it rises to nearly 1 and ends at 0.
  const StateSpace pulse{Matrix{{-10, 0}, {0, -1e-3}}, Matrix{{10}, {1e-3}}, Matrix{{1, -1}},
                         Matrix{{0}}, 0};
  const auto peak = step_facts(pulse, 0, 0);
  ASSERT_TRUE(peak);
  EXPECT_TRUE(peak->ends_at_0());
  EXPECT_NEAR(peak->largest, 1, 1e-2);
  EXPECT_LT(peak->largest_at, 2);
}

TEST(Steps, GoTheOtherWay) {
  // (1 - s)/(s + 1)^2: 1 - 2 exp(-1/2) at t = 1/2 is its least value.
  const StateSpace system{Matrix{{-2, -1}, {1, 0}}, Matrix{{1}, {0}}, Matrix{{-1, 1}}, Matrix{{0}},
                          0};
  const auto facts = step_facts(system, 0, 0);
  ASSERT_TRUE(facts);
  EXPECT_NEAR(facts->undershoot, 2 * std::exp(-0.5) - 1, 1e-6);
}

TEST(Steps, OfSampledSystemsHaveFactsToo) {
  const StateSpace dead_beat{Matrix{{0, 0}, {1, 0}}, Matrix{{1}, {0}}, Matrix{{0.5, 0.5}},
                             Matrix{{0}}, 0.1};
  const auto facts = step_facts(dead_beat, 0, 0);
  ASSERT_TRUE(facts);
  EXPECT_EQ(facts->final_value, 1);
  EXPECT_EQ(facts->overshoot, 0);
  EXPECT_EQ(facts->settling, 0.2);
  EXPECT_EQ(facts->rise, 0.1);
}

TEST(Durations, FollowTheSlowestMode) {
  const StateSpace slow{Matrix{{-0.01, 0}, {0, -100}}, Matrix{{1}, {1}}, Matrix{{1, 1}},
                        Matrix{{0}}, 0};
  EXPECT_NEAR(duration_of(slow), 700, 1e-9);
  const StateSpace grows{Matrix{{2}}, Matrix{{1}}, Matrix{{1}}, Matrix{{0}}, 0};
  EXPECT_NEAR(duration_of(grows), std::log(100) / 2, 1e-9);
  const StateSpace rests{Matrix{{0}}, Matrix{{1}}, Matrix{{1}}, Matrix{{0}}, 0};
  EXPECT_GT(duration_of(rests), 0);
}

}  // namespace
}  // namespace gainsmith::response
