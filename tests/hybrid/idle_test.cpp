// What of dynamics and of their campaign has no effect.
#include "hybrid/idle.h"

#include <gtest/gtest.h>

#include "hybrid/doubts.h"
#include "support/event_problem.h"

namespace gainsmith::hybrid {
namespace {

using tests::EventProblem;
using NoiseKind = model::Dynamics::NoiseKind;
using Names = std::vector<std::string>;

/// A clock of one length, a plant that moves.
EventProblem still() {
  EventProblem problem;
  problem.state("x", {}, "1").flow("x", "-x").every("tick", "1", "1").jump("tick", {{"x", "x/2"}});
  return problem;
}

std::optional<std::uint64_t> runs_of(const EventProblem& problem) {
  const System system = problem.system();
  return different_runs(system, make_scenario(10, system));
}

TEST(DifferentRuns, AreOneWhereNothingIsDrawn) {
  EXPECT_EQ(runs_of(still()), 1U);
  EXPECT_EQ(runs_of(still().every("other", "1", "1", "0.5")), 1U);
  EXPECT_EQ(runs_of(still().noise("w", NoiseKind::normal, {"0", "0"})), 1U);
  EXPECT_EQ(runs_of(still().noise("w", NoiseKind::uniform, {"2", "2"})), 1U);
}

TEST(DifferentRuns, HaveNoNumberWhereSomethingIsDrawn) {
  EXPECT_FALSE(runs_of(still().noise("w", NoiseKind::normal, {"0", "0.1"})));
  EXPECT_FALSE(runs_of(still().noise("w", NoiseKind::uniform, {"1", "2"})));
  EXPECT_FALSE(runs_of(still().every("other", "1", "2")));
  EXPECT_FALSE(runs_of(still().lost(0.1)));
}

TEST(DifferentRuns, AreAsManyAsListsAndLawsGive) {
  const EventProblem problem = still().every("other", "1", "2");
  const System system = problem.system();
  Scenario scenario = make_scenario(10, system);
  const auto one = [](double value) { return numbers::Matrix::Constant(1, 1, value); };
  scenario.starts[0] = StartRule{model::StartKind::list, {one(1), one(2), one(3)}, {}, {}};
  EXPECT_FALSE(different_runs(system, scenario)) << "the lengths are uniform";
  scenario.laws[1] = {{model::LawKind::constant, 1, 2, {1.5}}, {model::LawKind::golden, 1, 2, {}}};
  EXPECT_EQ(different_runs(system, scenario), 6U);
  scenario.laws[1].push_back({model::LawKind::extremes, 1, 2, {}});
  EXPECT_FALSE(different_runs(system, scenario));
  scenario.laws[1].pop_back();
  scenario.starts[0] = StartRule{model::StartKind::box, {one(1), one(1)}, {}, {}};
  EXPECT_EQ(different_runs(system, scenario), 2U);
  scenario.starts[0] = StartRule{model::StartKind::box, {one(1), one(2)}, {}, {}};
  EXPECT_FALSE(different_runs(system, scenario));
}

TEST(LateEvents, AreDueAfterTheHorizon) {
  EventProblem problem = still();
  problem.every("late", "11", "12").every("first", "1", "1", "10.5").at("fixed", {"20"});
  problem.every("possible", "9", "12").at("early", {"5", "20"});
  const System system = problem.system();
  Names late;
  for (const std::size_t event : late_events(system, make_scenario(10, system)))
    late.push_back(system.dynamics.events[event].name);
  EXPECT_EQ(late, (Names{"late", "first", "fixed"}));
}

TEST(Doubts, ObserversThatNeverChange) {
  EventProblem problem = still();
  problem.observer("flows").state("a", {}, "0").flow("a", "1");
  problem.observer("jumps").state("b", {}, "0").jump("tick", {{"b", "b + 1"}});
  problem.observer("idle").state("c", {}, "0").state("d", {}, "0");
  problem.observer("stateless");
  const System system = problem.system();
  EXPECT_EQ(doubts_about(system.dynamics, {}, system.constants),
            (Names{"the observer 'idle' never changes: it has no flow, and no map at an event",
                   "no observer reads the plant: their estimates do not depend on an output"}));
}

}  // namespace
}  // namespace gainsmith::hybrid
