// The judge on conditions, zero crossings, frozen components and loops of maps.
#include <gtest/gtest.h>

#include <cmath>

#include "judge/judge.h"
#include "support/dynamics_text.h"
#include "support/reference_run.h"

namespace gainsmith::judge {
namespace {

using Eigen::VectorXd;
using tests::column_of;
using tests::DynamicsText;
using tests::has_fault;
using tests::ReferenceRun;
using tests::to_text;

/// T' = 30 q - T with hysteresis, a counter of T rising through 21, and a component that is frozen
/// while the heater is on. Variables: T, q, c, z.
struct Thermostat {
  DynamicsText text;
  model::Dynamics dynamics;

  Thermostat() {
    text.state("T", 1, "30*q - T", "20")
        .mode("q", "1")
        .when("off", "q == 1 and T >= 22")
        .when("on", "q == 0 and T <= 18")
        .rises("hot", "T - 21")
        .reacts("off", {{"q", "0"}})
        .reacts("on", {{"q", "1"}})
        .observer("counter")
        .state("c", 1, "", "0")
        .reacts("hot", {{"c", "c + 1"}})
        .observer("sleeper")
        .state("z", 1, "1", "0")
        .frozen("q == 1");
    dynamics = text.dynamics();
  }
  static constexpr std::size_t kOff = 0, kOn = 1, kHot = 2;

