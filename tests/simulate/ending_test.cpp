// How runs with events end, and branches of flows.
#include <gtest/gtest.h>

#include <cmath>

#include "base/number.h"
#include "support/event_problem.h"
#include "support/input_error.h"
#include "support/stop.h"

namespace gainsmith::simulate {
namespace {

using tests::EventProblem;
using tests::input_error;
using tests::jumps_of;
using tests::part_of;
using tests::value_at;

hybrid::Trajectory run_to(const hybrid::System& system, double horizon) {
  const hybrid::Scenario scenario = hybrid::make_scenario(horizon, system);
  return Simulator(system, scenario).run(1, 0);
}

void expect_says(const hybrid::Trajectory& run, const std::string& text) {
  EXPECT_NE(run.message.find(text), std::string::npos) << run.message;
}

TEST(EventEnding, AChainOfJumpsWithoutFlowNamesTheEventAndItsValue) {
  EventProblem problem;
  problem.state("x", {}, "0").flow("x", "1").when("over", "x >= 1").jump("over", {{"x", "x + 1"}});
  const hybrid::Trajectory run = run_to(problem.system(), 5);
  EXPECT_EQ(run.ending, hybrid::Ending::stuck);
  EXPECT_NEAR(run.end, 1, 1e-15);
  expect_says(run, "the event over is due again");
  expect_says(run, "x >= 1");
  expect_says(run, "leaves the condition true");
  EXPECT_LT(jumps_of(run).size(), 2000U);

  EventProblem two;
  two.state("x", {}, "1").flow("x", "1");
  two.when("up", "x >= 2").jump("up", {{"x", "0"}});
  two.when("down", "x <= 0").jump("down", {{"x", "2"}});
  const hybrid::Trajectory both = run_to(two.system(), 5);
  EXPECT_EQ(both.ending, hybrid::Ending::stuck);
  expect_says(both, "of up, down");
}

TEST(EventEnding, EscapesNameTheirTime) {
  EventProblem problem;
  problem.state("x", {}, "1").flow("x", "x^2");
  const hybrid::Trajectory run = run_to(problem.system(), 5);
  EXPECT_EQ(run.ending, hybrid::Ending::escaped) << run.message;
  EXPECT_NEAR(run.end, 1, 1e-3);
  EventProblem linear;
  linear.state("x", {}, "1").flow("x", "1000*x");
  const hybrid::Trajectory far = run_to(linear.system(), 5);
  EXPECT_EQ(far.ending, hybrid::Ending::escaped);
  EXPECT_NEAR(far.end, 0.345, 0.01);
  expect_says(far, "x = ");
}

TEST(EventEnding, TextsWithoutAValueNameTheirPlace) {
  EventProblem flow;
  flow.state("x", {}, "1").flow("x", "-sqrt(x)/x");
  const hybrid::Trajectory run = run_to(flow.system(), 5);
  EXPECT_EQ(run.ending, hybrid::Ending::undefined) << run.message;
  EXPECT_NEAR(run.end, 2.0 / 3, 1e-3);
  expect_says(run, "sqrt");
  EventProblem jump;
  jump.state("x", {}, "1").at("go", {"1"}).jump("go", {{"x", "log(x - 2)"}});
  const hybrid::Trajectory at = run_to(jump.system(), 5);
  EXPECT_EQ(at.ending, hybrid::Ending::undefined);
  EXPECT_EQ(at.end, 1);
  expect_says(at, "test:1:1");
}

TEST(EventEnding, StepsThatHardlyAdvanceEndARun) {
  // It comes to 0 at t = 1.118 and does not rest there: its rate has the norm 1.
  EventProblem problem;
  problem.state("x", {2, 1}, "[1; 0.5]").flow("x", "-x/norm(x)");
  const hybrid::Trajectory run = run_to(problem.system(), 3);
  EXPECT_EQ(run.ending, hybrid::Ending::lost);
  EXPECT_NEAR(run.end, 1.118034, 1e-4);
  expect_says(run, "too short");
}

TEST(EventEnding, LeavingTheFlowSetSaysWhy) {
  EventProblem problem;
  problem.state("x", {}, "0").flow("x", "cos(t)").flow_set("x <= 0.5", "too far");
  const hybrid::Trajectory run = run_to(problem.system(), 5);
  EXPECT_EQ(run.ending, hybrid::Ending::left);
  EXPECT_NEAR(run.end, std::asin(0.5), 1e-8);
  expect_says(run, "too far");
  EventProblem ball;
  ball.state("x", {2, 1}, "[1; 0]").flow("x", "[x(2); -10]").flow_set("x(1) >= 0", "below ground");
  ball.when("impact", "x(1) <= 0 and x(2) < 0").jump("impact", {{"x", "[x(1); -x(2)]"}});
  const hybrid::Trajectory bounces = run_to(ball.system(), 5);
  EXPECT_EQ(bounces.ending, hybrid::Ending::horizon) << bounces.message;
  EXPECT_EQ(jumps_of(bounces).size(), 6U);
  EventProblem out;
  out.state("x", {}, "0").flow_set("x <= 1", "out").at("go", {"1"}).jump("go", {{"x", "2"}});
  EXPECT_EQ(run_to(out.system(), 5).end, 1);
}

TEST(EventEnding, ARelayWithoutHysteresisChatters) {
  EventProblem problem;
  problem.state("x", {}, "1").flow("x", "-q").mode("q", "1");
  problem.when("plus", "x > 0 and q == -1").jump("plus", {{"q", "1"}});
  problem.when("minus", "x < 0 and q == 1").jump("minus", {{"q", "-1"}});
  const hybrid::Trajectory run = run_to(problem.system(), 5);
  EXPECT_EQ(run.ending, hybrid::Ending::chattering) << run.message;
  EXPECT_NEAR(run.end, 1, 1e-9);
  expect_says(run, "plus");
  expect_says(run, "minus");
}

TEST(EventEnding, ACounterThatEndsShrinkingIsNoZeno) {
  EventProblem problem;
  problem.state("s", {}, "0").flow("s", "1").state("k", {}, "1");
  problem.when("g", "s >= 0.5^k").jump("g", {{"s", "0"}, {"k", "where(k > 20, -3, k + 1)"}});
  const hybrid::Trajectory run = run_to(problem.system(), 20);
  EXPECT_EQ(run.ending, hybrid::Ending::horizon) << run.message;
}

// Three flows of one last place each, after others that do not shrink.
TEST(EventEnding, AFewJumpsOfOneInstantAreNoZeno) {
  EventProblem problem;
  problem.state("v", {}, "0").flow("v", "-1.3333").state("k", {}, "0").every("a", "0.25", "0.25");
  problem.when("g", "v < -1 and k < 4").jump("g", {{"v", "-1"}, {"k", "k + 1"}});
  problem.when("reset", "t >= 1.5 and k == 4").jump("reset", {{"k", "5"}});
  const hybrid::Trajectory run = run_to(problem.system(), 2);
  EXPECT_EQ(run.ending, hybrid::Ending::horizon) << run.message;
}

// Seven flights of a ball that keeps a tenth of its speed are all that numbers can tell apart.
TEST(EventEnding, AFewFlightsThatShrinkFastAccumulate) {
  for (const double r : {0.001, 0.05, 0.1, 0.24, 0.99}) {
    EventProblem problem;
    problem.state("x", {}, "0").state("v", {}, "4").flow("x", "v").flow("v", "-9.81");
    problem.when("hit", "x <= 0 and v < 0").jump("hit", {{"v", "-" + brief(r, 17) + "*v"}});
    const hybrid::Trajectory run = run_to(problem.system(), 100);
    EXPECT_EQ(run.ending, hybrid::Ending::zeno) << r << " " << run.message;
    const double time = 8 / 9.81 / (1 - r);
    EXPECT_NEAR(run.accumulation, time, 1e-9 * time) << r;
  }
}

TEST(EventEnding, StoppedFromOutside) {
  EventProblem problem;
  problem.state("x", {}, "1").flow("x", "-x").every("tick", "1", "1");
  const hybrid::System system = problem.system();
  const hybrid::Scenario scenario = hybrid::make_scenario(1e6, system);
  Simulator simulator(system, scenario);
  const tests::StopInTest stop(true);
  const hybrid::Trajectory run = simulator.run(1, 0);
  EXPECT_EQ(run.ending, hybrid::Ending::interrupted);
  EXPECT_LT(run.end, 1e6);
}

TEST(EventEnding, StatesThatAreNoneOfTheirKindAreErrors) {
  EventProblem mode;
  mode.mode("q", "0").at("go", {"1"}).jump("go", {{"q", "0.5"}});
  const hybrid::System halves = mode.system();
  EXPECT_NE(input_error([&] { run_to(halves, 2); }).message().find("whole number"),
            std::string::npos);
  EventProblem matrix;
  matrix.symmetric("P", 2, "[1, 0; 0, 1]").flow("P", "[1, 2; 3, 4]*P");
  const hybrid::System skew = matrix.system();
  EXPECT_NE(input_error([&] { run_to(skew, 2); }).message().find("P is symmetric"),
            std::string::npos);
  EventProblem jump;
  jump.symmetric("P", 2, "[1, 0; 0, 1]").at("go", {"1"});
  jump.jump("go", {{"P", "[1, 1e-6; 0, 1]*P"}});
  const hybrid::System other = jump.system();
  EXPECT_NE(input_error([&] { run_to(other, 2); }).message().find("P is symmetric"),
            std::string::npos);
}

TEST(EventSwitch, BranchesAreFixedAndChangeAtTheirZeroCrossing) {
  for (const bool exact : {true, false}) {
    EventProblem problem;
    problem.state("x", {}, "1")
        .flow("x", exact ? "where(x > 0.5, -1, -x)" : "where(x > 0.5, -1, -sin(x))");
    problem.state("z", {}, "-1").flow("z", "sign(z + 0.5) + 1.5");
    const hybrid::System system = problem.system();
    EXPECT_EQ(system.affine, exact);
    EXPECT_EQ(system.switches.size(), 2U);
    const hybrid::Trajectory run = run_to(system, 3);
    EXPECT_EQ(run.ending, hybrid::Ending::horizon) << run.message;
    EXPECT_TRUE(jumps_of(run).empty());
    ASSERT_EQ(run.parts.size(), 1U);
    const double x = exact ? 0.5 * std::exp(-1.5) : 2 * std::atan(std::tan(0.25) * std::exp(-1.5));
    EXPECT_NEAR(value_at(system, run, "x", 2)(0), x, exact ? 1e-14 : 1e-9);
    // 0.5 up to t = 1, where z = -0.5, then 2.5.
    EXPECT_NEAR(value_at(system, run, "z", 2)(0), 2, 1e-14);
  }
}

TEST(EventSwitch, BranchesThatBothLeadBackSlide) {
  EventProblem problem;
  problem.state("x", {2, 1}, "[1; 0]").flow("x", "[-sign(x(1)) + 0.25; 1]");
  const hybrid::Trajectory run = run_to(problem.system(), 5);
  EXPECT_EQ(run.ending, hybrid::Ending::sliding) << run.message;
  EXPECT_NEAR(run.end, 4.0 / 3, 1e-9);
  EventProblem relay;
  relay.state("x", {}, "1").flow("x", "where(x >= 0.3, -1 - x^2, 1)");
  EXPECT_EQ(run_to(relay.system(), 5).ending, hybrid::Ending::sliding);
}

// x = (1 - t)^2 comes to rest on the switching surface, and stays there.
TEST(EventSwitch, ARateThatFallsToNothingOnTheSurfaceRests) {
  EventProblem problem;
  problem.state("x", {}, "1").flow("x", "-2*sign(x)*abs(x)^0.5");
  const hybrid::System system = problem.system();
  const hybrid::Trajectory run = run_to(system, 5);
  EXPECT_EQ(run.ending, hybrid::Ending::horizon) << run.message;
  for (const double t : {0.3, 0.99, 1.01, 2.0, 5.0})
    EXPECT_NEAR(value_at(system, run, "x", t)(0), t < 1 ? (1 - t) * (1 - t) : 0, 1e-9) << t;
  EventProblem small;  // 1e-4 is no noise
  small.state("x", {2, 1}, "[1e-4; 0]").flow("x", "[x(2); -sign(x(1))*(1e-4 + x(1)^2)]");
  EXPECT_EQ(run_to(small.system(), 1000).ending, hybrid::Ending::horizon);
}

// Two tanks with equal levels: the difference starts in its rounding and is only crossed.
/// a(1) of the system below by Euler's rule. A function and no lambda, which GCC would evaluate while it compiles.
double euler(int steps) {
  double a = 1;
  double b = 1;
  for (int k = 0; k < steps; ++k) {
    const double over = 0.5 * std::sqrt(std::abs(a - b));
    const double out = 0.4 * std::sqrt(b);
    a += (0.8 - over) / steps;
    b += (over - out) / steps;
  }
  return a;
}

TEST(EventSwitch, ACrossingInTheRoundingIsNoSliding) {
  EventProblem problem;
  problem.state("a", {}, "1").state("b", {}, "1");
  problem.flow("a", "0.8 - 0.5*sign(a - b)*sqrt(abs(a - b))");
  problem.flow("b", "0.5*sign(a - b)*sqrt(abs(a - b)) - 0.4*sign(b)*sqrt(abs(b))");
  const hybrid::System system = problem.system();
  const hybrid::Trajectory run = run_to(system, 1);
  ASSERT_EQ(run.ending, hybrid::Ending::horizon) << run.message;
  // The errors of Euler's rule halve with its steps.
  EXPECT_NEAR(value_at(system, run, "a", 1)(0), 2 * euler(2000000) - euler(1000000), 1e-6);
}

TEST(EventSwitch, BranchesOfTimeAreSteppedTo) {
  EventProblem problem;
  problem.state("x", {}, "0").flow("x", "where(t >= 1, where(t < 2, 3, 0), sin(x))");
  const hybrid::System system = problem.system();
  const hybrid::Trajectory run = run_to(system, 3);
  EXPECT_NEAR(value_at(system, run, "x", 3)(0), 3, 1e-13);
}

TEST(EventFlow, StiffFlowsAreFollowed) {
  EventProblem problem;
  problem.state("x", {2, 1}, "[2; 0]").flow("x", "[x(2); 1000*((1 - x(1)^2)*x(2)) - x(1)]");
  problem.crossing(model::Dynamics::EventKind::falls, "fall", "x(1)");
  const hybrid::System system = problem.system();
  const hybrid::Trajectory run = run_to(system, 2000);
  EXPECT_EQ(run.ending, hybrid::Ending::horizon) << run.message;
  ASSERT_EQ(jumps_of(run).size(), 1U);
  EXPECT_NEAR(jumps_of(run)[0].t, 807.0, 1.0);
}

/// Its first steps are a millionth of a second, whatever the horizon.
TEST(EventFlow, FirstStepsFollowTheFlowAndNotTheHorizon) {
  EventProblem problem;
  problem.state("y", {3, 1}, "[1; 0; 0]")
      .let("slow", "0.04*y(1) - 1e4*y(2)*y(3)")
      .flow("y", "[-slow; slow - 3e7*y(2)^2; 3e7*y(2)^2]");
  const hybrid::System system = problem.system();
  const hybrid::Trajectory run = run_to(system, 1e11);
  EXPECT_EQ(run.ending, hybrid::Ending::horizon) << run.message;
  EXPECT_NEAR(value_at(system, run, "y", 40)(0), 0.7158270688, 1e-7);
  EXPECT_NEAR(value_at(system, run, "y", 4e10)(0), 5.2e-8, 5e-9);
}

/// Fast at first, for a time that is nothing beside the horizon.
TEST(EventFlow, ManyStepsInASmallPartOfTheHorizonAreProgress) {
  EventProblem problem;
  problem.state("x", {}, "0").flow("x", "where(t < 1e-4, 3e7*cos(3e7*t), -x^3)");
  const hybrid::System system = problem.system();
  const hybrid::Trajectory run = run_to(system, 1e5);
  EXPECT_EQ(run.ending, hybrid::Ending::horizon) << run.message;
  EXPECT_NEAR(value_at(system, run, "x", 1e-4)(0), std::sin(3000.0), 1e-6);
}

}  // namespace
}  // namespace gainsmith::simulate
