// Runs over measured data: what they give where the solution is known, and what the judge says.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "judge/judge.h"
#include "simulate/simulator.h"
#include "support/dynamics_text.h"
#include "support/event_problem.h"
#include "support/input_error.h"
#include "support/reference_run.h"

namespace gainsmith::simulate {
namespace {

using model::Between;
using tests::DynamicsText;
using tests::input_error;
using tests::to_text;

using Rows = std::vector<std::pair<double, double>>;

struct Simulated {
  model::Dynamics dynamics;
  model::Stated stated;
  hybrid::System system;
  hybrid::Trajectory trajectory;

  Simulated(const DynamicsText& text, double horizon)
      : dynamics(text.dynamics()),
        stated(text.stated()),
        system(hybrid::make_system(dynamics, stated.values)) {
    const hybrid::Scenario scenario = hybrid::make_scenario(horizon, system);
    trajectory = Simulator(system, scenario).run(1, 0);
  }
  /// Of the last step that reaches t.
  double value(const std::string& name, double t) const {
    const hybrid::Slot& slot = system.layout.slots[system.slot(name).value()];
    double found = std::nan("");
    for (const auto& part : trajectory.parts)
      if (const auto* piece = std::get_if<hybrid::FlowPiece>(&part))
        for (const hybrid::DenseStep& step : piece->steps)
          if (step.from <= t && t <= step.to) found = step(t)(slot.offset);
    return found;
  }
  /// Before the k-th jump.
  double before_jump(const std::string& name, int k) const {
    const hybrid::Slot& slot = system.layout.slots[system.slot(name).value()];
    for (const auto& part : trajectory.parts)
      if (const auto* jump = std::get_if<hybrid::JumpPoint>(&part))
        if (k-- == 0) return jump->before(slot.offset);
    return std::nan("");
  }
  std::vector<judge::Fault> faults() const {
    return judge::check_trajectory(trajectory, dynamics, stated, {});
  }
};

/// Whether a fault is one of the data.
bool blames_the_rows(const std::vector<judge::Fault>& faults) {
  const std::string all = to_text(faults);
  return all.find("is not what its file says") != std::string::npos ||
         all.find("leads over a row") != std::string::npos;
}

void expect_accepted(const Simulated& run) {
  EXPECT_EQ(to_string(run.trajectory.ending), "horizon") << run.trajectory.message;
  EXPECT_TRUE(run.faults().empty()) << to_text(run.faults());
}

const Rows kRows = {{-1, 5}, {0, 1}, {0.3, 2}, {0.3, 4}, {1, -3}, {1.7, 0}};

TEST(Measured, AHeldValueIsThatOfTheLastRow) {
  DynamicsText text;
  text.measured("u", Between::hold, kRows).state("x", 1, "u", "0");
  const Simulated run(text, 2);
  EXPECT_TRUE(run.system.affine);
  for (const auto& [t, u, x] :
       {std::array{0.1, 1.0, 0.1}, std::array{0.5, 4.0, 0.3 + 0.8},
        std::array{1.2, -3.0, 0.3 + 2.8 - 0.6}, std::array{1.9, 0.0, 0.3 + 2.8 - 2.1}}) {
    EXPECT_EQ(run.value("u", t), u) << t;
    EXPECT_NEAR(run.value("x", t), x, 1e-14) << t;
  }
  expect_accepted(run);
}

TEST(Measured, ALineJoinsTheRows) {
  DynamicsText text;
  text.measured("u", Between::line, kRows).state("x", 1, "u", "0");
  const Simulated run(text, 1.7);
  EXPECT_TRUE(run.system.affine) << "so that the flow is exact";
  EXPECT_NEAR(run.value("u", 0.15), 1.5, 1e-15);
  EXPECT_NEAR(run.value("u", 0.65), 0.5, 1e-15);
  EXPECT_NEAR(run.value("x", 0.2), 0.2 + 0.04 / 0.6, 1e-15);
  EXPECT_NEAR(run.value("x", 1.7), 0.45 + 0.35 - 1.05, 1e-14);
  EXPECT_NEAR(tests::part_of(run.system, run.trajectory.start, "u_rate")(0), 1 / 0.3, 1e-15)
      << "with which it goes on";
  expect_accepted(run);
}

TEST(Measured, FlowsThatAreNotAffineFollowToo) {
  for (const Between between : {Between::hold, Between::line}) {
    DynamicsText text;
    text.measured("u", between, kRows).state("x", 1, "-u*x", "1").state("i", 1, "u", "0");
    const Simulated run(text, 1.5);
    EXPECT_EQ(run.system.affine, between == Between::hold);
    for (const double t : {0.2, 0.31, 1.1, 1.5})
      EXPECT_NEAR(run.value("x", t), std::exp(-run.value("i", t)), 1e-7) << t;
    expect_accepted(run);
  }
}

TEST(Measured, ARunMayBeginBetweenRows) {
  DynamicsText text;
  text.measured("u", Between::line, {{-1, 2}, {1, 4}})
      .measured("v", Between::hold, {{-1, 2}, {1, 4}});
  text.state("x", 1, "u - v", "0");
  const Simulated run(text, 1);
  EXPECT_NEAR(run.value("u", 0), 3, 1e-15);
  EXPECT_NEAR(run.value("x", 1), 1.5, 1e-14);
  expect_accepted(run);
}

TEST(Measured, EventsSeeTheFirstRowOfTheirTimeAndFlowsTheLast) {
  DynamicsText text;
  text.measured("u", Between::hold, kRows).state("x", 1, "u", "0").at("look", {"[0.3; 1]"});
  text.reacts("look", {{"x", "10*u"}});
  const Simulated run(text, 1.2);
  EXPECT_EQ(run.before_jump("u", 0), 2);
  EXPECT_EQ(run.before_jump("u", 1), -3);
  EXPECT_NEAR(run.value("x", 0.5), 20 + 0.8, 1e-14);
  EXPECT_NEAR(run.value("x", 1.1), -30 - 0.3, 1e-14);
  expect_accepted(run);
}

TEST(Measured, ZeroCrossingsAreFoundBetweenRowsAndAtThem) {
  DynamicsText text;
  text.measured("u", Between::line, {{0, -1}, {1, 1}, {2, -1}})
      .measured("v", Between::hold, {{0, 0}, {0.7, 2}})
      .state("n", 1, "", "0")
      .crosses("zero", "u")
      .rises("step", "v - 1")
      .reacts("zero", {{"n", "n + 1"}})
      .reacts("step", {{"n", "n + 10"}});
  const Simulated run(text, 2);
  std::vector<double> times;
  for (const auto& part : run.trajectory.parts)
    if (const auto* jump = std::get_if<hybrid::JumpPoint>(&part)) times.push_back(jump->t);
  ASSERT_EQ(times.size(), 3U);
  EXPECT_NEAR(times[0], 0.5, 1e-14);
  EXPECT_EQ(times[1], 0.7);
  EXPECT_NEAR(times[2], 1.5, 1e-14);
  expect_accepted(run);
}

TEST(Measured, SwitchesKeepTheirBranchesBetweenRows) {
  DynamicsText text;
  text.measured("u", Between::hold, {{0, -1}, {0.4, 1}, {1, -1}})
      .state("x", 1, "where(u > 0, 2, 0) + 0*x*x", "0");
  const Simulated run(text, 1.5);
  EXPECT_NEAR(run.value("x", 1.5), 1.2, 1e-12);
  expect_accepted(run);
}

TEST(Measured, AFrozenPlantDoesNotStopTheData) {
  DynamicsText text;
  text.measured("u", Between::line, {{0, 0}, {2, 2}}).mode("q", "1").state("x", 1, "u", "0");
  text.frozen("q == 1").observer("other").state("z", 1, "u", "0");
  const Simulated run(text, 2);
  EXPECT_EQ(run.value("x", 2), 0);
  EXPECT_NEAR(run.value("z", 2), 2, 1e-14);
  expect_accepted(run);
}

TEST(Measured, AnEventMayTakeItsTimesFromRows) {
  DynamicsText text;
  text.state("n", 1, "", "0").at("tick", {"0.5"}).reacts("tick", {{"n", "n + 1"}});
  model::Dynamics dynamics = text.dynamics();
  dynamics.events[0].rows = {0.25, 0.5, 0.75};
  const hybrid::System system = hybrid::make_system(dynamics, {});
  EXPECT_EQ(system.times[0], (std::vector<double>{0.25, 0.5, 0.75}));
  const hybrid::Trajectory run = Simulator(system, hybrid::make_scenario(1, system)).run(1, 0);
  const model::Stated stated = text.stated();
  EXPECT_TRUE(judge::check_trajectory(run, dynamics, stated, {}).empty());
  dynamics.events[0].rows = {0.3};
  EXPECT_FALSE(judge::check_trajectory(run, dynamics, stated, {}).empty());
}

TEST(Measured, TheJudgeKnowsTheRows) {
  const auto text = [](const Rows& rows) {
    DynamicsText one;
    one.measured("u", Between::line, rows).measured("v", Between::hold, rows);
    one.state("x", 1, "u + v - x*x*x", "0").every("tick", "0.25").reacts("tick", {{"x", "x + u"}});
    return one;
  };
  const Simulated run(text(kRows), 1.5);
  expect_accepted(run);
  for (const Rows& other : {Rows{{-1, 5}, {0, 1}, {0.3, 2}, {0.3, 4}, {1, -3.0001}, {1.7, 0}},
                            Rows{{-1, 5}, {0, 1}, {0.3, 2}, {1, -3}, {1.7, 0}},
                            Rows{{-1, 5}, {0, 1}, {0.3, 2}, {0.3, 4}, {0.9, -2}, {1, -3}, {1.7, 0}},
                            Rows{{-1, 5}, {0, 1.01}, {0.3, 2}, {0.3, 4}, {1, -3}, {1.7, 0}}}) {
    const DynamicsText changed = text(other);
    const auto faults = judge::check_trajectory(run.trajectory, changed.dynamics(), run.stated, {});
    EXPECT_TRUE(blames_the_rows(faults)) << to_text(faults);
  }
}

TEST(Measured, TheJudgeFindsARowThatWasLeftOut) {
  DynamicsText full, gap;
  full.measured("u", Between::hold, {{0, 1}, {0.5, 2}, {1, 1}}).state("x", 1, "u - x*x*x", "0");
  gap.measured("u", Between::hold, {{0, 1}, {1, 1}}).state("x", 1, "u - x*x*x", "0");
  const Simulated run(gap, 1);
  expect_accepted(run);
  const auto faults = judge::check_trajectory(run.trajectory, full.dynamics(), run.stated, {});
  EXPECT_TRUE(blames_the_rows(faults)) << to_text(faults);
}

TEST(Measured, ARunAsksForNoMoreThanThereIs) {
  DynamicsText late, line;
  late.measured("u", Between::hold, {{0.5, 1}}).state("x", 1, "u", "0");
  EXPECT_NE(input_error([&] { Simulated(late, 1); }).message().find("no value at t = 0"),
            std::string::npos);
  line.measured("u", Between::line, {{0, 1}, {1, 1}}).state("x", 1, "u", "0");
  const model::Dynamics dynamics = line.dynamics();
  const hybrid::System system = hybrid::make_system(dynamics, {});
  model::Design::Campaign campaign;
  EXPECT_EQ(hybrid::make_scenario(campaign, system).horizon, 1);
}

}  // namespace
}  // namespace gainsmith::simulate