  /// Flows until T is `to`.
  static void flow(ReferenceRun& run, double to) {
    const VectorXd x = run.x();
    const double from = run.t();
    const double rest = 30 * x(1);
    const double until = from + std::log((x(0) - rest) / (to - rest));
    run.flow(until, [=](double t) {
      VectorXd y = x;
      y(0) = t == until ? to : rest + (x(0) - rest) * std::exp(from - t);
      y(3) += (1 - x(1)) * (t - from);
      return y;
    });
  }
  static void jump(ReferenceRun& run, std::size_t event) {
    VectorXd x = run.x();
    if (event == kHot) x(2) += 1;
    if (event != kHot) x(1) = event == kOn ? 1 : 0;
    run.jump(event, x);
  }
  struct Leg {
    double to;
    std::vector<std::size_t> events;
  };
  std::vector<Fault> judged(const std::vector<Leg>& legs) const {
    ReferenceRun run(column_of({20, 1, 0, 0}), 0);
    for (const Leg& leg : legs) {
      flow(run, leg.to);
      for (const std::size_t event : leg.events) jump(run, event);
    }
    hybrid::Trajectory trajectory = run.end();
    trajectory.horizon = trajectory.end;
    return check_trajectory(trajectory, dynamics, text.stated());
  }
};

TEST(JudgedThermostat, IsAccepted) {
  const auto faults =
      Thermostat().judged({{21, {2}}, {22, {0}}, {18, {1}}, {21, {2}}, {22, {0}}, {19, {}}});
  EXPECT_TRUE(faults.empty()) << to_text(faults);
}

TEST(JudgedThermostat, FindsAZeroCrossingThatIsMissed) {
  const auto faults = Thermostat().judged({{22, {0}}, {19, {}}});
  EXPECT_TRUE(has_fault(faults, 0, "crosses zero inside a flow: hot")) << to_text(faults);
}

TEST(JudgedThermostat, FindsAnEventInTheWrongDirection) {
  const auto faults = Thermostat().judged({{21, {2}}, {22, {0}}, {21, {2}}, {19, {}}});
  EXPECT_TRUE(has_fault(faults, 5, "jumps, but is not due: hot")) << to_text(faults);
  EXPECT_EQ(faults.size(), 1u) << to_text(faults);
}

TEST(JudgedThermostat, FindsASwitchThatIsTooLateOrMissing) {
  const Thermostat thermostat;
  EXPECT_TRUE(has_fault(thermostat.judged({{21, {2}}, {22 + 1e-7, {0}}, {19, {}}}), 2,
                        "becomes due inside a flow: off"));
  EXPECT_TRUE(has_fault(thermostat.judged({{21, {2}}, {21.9, {0}}, {19, {}}}), 3,
                        "jumps, but is not due: off"));
  EXPECT_TRUE(has_fault(thermostat.judged({{21, {2}}, {22, {0}}, {18, {}}}), 5,
                        "is due, but does not jump: on"));
  // Twice through 21 at once, and jumps in the wrong mode.
  EXPECT_TRUE(has_fault(thermostat.judged({{21, {2, 2}}, {21.5, {}}}), 2, "is not due: hot"));
  EXPECT_TRUE(
      has_fault(thermostat.judged({{21, {2}}, {22, {1}}, {22.1, {}}}), 3, "is not due: on"));
}

TEST(JudgedThermostat, FindsAFrozenComponentThatFlows) {
  const Thermostat thermostat;
  ReferenceRun run(column_of({20, 1, 0, 0}), 0.05);
  run.flow(0.05, [](double t) { return column_of({30 - 10 * std::exp(-t), 1, 0, t}); });
  EXPECT_TRUE(has_fault(check_trajectory(run.end(), thermostat.dynamics, thermostat.text.stated()),
                        0, "flows, but rests: z"));
}

/// A jump of one event crosses zero of another.
TEST(JudgedCrossings, AreCrossedByJumpsOfOthersToo) {
  DynamicsText text;
  text.state("x", 1, "1", "-1").at("kick", {"0.5"}).rises("up", "x");
  text.state("n", 1, "", "0").reacts("kick", {{"x", "x + 2"}}).reacts("up", {{"n", "n + 1"}});
  const model::Dynamics dynamics = text.dynamics();
  const auto judged = [&](int times) {
    ReferenceRun run(column_of({-1, 0}), 1);
    run.flow(0.5, [](double t) { return column_of({t - 1, 0}); }).jump(0, column_of({1.5, 0}));
    for (int k = 1; k <= times; ++k) run.jump(1, column_of({1.5, static_cast<double>(k)}));
    const double n = times;
    run.flow(1, [n](double t) { return column_of({t + 1, n}); });
    return check_trajectory(run.end(), dynamics, text.stated());
  };
  EXPECT_TRUE(judged(1).empty()) << to_text(judged(1));
  EXPECT_TRUE(has_fault(judged(0), 2, "is due, but does not jump: up"));
  EXPECT_TRUE(has_fault(judged(2), 3, "jumps, but is not due: up"));
}

/// From exactly 0, at the start and where the jump of another leads there.
TEST(JudgedCrossings, ComeWhereZeroIsLeft) {
  DynamicsText text;
  text.state("x", 1, "1", "0").at("kick", {"0.5"}).rises("up", "x").falls("down", "x");
  text.state("n", 1, "", "0").reacts("kick", {{"x", "0"}}).reacts("up", {{"n", "n + 1"}});
  const model::Dynamics dynamics = text.dynamics();
  // Jumps at the start, and half a second later.
  const auto judged = [&](int first, int second, std::size_t event = 1) {
    double n = 0;
    ReferenceRun run(column_of({0, 0}), 1);
    const auto flow = [&](double until, double zero) {
      run.flow(until, [=](double t) { return column_of({t - zero, n}); });
    };
    const auto jumps = [&](int times) {
      for (int k = 0; k < times; ++k) {
        n += event == 1 ? 1 : 0;
        run.jump(event, column_of({run.x()(0), n}));
      }
    };
    flow(1e-20, 0);
    jumps(first);
    flow(0.5, 0);
    run.jump(0, column_of({0, n}));
    flow(0.5 + 1e-15, 0.5);
    jumps(second);
    flow(1, 0.5);
    return check_trajectory(run.end(), dynamics, text.stated());
  };
  EXPECT_TRUE(judged(1, 1).empty()) << to_text(judged(1, 1));
  EXPECT_TRUE(has_fault(judged(0, 1), 1, "crosses zero inside a flow: up"))
      << to_text(judged(0, 1));
  EXPECT_TRUE(has_fault(judged(1, 0), 5, "crosses zero inside a flow: up"))
      << to_text(judged(1, 0));
  EXPECT_TRUE(has_fault(judged(2, 1), 2, "jumps, but is not due: up"));
  EXPECT_TRUE(has_fault(judged(1, 1, 2), 1, "jumps, but is not due: down"));
}

/// A jump leads to 0 but for rounding: the crossing comes there or a moment later, and once.
TEST(JudgedCrossings, ComeOnceWhereRoundingHidesThem) {
  DynamicsText text;
  text.state("x", 1, "1", "-1").at("kick", {"0.5"}).rises("up", "x");
  text.state("n", 1, "", "0").reacts("kick", {{"x", "1e-17"}}).reacts("up", {{"n", "n + 1"}});
  const model::Dynamics dynamics = text.dynamics();
  const auto judged = [&](int at_once, int later) {
    double n = 0;
    ReferenceRun run(column_of({-1, 0}), 1);
    const auto flow = [&](double until, double zero) {
      run.flow(until, [=](double t) { return column_of({t - zero, n}); });
    };
    const auto jumps = [&](int times) {
      for (int k = 0; k < times; ++k) run.jump(1, column_of({run.x()(0), ++n}));
    };
    flow(0.5, 1);
    run.jump(0, column_of({1e-17, 0}));
    jumps(at_once);
    flow(0.5 + 1e-14, 0.5);
    jumps(later);
    flow(1, 0.5);
    return check_trajectory(run.end(), dynamics, text.stated());
  };
  EXPECT_TRUE(judged(1, 0).empty()) << to_text(judged(1, 0));
  EXPECT_TRUE(judged(0, 1).empty()) << to_text(judged(0, 1));
  EXPECT_TRUE(has_fault(judged(0, 0), 3, "crosses zero inside a flow: up"))
      << to_text(judged(0, 0));
  EXPECT_TRUE(has_fault(judged(2, 0), 3, "jumps, but is not due: up")) << to_text(judged(2, 0));
  EXPECT_TRUE(has_fault(judged(1, 1), 4, "jumps, but is not due: up")) << to_text(judged(1, 1));
}

/// Its own jump turns back what has crossed 0 by rounding alone.
TEST(JudgedCrossings, ComeAgainWhereTheirJumpTurnsBack) {
  DynamicsText text;
  text.state("x", 1, "1 - 2*q", "-0.5").mode("q", "0").crosses("c", "x").rises("r", "x");
  text.reacts("c", {{"q", "1"}});
  const model::Dynamics dynamics = text.dynamics();
  const auto judged = [&](int more, std::size_t event = 0) {
    ReferenceRun run(column_of({-0.5, 0}), 1);
    run.flow(0.5, [](double t) { return column_of({t == 0.5 ? 5e-17 : t - 0.5, 0}); });
    run.jump(0, column_of({5e-17, 1})).jump(1, column_of({5e-17, 1}));
    const double back = 0.5 + 2e-14;
    const auto flow = [](double t) { return column_of({0.5 + 5e-17 - t, 1}); };
    run.flow(back, flow);
    for (int k = 0; k < more; ++k) run.jump(event, run.x());
    run.flow(1, flow);
    return check_trajectory(run.end(), dynamics, text.stated());
  };
  EXPECT_TRUE(judged(1).empty()) << to_text(judged(1));
  EXPECT_TRUE(has_fault(judged(0), 4, "crosses zero inside a flow: c")) << to_text(judged(0));
  EXPECT_TRUE(has_fault(judged(2), 5, "jumps, but is not due: c")) << to_text(judged(2));
  EXPECT_TRUE(has_fault(judged(1, 1), 4, "jumps, but is not due: r")) << to_text(judged(1, 1));
}

/// What `if` has rejected does not come where a later jump of the same instant makes it true.
TEST(JudgedCrossings, AreRejectedOnceByIf) {
  DynamicsText text;
  text.state("x", 1, "0", "0").at("tick", {"0.5"}).only_if("x > 0").at("kick", {"0.5"});
  text.reacts("kick", {{"x", "1"}});
  const model::Dynamics dynamics = text.dynamics();
  ReferenceRun run(column_of({0}), 1);
  run.flow(0.5, [](double) { return column_of({0}); }).jump(1, column_of({1}));
  run.flow(1, [](double) { return column_of({1}); });
  const auto faults = check_trajectory(run.end(), dynamics, text.stated());
  EXPECT_TRUE(faults.empty()) << to_text(faults);
}

/// Rounding hides a little longer that zero was left than that `if` has become true: at zero it was false.
TEST(JudgedCrossings, AreRejectedWhereZeroIsLeft) {
  DynamicsText text;
  text.state("x", 1, "1", "0").rises("up", "(x + 1e4) - 1e4").only_if("x > 0");
  const model::Dynamics dynamics = text.dynamics();
  ReferenceRun run(column_of({0}), 1);
  run.flow(1, [](double t) { return column_of({t}); });
  const auto faults = check_trajectory(run.end(), dynamics, text.stated());
  EXPECT_TRUE(faults.empty()) << to_text(faults);
}

/// A pair of crossings between two of the points at which conditions are looked at.
TEST(JudgedCrossings, PairsInsideOneStepAreFound) {
  DynamicsText text;
  text.state("x", 1, "1", "0")
      .when("spike", "cos(10*x) >= 0.99999")
      .rises("blip", "cos(7*x) - 0.99999");
  text.falls("dip", "cos(7*x) + 0.99999").crosses("touch", "cos(3*x) + 1");
  const model::Dynamics dynamics = text.dynamics();
  ReferenceRun run(column_of({0.1}), 1.2);
  run.flow(
      1.2, [](double t) { return column_of({0.1 + t}); }, 2);
  Question question;
  question.starts.push_back({0, numbers::Matrix{{0}}, numbers::Matrix{{1}}});
  const auto faults = check_trajectory(run.end(), dynamics, text.stated(), question);
  EXPECT_TRUE(has_fault(faults, 0, "becomes due inside a flow: spike")) << to_text(faults);
  EXPECT_TRUE(has_fault(faults, 0, "inside a flow: blip")) << to_text(faults);
  EXPECT_TRUE(has_fault(faults, 0, "inside a flow: dip")) << to_text(faults);
  // It is reached and not crossed.
  EXPECT_FALSE(has_fault(faults, 0, "inside a flow: touch")) << to_text(faults);
}

/// A loop of maps; passes(outside) is a variable. Variables: x, passes(outside).
TEST(JudgedLoops, AreRepeatedUntilTheirCondition) {
  DynamicsText text;
  text.state("x", 1, "1", "0").when("outside", "x >= 1");
  text.repeats("outside", {{"x", "0.5*x"}}, "x <= 0.1", "10");
  text.signal("p", "passes(outside)");
  const model::Dynamics dynamics = text.dynamics();
  const auto judged = [&](double after, double passes) {
    ReferenceRun run(column_of({0, 0}), 1.2);
    run.flow(
           1,
           [](double t) {
             return column_of({t, 0});
           },
           2)
        .jump(0, column_of({after, passes}));
    run.flow(
        1.2,
        [=](double t) {
          return column_of({after + t - 1, passes});
        },
        2);
    return check_trajectory(run.end(), dynamics, text.stated());
  };
  EXPECT_TRUE(judged(0.0625, 4).empty()) << to_text(judged(0.0625, 4));
  EXPECT_TRUE(has_fault(judged(0.125, 3), 1, "the jump outside gives another value: x"));
  EXPECT_TRUE(has_fault(judged(0.03125, 5), 1, "the jump outside gives another value: x"));
  EXPECT_TRUE(has_fault(judged(0.0625, 3), 1, "wrong after the jump outside: passes(outside)"));
}

/// Maps of one jump see their own component as the map before left it, others as before.
TEST(JudgedLoops, MapsSeeTheirOwnComponentChanged) {
  DynamicsText text;
  text.state("x", 1, "1", "0").at("step", {"1"}).reacts("step", {{"x", "x + 10"}});
  text.observer("a").state("a1", 1, "", "1").state("a2", 1, "", "2");
  text.reacts("step", {{"a1", "a2"}, {"a2", "a1"}}).reacts("step", {{"a1", "a1 + x"}});
  text.observer("b").state("b1", 1, "", "0").reacts("step", {{"b1", "a1 + 100*x"}});
  const model::Dynamics dynamics = text.dynamics();
  const auto judged = [&](const VectorXd& after) {
    ReferenceRun run(column_of({0, 1, 2, 0}), 1);
    run.flow(
           1,
           [](double t) {
             return column_of({t, 1, 2, 0});
           },
           2)
        .jump(0, after);
    return check_trajectory(run.end(), dynamics, text.stated());
  };
  EXPECT_TRUE(judged(column_of({11, 3, 1, 101})).empty());
  EXPECT_TRUE(has_fault(judged(column_of({11, 13, 1, 101})), 1, "another value: a1"));
  EXPECT_TRUE(has_fault(judged(column_of({11, 2, 1, 101})), 1, "another value: a1"));
  EXPECT_TRUE(has_fault(judged(column_of({11, 3, 1, 103})), 1, "another value: b1"));
}

}  // namespace
}  // namespace gainsmith::judge
