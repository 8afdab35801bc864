// Runs with events: when they are due, in which order they jump, and what a run leaves.
#include "simulate/simulator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulate/event_runs.h"
#include "support/event_problem.h"
#include "support/input_error.h"

namespace gainsmith::simulate {
namespace {

using Eigen::VectorXd;
using tests::EventProblem;
using tests::jumps_of;
using tests::part_of;
using tests::value_at;
using EventKind = model::Dynamics::EventKind;
using VariableKind = model::Dynamics::VariableKind;

/// The ball of examples.md F.
EventProblem ball(double restitution) {
  EventProblem problem;
  problem.data("r", restitution).data("g", 9.81);
  problem.state("x", {2, 1}, "[4; 2]").flow("x", "[x(2); -g]");
  problem.when("impact", "x(1) <= 0 and x(2) < 0");
  problem.jump("impact", {{"x", "[-x(1); -r*x(2)]"}});
  return problem;
}

TEST(EventRun, TheBallFallsWhereItShould) {
  const hybrid::System system = ball(0.5).system();
  EXPECT_TRUE(system.affine);
  const hybrid::Trajectory run = simulate(system, 4);
  ASSERT_GE(jumps_of(run).size(), 2U);
  const double speed = std::sqrt(4 + 2 * 9.81 * 4);
  EXPECT_NEAR(jumps_of(run)[0].t, (2 + speed) / 9.81, 2e-15);
  EXPECT_NEAR(part_of(system, jumps_of(run)[0].after, "x")(1), speed / 2, 1e-13);
  EXPECT_NEAR(jumps_of(run)[1].t, (2 + 2 * speed) / 9.81, 1e-14);
  expect_contiguous(run);
}

TEST(EventRun, ZenoStopsAtItsAccumulation) {
  for (const double restitution : {0.5, 0.8, 0.95}) {
    const hybrid::System system = ball(restitution).system();
    const hybrid::Trajectory run = simulate(system, 100);
    EXPECT_EQ(run.ending, hybrid::Ending::zeno) << run.message;
    const double expected = 1.129648 + 1.851555 * restitution / (1 - restitution);
    const double speed = std::sqrt(4 + 2 * 9.81 * 4);
    const double exact = (2 + speed) / 9.81 + 2 * speed / 9.81 * restitution / (1 - restitution);
    EXPECT_NEAR(run.accumulation, expected, 2e-5 / (1 - restitution));
    EXPECT_NEAR(run.accumulation, exact, 1e-9 * exact) << restitution;
    EXPECT_LT(run.end, run.accumulation);
    EXPECT_NE(run.message.find("impact"), std::string::npos);
    expect_contiguous(run);
  }
}

TEST(EventRun, ZenoOfTwoTurnsAccumulatesAsWell) {
  EventProblem problem;
  problem.state("x", {2, 1}, "[0; 10]").flow("x", "[x(2); -10]").mode("q", "0");
  problem.when("impact", "x(1) <= 0 and x(2) < 0");
  problem.jump("impact", {{"x", "[-x(1); -where(q == 0, 0.5, 0.9)*x(2)]"}, {"q", "1 - q"}});
  const hybrid::Trajectory run = simulate(problem.system(), 100);
  EXPECT_EQ(run.ending, hybrid::Ending::zeno) << run.message;
  EXPECT_NEAR(run.accumulation, 2 + 2 * (0.5 + 0.45) / (1 - 0.45), 1e-8);
}

TEST(EventRun, FlowsThatShrinkMoreSlowlyAreNoZeno) {
  EventProblem problem;  // lengths 1/k: their sum has no bound
  problem.state("x", {}, "1").flow("x", "-1").state("k", {}, "1");
  problem.when("end", "x <= 0").jump("end", {{"x", "1/(k + 1)"}, {"k", "k + 1"}});
  const hybrid::Trajectory run = simulate(problem.system(), 7);
  EXPECT_EQ(run.ending, hybrid::Ending::horizon) << run.message;
  EXPECT_EQ(jumps_of(run).size(), 615U);  // the sum of 1/k up to 615 is 6.9997
}

TEST(EventRun, AClockAtTheEndOfAStepFiresOnce) {
  EventProblem problem;
  problem.state("x", {}, "1").flow("x", "-x + sin(x)").state("n", {}, "0");
  problem.every("tick", "0.1", "0.1").jump("tick", {{"n", "n + 1"}});
  problem.when("edge", "t >= 0.7");  // at a time of the clock, to rounding
  problem.number(VariableKind::count, "count(tick)", "tick");
  problem.number(VariableKind::since, "since(tick)", "tick");
  problem.number(VariableKind::left, "tick.left", "tick");
  problem.only_if("done == 0").mode("done", "0").jump("edge", {{"done", "1"}});
  const hybrid::System system = problem.system();
  const hybrid::Trajectory run = simulate(system, 3);
  const std::vector<double> times = jump_times(run);
  ASSERT_EQ(times.size(), 30U);
  for (std::size_t k = 0; k < times.size(); ++k)
    EXPECT_NEAR(times[k], 0.1 * static_cast<double>(k + 1), 1e-15 * times[k]);
  EXPECT_EQ(jump_times(run, 1).size(), 1U);
  EXPECT_EQ(part_of(system, jumps_of(run).back().after, "count(tick)")(0), 30);
  EXPECT_EQ(run.end, 3);
  EXPECT_EQ(run.ending, hybrid::Ending::horizon);
  EXPECT_NEAR(value_at(system, run, "since(tick)", 1.03)(0), 0.03, 1e-14);
  EXPECT_NEAR(value_at(system, run, "tick.left", 1.03)(0), 0.07, 1e-14);
  for (const hybrid::JumpPoint& jump : jumps_of(run))
    if (jump.event == 0) {
      EXPECT_LE(part_of(system, jump.before, "tick.left")(0), 1e-15);
      EXPECT_NEAR(part_of(system, jump.after, "tick.left")(0), 0.1, 1e-15);
    }
  expect_contiguous(run);
}

TEST(EventRun, AJumpIntoTheJumpSetJumpsAgain) {
  EventProblem problem;
  problem.state("x", {}, "0").flow("x", "1");
  problem.when("over", "x >= 1").jump("over", {{"x", "x - 0.75"}});
  problem.at("kick", {"0.5"}).jump("kick", {{"x", "x + 2"}});
  const hybrid::System system = problem.system();
  const auto jumps = jumps_of(simulate(system, 0.6));
  // 0.5 -> 2.5 -> 1.75 -> 1 -> 0.25, where it flows again.
  ASSERT_EQ(jumps.size(), 4U);
  EXPECT_EQ(jumps[0].event, 1U);
  for (const hybrid::JumpPoint& jump : jumps) EXPECT_EQ(jump.t, 0.5);
  EXPECT_EQ(part_of(system, jumps.back().after, "x")(0), 0.25);
}

TEST(EventRun, TwoGuardsAtOneInstantGoInOrder) {
  EventProblem problem;
  problem.state("x", {}, "0").flow("x", "1").state("log", {}, "0");
  problem.when("second", "x >= 1 and log == 1").when("first", "x >= 1 and log <= 1");
  problem.jump("second", {{"log", "20 + log"}}).jump("first", {{"log", "1 + 10*log"}});
  const hybrid::System system = problem.system();
  const auto jumps = jumps_of(simulate(system, 2));
  // first is due alone; then both, and the one that stands before jumps.
  ASSERT_EQ(jumps.size(), 2U);
  EXPECT_EQ(jumps[0].event, 1U);
  EXPECT_EQ(jumps[1].event, 0U);
  EXPECT_EQ(jumps[0].t, jumps[1].t);
  EXPECT_EQ(part_of(system, jumps[1].after, "log")(0), 21);
}

TEST(EventRun, APairOfRootsNearATouchAndAValueThatIsNotReached) {
  EventProblem problem;
  problem.data("d", 1e-9).state("x", {}, "1 - d").flow("x", "2*t - 2");
  problem.when("in", "x <= 0 and q == 0").when("out", "x > 0 and q == 1").mode("q", "0");
  problem.jump("in", {{"q", "1"}}).jump("out", {{"q", "2"}});
  const hybrid::System system = problem.system();
  const auto jumps = jumps_of(simulate(system, 5));
  ASSERT_EQ(jumps.size(), 2U);
  const double half = std::sqrt(1e-9);
  EXPECT_NEAR(jumps[0].t, 1 - half, 1e-10);
  EXPECT_NEAR(jumps[1].t, 1 + half, 1e-10);

  EventProblem graze;
  graze.data("d", -1e-12).state("x", {}, "1 - d").flow("x", "2*t - 2");
  graze.when("in", "x <= 0").jump("in", {{"x", "5"}});
  const hybrid::Trajectory near = simulate(graze.system(), 5);
  EXPECT_TRUE(jumps_of(near).empty());
  ASSERT_EQ(near.notes.size(), 1U);
  EXPECT_NE(near.notes[0].find("x <= 0"), std::string::npos);
}

// What comes near to 0 beside its terms is to be compared with the difference of two runs.
TEST(EventRun, ATwinKeepsTurningPointsNextToZero) {
  for (const double gap : {1e-5, 0.1}) {
    EventProblem problem;
    problem.data("d", gap).state("x", {}, "1 + d").flow("x", "2*t - 2").state("n", {}, "0");
    problem.when("in", "x + 1 <= 1").jump("in", {{"n", "n + 1"}});
    const hybrid::System system = problem.system();
    const hybrid::Scenario scenario = hybrid::make_scenario(2.5, system);
    const hybrid::Trajectory twin = Simulator(system, scenario).run(1, 0, {}, {}, 0);
    ASSERT_EQ(twin.turns.size(), gap < 0.01 ? 1U : 0U) << gap;
    if (gap > 0.01) continue;
    EXPECT_NEAR(twin.turns[0].t, 1, 1e-6);
    EXPECT_NEAR(twin.turns[0].value, -gap, 1e-10);  // of 1 - (x + 1)
  }
}

TEST(EventRun, JumpsSeeTheValuesBeforeThemAndMapsFollowEachOther) {
  EventProblem problem;
  problem.state("x", {}, "1").at("go", {"1"}).jump("go", {{"x", "x + 1"}});
  problem.observer("first").state("a", {}, "0").state("b", {}, "0");
  problem.jump("go", {{"a", "x"}, {"b", "a"}}).jump("go", {{"a", "10*a + x"}, {"b", "a"}});
  problem.observer("second").state("c", {}, "7").jump("go", {{"c", "a + x"}});
  const hybrid::System system = problem.system();
  const auto jumps = jumps_of(simulate(system, 2));
  ASSERT_EQ(jumps.size(), 1U);
  const VectorXd& after = jumps[0].after;
  EXPECT_EQ(part_of(system, after, "x")(0), 2);
  EXPECT_EQ(part_of(system, after, "a")(0), 11);
  EXPECT_EQ(part_of(system, after, "b")(0), 1);
  EXPECT_EQ(part_of(system, after, "c")(0), 1);
}

TEST(EventRun, LoopsStopWhereTheyShould) {
  EventProblem problem;
  problem.state("x", {}, "1").at("go", {"1"}).number(VariableKind::passes, "passes(go)", "go");
  EventProblem enough = problem;
  enough.repeat("go", {{"x", "x/2"}}, "x <= 0.1", "100");
  const hybrid::System system = enough.system();
  const auto jumps = jumps_of(simulate(system, 2));
  EXPECT_EQ(part_of(system, jumps[0].after, "x")(0), 1.0 / 16);
  EXPECT_EQ(part_of(system, jumps[0].after, "passes(go)")(0), 4);

  EventProblem few = problem;
  few.repeat("go", {{"x", "x/2"}}, "x <= 0.1", "3");
  const hybrid::Trajectory ended = simulate(few.system(), 2);
  EXPECT_EQ(ended.ending, hybrid::Ending::passes);
  EXPECT_EQ(ended.end, 1);
  EXPECT_NE(ended.message.find("3 passes"), std::string::npos) << ended.message;

  EventProblem goes_on = problem;
  goes_on.repeat("go", {{"x", "x/2"}}, "x <= 0.1", "3", true);
  const hybrid::System other = goes_on.system();
  EXPECT_EQ(part_of(other, jumps_of(simulate(other, 2))[0].after, "x")(0), 1.0 / 8);
}

TEST(EventRun, ObserversSkipWhatIsLost) {
  EventProblem problem;
  problem.state("x", {}, "0").every("tick", "1", "1").lost(0.7, 2).jump("tick", {{"x", "x + 1"}});
  problem.observer("o").state("n", {}, "0").jump("tick", {{"n", "n + 1"}});
  const hybrid::System system = problem.system();
  const auto jumps = jumps_of(simulate(system, 100));
  ASSERT_EQ(jumps.size(), 100U);
  int seen = 0;
  int row = 0;
  int longest = 0;
  for (const hybrid::JumpPoint& jump : jumps) {
    row = jump.lost ? row + 1 : 0;
    longest = std::max(longest, row);
    if (!jump.lost) ++seen;
    EXPECT_EQ(part_of(system, jump.after, "n")(0), seen);
  }
  EXPECT_EQ(longest, 2);
  EXPECT_GT(seen, 30);
  EXPECT_LT(seen, 70);
  EXPECT_EQ(part_of(system, jumps.back().after, "x")(0), 100);
}

TEST(EventRun, AnOccurrenceThatIfRejectsIsSpent) {
  EventProblem problem;
  problem.state("x", {}, "0").flow("x", "cos(t)").state("n", {}, "0").state("m", {}, "0");
  problem.every("tick", "1", "1").only_if("x > 0").jump("tick", {{"n", "n + 1"}});
  problem.when("high", "x >= 0.5").only_if("t > 3").jump("high", {{"x", "x - 1"}, {"m", "m + 1"}});
  const hybrid::System system = problem.system();
  const hybrid::Trajectory run = simulate(system, 6.2);
  // sin > 0.5 over (0.52, 2.62) is rejected once; x = sin t > 0 at 1, 2, 3 and not at 4, 5, 6.
  EXPECT_EQ(jump_times(run, 0), (std::vector<double>{1, 2, 3}));
  EXPECT_TRUE(jump_times(run, 1).empty());
  EXPECT_EQ(jump_times(simulate(system, 8), 1).size(), 1U);
}

TEST(EventRun, FrozenComponentsRestAndSteadyStatesAreExact) {
  EventProblem problem;
  problem.state("x", {2, 1}, "[1; 0]").flow("x", "[x(2); -sin(x(1))]");
  problem.observer("o").frozen("q == 1").mode("q", "0").state("s", {}, "0").flow("s", "1");
  problem.state("y", {}, "1").flow("y", "-y");
  problem.when("stop", "q == 0 and s >= 0.7").jump("stop", {{"q", "1"}});
  problem.at("restart", {"2"}).jump("restart", {{"q", "0"}, {"s", "0"}});
  const hybrid::System system = problem.system();
  const hybrid::Trajectory run = simulate(system, 4);
  EXPECT_EQ(jump_times(run, 0), (std::vector<double>{0.7, 2.7}));
  EXPECT_EQ(value_at(system, run, "s", 1.5)(0), 0.7);
  EXPECT_NEAR(value_at(system, run, "y", 1.9)(0), std::exp(-0.7), 1e-9);
  EXPECT_NEAR(value_at(system, run, "y", 2.5)(0), std::exp(-1.2), 1e-9);
  expect_contiguous(run);
}

TEST(EventRun, BothFlowsAgree) {
  EventProblem problem;
  problem.data("A", numbers::Matrix{{-0.3, 2}, {-1, 0.1}});
  problem.state("x", {2, 1}, "[1; 0]").flow("x", "A*x + [0; t]").state("u", {}, "0");
  problem.symmetric("P", 2, "[2, 1; 1, 3]").flow("P", "A*P + P*A' + [1, 0; 0, 1]");
  problem.every("hold", "0.3", "0.3").jump("hold", {{"u", "-x(1)"}, {"x", "x + [0; u]"}});
  const hybrid::System exact = problem.system();
  ASSERT_TRUE(exact.affine);
  hybrid::System integrated = exact;
  integrated.affine = false;
  const hybrid::Trajectory a = simulate(exact, 3);
  const hybrid::Trajectory b = simulate(integrated, 3);
  ASSERT_EQ(jumps_of(a).size(), jumps_of(b).size());
  const double size = jumps_of(a).back().after.cwiseAbs().maxCoeff();
  EXPECT_LT((jumps_of(a).back().after - jumps_of(b).back().after).cwiseAbs().maxCoeff(),
            1e-8 * size);
  for (const double t : {0.1, 1.37, 2.9}) {
    EXPECT_LT((value_at(exact, a, "P", t) - value_at(integrated, b, "P", t)).norm(), 1e-8 * size);
    const numbers::Matrix P = value_at(exact, a, "P", t);
    EXPECT_EQ(P(0, 1), P(1, 0));
  }
}

TEST(EventRun, ARunIsAFunctionOfItsSeedAndNumber) {
  EventProblem problem;
  problem.state("x", {}, "1").flow("x", "-x^3 + w").every("tick", "0.1", "0.5");
  problem.noise("w", model::Dynamics::NoiseKind::normal, {"0", "0.3"}, "tick");
  problem.noise("v", model::Dynamics::NoiseKind::uniform, {"-1", "1"}, "", "0.25");
  problem.jump("tick", {{"x", "x + 0.1*w + 0.01*v"}});
  const hybrid::System system = problem.system();
  const hybrid::Scenario scenario = hybrid::make_scenario(10, system);
  Simulator simulator(system, scenario);
  const hybrid::Trajectory first = simulator.run(5, 3);
  const hybrid::Trajectory other = simulator.run(5, 4);
  const hybrid::Trajectory again = Simulator(system, scenario).run(5, 3);
  ASSERT_EQ(first.parts.size(), again.parts.size());
  for (std::size_t k = 0; k < first.parts.size(); ++k) {
    const auto* jump = std::get_if<hybrid::JumpPoint>(&first.parts[k]);
    if (jump == nullptr) continue;
    EXPECT_EQ(jump->t, std::get<hybrid::JumpPoint>(again.parts[k]).t);
    EXPECT_EQ(jump->after, std::get<hybrid::JumpPoint>(again.parts[k]).after);
  }
  EXPECT_NE(jumps_of(first)[0].t, jumps_of(other)[0].t);
  double before = 0;
  for (const hybrid::JumpPoint& jump : jumps_of(first)) {
    EXPECT_GE(jump.t - before, 0.1 - 1e-14);
    EXPECT_LE(jump.t - before, 0.5 + 1e-14);
    before = jump.t;
  }
  EXPECT_NE(value_at(system, first, "v", 0.1)(0), value_at(system, first, "v", 0.4)(0));
  expect_contiguous(first);
}

TEST(EventRun, TheDrawsOfOneEventDoNotDependOnAnother) {
  EventProblem problem;
  problem.state("x", {}, "0").every("tick", "0.1", "0.5");
  EventProblem more = problem;
  more.every("tock", "0.01", "0.02");
  const hybrid::Trajectory a = simulate(problem.system(), 5);
  const hybrid::Trajectory b = simulate(more.system(), 5);
  EXPECT_EQ(jump_times(a), jump_times(b));
  EXPECT_GT(jump_times(b, 1).size(), 200U);
}

}  // namespace
}  // namespace gainsmith::simulate
