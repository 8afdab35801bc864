// Events that happen where a function crosses 0: which crossings count, and once each.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "simulate/event_runs.h"
#include "support/event_problem.h"

namespace gainsmith::simulate {
namespace {

using tests::EventProblem;
using tests::jumps_of;
using tests::part_of;
using EventKind = model::Dynamics::EventKind;

TEST(EventRun, ThreeCrossingsInOneStepAllJump) {
  EventProblem problem;
  problem.state("p", {}, "0").flow("p", "(t - 0.3)^2 - 0.01").state("n", {}, "0");
  problem.let("cubic", "(t - 0.1)*(t - 0.50001)*(t - 0.5)");
  problem.crossing(EventKind::crosses, "c", "cubic").jump("c", {{"n", "n + 1"}});
  const hybrid::System system = problem.system();
  const hybrid::Trajectory run = simulate(system, 16);
  const std::vector<double> times = jump_times(run);
  ASSERT_EQ(times.size(), 3U);
  EXPECT_NEAR(times[0], 0.1, 1e-15);
  EXPECT_NEAR(times[1], 0.5, 1e-10);
  EXPECT_NEAR(times[2], 0.50001, 1e-10);
  EXPECT_EQ(part_of(system, jumps_of(run).back().after, "n")(0), 3);
}

TEST(EventRun, RisesFallsAndCrossesComeOnceEach) {
  for (const bool exact : {true, false}) {
    EventProblem problem;
    problem.state("x", {2, 1}, "[0; 1]")
        .flow("x", exact ? "[x(2); -x(1)]" : "[x(2); -sin(x(1)) - x(1) + sin(x(1))]");
    problem.crossing(EventKind::rises, "up", "x(1) - 0.5");
    problem.crossing(EventKind::falls, "down", "x(1) - 0.5");
    problem.crossing(EventKind::crosses, "both", "x(1) - 0.5");
    const hybrid::System system = problem.system();
    EXPECT_EQ(system.affine, exact);
    const hybrid::Trajectory run = simulate(system, 20);
    constexpr double kPi = std::numbers::pi;
    const std::vector<double> up = {kPi / 6, kPi / 6 + 2 * kPi, kPi / 6 + 4 * kPi,
                                    kPi / 6 + 6 * kPi};
    const std::vector<double> rising = jump_times(run, 0);
    const std::vector<double> falling = jump_times(run, 1);
    ASSERT_EQ(rising.size(), 4U);
    ASSERT_EQ(falling.size(), 3U);
    EXPECT_EQ(jump_times(run, 2).size(), 7U);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(rising[k], up[k], exact ? 1e-12 : 1e-7);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(falling[k], 5 * kPi / 6 + 2 * kPi * static_cast<double>(k), exact ? 1e-12 : 1e-7);
    expect_contiguous(run);
  }
}

TEST(EventRun, ACrossingByTheJumpOfAnotherEventCountsAndByItsOwnDoesNot) {
  EventProblem problem;
  problem.state("x", {}, "-1").state("n", {}, "0");
  problem.crossing(EventKind::crosses, "c", "x").at("push", {"1", "2"});
  problem.jump("push", {{"x", "-x"}}).jump("c", {{"x", "-2*x"}, {"n", "n + 1"}});
  const hybrid::System system = problem.system();
  const hybrid::Trajectory run = simulate(system, 3);
  // push: -1 -> 1, c: 1 -> -2; push: -2 -> 2, c: 2 -> -4.
  EXPECT_EQ(jump_times(run, 0), (std::vector<double>{1, 2}));
  EXPECT_EQ(part_of(system, jumps_of(run).back().after, "x")(0), -4);
}

TEST(EventRun, LeavingExactlyZeroIsACrossing) {
  for (const bool exact : {true, false}) {
    EventProblem problem;
    problem.state("x", {}, "0.3").state("v", {}, "1");
    problem.flow("x", exact ? "v" : "v*cos(x)");
    problem.crossing(EventKind::rises, "up", "x - 0.3").at("push", {"1"});
    problem.crossing(EventKind::falls, "down", "x - 0.3");
    problem.crossing(EventKind::crosses, "both", "x - 0.3");
    problem.jump("push", {{"x", "0.3"}, {"v", "-v"}});
    const hybrid::System system = problem.system();
    EXPECT_EQ(system.affine, exact);
    const hybrid::Trajectory run = simulate(system, 2);
    ASSERT_EQ(jump_times(run, 0).size(), 1U);
    ASSERT_EQ(jump_times(run, 2).size(), 1U);
    ASSERT_EQ(jump_times(run, 3).size(), 2U);
    EXPECT_NEAR(jump_times(run, 0)[0], 0, 1e-13);
    EXPECT_NEAR(jump_times(run, 2)[0], 1, 1e-13);
    EXPECT_NEAR(jump_times(run, 3)[0], 0, 1e-13);
    EXPECT_NEAR(jump_times(run, 3)[1], 1, 1e-13);
  }
}

TEST(EventRun, ABallThatBouncesAtExactlyZeroBouncesToItsRest) {
  for (const double start : {2.012298031219591, 1.0, 3.3, 0.7123})
    for (const bool exact : {true, false}) {
      EventProblem problem;
      problem.state("h", {}, std::to_string(start)).state("v", {}, "-0.287");
      problem.flow("h", "v").flow("v", exact ? "-9.81" : "-9.81 + 0*sin(h)");
      problem.crossing(EventKind::falls, "hit", "h").jump("hit", {{"h", "0"}, {"v", "-0.8*v"}});
      const hybrid::System system = problem.system();
      const hybrid::Trajectory run = simulate(system, 20);
      const double v = std::sqrt(0.287 * 0.287 + 2 * 9.81 * start);
      const std::vector<double> times = jump_times(run, 0);
      ASSERT_GT(times.size(), 3U);
      for (std::size_t k = 1; k < 30; ++k)
        EXPECT_NEAR(times[k] - times[k - 1], 2 * v / 9.81 * std::pow(0.8, static_cast<double>(k)),
                    1e-7)
            << start << ", flight " << k;
      EXPECT_EQ(run.ending, hybrid::Ending::zeno) << run.message;
    }
}

/// A start on a surface, from which the flow leads away, and what the rounding of a step shows of it.
TEST(EventRun, AwayFromASurfaceNothingHappens) {
  for (const double start : {-1.0, 0.0, 0.5, 1.0})
    for (const char* flow : {"0.5", "0.5 + cos(5*t) - 0.1*h", "0.3 + 0.2*abs(h)"}) {
      EventProblem problem;
      problem.state("h", {}, std::to_string(start)).flow("h", flow);
      problem.state("n", {}, "0");
      const std::string away = "h - (" + std::to_string(start) + ")";
      problem.when("below", "h < " + std::to_string(start) + " and n < 1");
      problem.jump("below", {{"n", "n + 1"}});
      problem.crossing(EventKind::falls, "falls", away);
      const hybrid::Trajectory run = simulate(problem.system(), 0.2);
      EXPECT_TRUE(jump_times(run, 0).empty()) << start << ", " << flow;
      EXPECT_TRUE(jump_times(run, 1).empty()) << start << ", " << flow;
    }
}

/// x2 crosses 0 fast, by units of its time, and the jump turns it back slowly.
TEST(EventRun, ACrossingBackFromARootOfAFastFlowIsMet) {
  for (int k = 0; k < 40; ++k) {
    EventProblem problem;
    problem.state("x", {}, std::to_string(0.7 + 0.01 * k)).state("m", {}, "-11.3");
    problem.flow("x", "m + 0*sin(x)").state("n", {}, "0");
    problem.crossing(EventKind::crosses, "c", "x").jump("c", {{"m", "0.13"}, {"n", "n + 1"}});
    const hybrid::Trajectory run = simulate(problem.system(), 2);
    const std::vector<double> times = jump_times(run, 0);
    ASSERT_EQ(times.size(), 2U) << k;
    EXPECT_NEAR(times[1], times[0], 1e-11) << k;
  }
}

/// Two events share a surface, and the jump of the second leads back.
TEST(EventRun, ASharedRootIsTheSameForBothHoweverItIsRounded) {
  for (int k = 0; k < 40; ++k) {
    EventProblem problem;
    problem.state("h", {}, std::to_string(0.1 + 0.01 * k)).state("v", {}, "-0.4");
    problem.flow("h", "v").flow("v", "-4.905");
    problem.crossing(EventKind::rises, "up", "h + 0.5");
    problem.crossing(EventKind::crosses, "c", "h + 0.5");
    problem.jump("c", {{"h", "h + 1"}, {"v", "v + 0.5"}});
    const hybrid::Trajectory run = simulate(problem.system(), 2.6);
    EXPECT_TRUE(jump_times(run, 0).empty()) << k;
    EXPECT_GT(jump_times(run, 1).size(), 3U) << k;
  }
}

TEST(EventRun, AnEventWhoseMapLeadsToZeroMayComeAgainAtOnce) {
  EventProblem problem;
  problem.state("h", {}, "1").flow("h", "-1").state("n", {}, "0");
  problem.crossing(EventKind::falls, "floor", "h").jump("floor", {{"h", "0"}, {"n", "n + 1"}});
  const hybrid::Trajectory run = simulate(problem.system(), 3);
  EXPECT_EQ(run.ending, hybrid::Ending::chattering) << run.message;
  EXPECT_NEAR(run.end, 1, 1e-9);
}

// Two inertias with a gap between them: contact begins and ends in turn, and each takes its time.
TEST(EventRun, ARootThatABranchOfTheFlowSharesIsMetOnce) {
  for (int k = 0; k < 12; ++k) {
    EventProblem problem;
    problem.state("p", {2, 1}, "[0; 0]").state("w", {2, 1}, "[0; 0]");
    problem.let("r", "p(1) - p(2)").let("s", "1000*(r - 0.1)").let("l", "1000*(r + 0.1)");
    problem.let("d", "5*(w(1) - w(2))");
    problem.let("tau", "where(r > 0.1, max(s + d, 0), where(r < -0.1, min(l + d, 0), 0))");
    problem.flow("p", "w").flow(
        "w", "[10*sin(" + std::to_string(1.8 + 0.05 * k) + "*t) - tau; (tau - 0.5*w(2))/0.5]");
    problem.crossing(EventKind::rises, "touch", "abs(r) - 0.1");
    problem.crossing(EventKind::falls, "leave", "abs(r) - 0.1");
    const hybrid::Trajectory run = simulate(problem.system(), 10);
    const auto jumps = jumps_of(run);
    ASSERT_GT(jumps.size(), 20U);
    for (std::size_t n = 0; n < jumps.size(); ++n) {
      EXPECT_EQ(jumps[n].event, n % 2) << k << ", t = " << jumps[n].t;
      EXPECT_GT(jumps[n].t, n == 0 ? 0 : jumps[n - 1].t + 1e-3) << k;
    }
  }
}

// x comes from -1 and is at -0.5 when `push` takes it back to -1: |x| - 0.5 has not fallen below 0.
TEST(EventRun, AnEventOnTheSameSurfaceThatTurnsBackIsNoCrossing) {
  for (int k = 0; k < 20; ++k) {
    EventProblem problem;
    problem.state("x", {}, "-1 - " + std::to_string(0.013 * k))
        .flow("x", "0.7")
        .state("n", {}, "0");
    problem.crossing(EventKind::rises, "up", "abs(x) - 0.5").jump("up", {{"n", "n + 1"}});
    problem.when("push", "x >= -0.5").jump("push", {{"x", "x - 0.5"}});
    const hybrid::System system = problem.system();
    const hybrid::Trajectory run = simulate(system, 3);
    EXPECT_GE(jump_times(run, 1).size(), 2U);
    EXPECT_EQ(jump_times(run, 0).size(), 0U) << k;
  }
}

// 0.1 + 0.2 is 0.3 and an ulp.
TEST(EventRun, WhatLeavesZeroForOneSideDoesNotComeToTheOther) {
  for (const char* start : {"[-1; 0.5]", "[0.5; 0]"}) {
    EventProblem problem;
    problem.state("x", {2, 1}, start)
        .flow("x", "[x(2); -3.14*x(1) - 1.6*abs(x(2))*x(2)]")
        .state("n", {}, "0");
    problem.when("below", "x(1) < -1 and n < 3").jump("below", {{"n", "n + 1"}});
    problem.crossing(EventKind::rises, "up", "x(2)").jump("up", {{"n", "n + 100"}});
    problem.crossing(EventKind::falls, "down", "abs(x(2)) - 0.5");
    const hybrid::Trajectory run = simulate(problem.system(), 0.05);
    EXPECT_TRUE(jumps_of(run).empty()) << jumps_of(run).front().t;
  }
}

TEST(EventRun, WhatAJumpLeadsToIsZeroButForRounding) {
  for (const bool rises : {true, false}) {
    EventProblem problem;
    problem.state("x", {}, "0").flow("x", rises ? "1" : "-1");
    problem.at("push", {"0.1"}).jump("push", {{"x", "0.1 + 0.2"}});
    problem.crossing(EventKind::rises, "up", "x - 0.3").jump("up", {{"x", "-10"}});
    EXPECT_EQ(jump_times(simulate(problem.system(), 1), 1).size(), rises ? 1U : 0U);
  }
}

}  // namespace
}  // namespace gainsmith::simulate
