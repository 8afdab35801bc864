// The parts of two runs side by side, where events come in the same order and where they do not.
#include "claims/twin_parts.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/event_problem.h"

namespace gainsmith::claims {
namespace {

using EventKind = model::Dynamics::EventKind;
using tests::EventProblem;

/// x and y rise at the rate 1; p counts the times that x comes to 1, q those that y does.
hybrid::System rising(const std::string& x, const std::string& y) {
  EventProblem problem;
  problem.state("x", {}, x).flow("x", "1").state("y", {}, y).flow("y", "1");
  problem.state("p", {}, "0").state("q", {}, "0");
  problem.crossing(EventKind::rises, "first", "x - 1").jump("first", {{"p", "p + 1"}});
  problem.crossing(EventKind::rises, "second", "y - 1").jump("second", {{"q", "q + 1"}});
  return problem.system();
}

hybrid::Trajectory run_of(const hybrid::System& system) {
  const hybrid::Scenario scenario = hybrid::make_scenario(2, system);
  return simulate::Simulator(system, scenario).run(1, 0);
}

/// A run, one whose second event comes so much earlier than the first, and their pairs.
struct Pair {
  explicit Pair(const std::string& own, const std::string& of_twin)
      : system(rising("0", own)),
        run(run_of(system)),
        twin(run_of(rising("0", of_twin))),
        maps(system),
        pairs(pair_twins(run, twin, system, maps)) {}

  double value(const Eigen::VectorXd& values, const char* name) const {
    return tests::part_of(system, values, name)(0);
  }

  hybrid::System system;
  hybrid::Trajectory run, twin;
  simulate::JumpMaps maps;
  TwinParts pairs;
};

TEST(TwinParts, TheSameEventsArePairedOneByOne) {
  const Pair pair("0.5", "0.501");
  ASSERT_TRUE(pair.pairs.whole);
  ASSERT_EQ(pair.pairs.parts.size(), 5U);  // flow, second, flow, first, flow
  const auto& flow = std::get<TwinFlow>(pair.pairs.parts[0]);
  ASSERT_NE(flow.twin, nullptr);
  EXPECT_NEAR(pair.value(flow.twin_at(0.5), "y"), (0.501 + 1) / 2, 1e-9);
  const auto& jump = std::get<TwinJump>(pair.pairs.parts[1]);
  EXPECT_EQ(jump.jump->event, 1U);
  EXPECT_NEAR(jump.twin_t, 0.499, 1e-9);
  EXPECT_NEAR(jump.jump->t, 0.5, 1e-9);
}

TEST(TwinParts, EventsOfOneInstantArePairedInTheOrderOfTheRun) {
  const Pair pair("1e-9", "-1e-9");
  ASSERT_TRUE(pair.pairs.whole);
  std::vector<std::size_t> events;
  const TwinJump* last = nullptr;
  for (const auto& part : pair.pairs.parts)
    if (const auto* jump = std::get_if<TwinJump>(&part)) {
      events.push_back(jump->jump->event);
      last = jump;
    }
  EXPECT_EQ(events, (std::vector<std::size_t>{1, 0}));
  ASSERT_NE(last, nullptr);
  EXPECT_EQ(pair.value(last->twin_before, "q"), 1);  // the twin's second event, taken first
  EXPECT_EQ(pair.value(last->twin_before, "p"), 0);
  EXPECT_EQ(pair.value(last->twin_after, "p"), 1);
}

TEST(TwinParts, EventsThatLieApartAreNotExchanged) {
  const Pair pair("1e-4", "-1e-4");
  EXPECT_FALSE(pair.pairs.whole);
  for (const auto& part : pair.pairs.parts) EXPECT_TRUE(std::holds_alternative<TwinFlow>(part));
}

TEST(TwinParts, AnEventThatTheTwinLacksEndsThePairs) {
  const Pair pair("0.5", "-5");
  EXPECT_FALSE(pair.pairs.whole);
}

}  // namespace
}  // namespace gainsmith::claims
