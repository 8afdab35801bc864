// What the event-driven simulator runs, judged; and the same runs with a fault in them.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "judge/judge.h"
#include "simulate/simulator.h"
#include "support/dynamics_text.h"
#include "support/reference_run.h"

namespace gainsmith::judge {
namespace {

using tests::DynamicsText;
using tests::has_fault;
using tests::to_text;

struct Simulated {
  model::Dynamics dynamics;
  model::Stated stated;
  hybrid::Trajectory trajectory;
  Question question;

  Simulated(const DynamicsText& text, double horizon, std::uint64_t run = 0,
            double accuracy = 1e-10)
      : dynamics(text.dynamics()), stated(text.stated()) {
    const hybrid::System system = hybrid::make_system(dynamics, stated.values);
    const hybrid::Scenario scenario = hybrid::make_scenario(horizon, system);
    trajectory = simulate::Simulator(system, scenario).run(1, run, {accuracy, accuracy});
    question.relative = question.absolute = accuracy;
  }
  std::vector<Fault> judged() const {
    return check_trajectory(trajectory, dynamics, stated, question);
  }
  std::size_t jumps() const {
    std::size_t count = 0;
    for (const auto& part : trajectory.parts)
      if (std::holds_alternative<hybrid::JumpPoint>(part)) ++count;
    return count;
  }
};

void expect_accepted(const Simulated& simulated, std::size_t least_jumps,
                     hybrid::Ending ending = hybrid::Ending::horizon) {
  const auto faults = simulated.judged();
  EXPECT_TRUE(faults.empty()) << to_text(faults);
  EXPECT_GE(simulated.jumps(), least_jumps);
  EXPECT_EQ(to_string(simulated.trajectory.ending), to_string(ending))
      << simulated.trajectory.message;
}

DynamicsText ball(double restitution) {
  DynamicsText text;
  text.datum("r", tests::scalar(restitution))
      .state("x", 2, "[x(2); -9.81]", "[1; 0]")
      .when("impact", "x(1) <= 0 and x(2) < 0")
      .reacts("impact", {{"x", "[0; -r*x(2)]"}})
      .observer("counter")
      .state("n", 1, "", "0")
      .reacts("impact", {{"n", "n + since(impact) + count(impact) + j + t"}});
  return text;
}

/// A pendulum, and an extended Kalman filter that sees some of its samples.
DynamicsText pendulum() {
  DynamicsText text;
  text.state("x", 2, "[x(2); -9.81*sin(x(1)) - 0.1*x(2)]", "[1; 0]")
      .every("sample", "0.05", "0.2")
      .lost(0.3, 2)
      .noise("w", model::Dynamics::NoiseKind::normal, {"0", "0.03"})
      .drawn_at("sample")
      .observer("ekf")
      .state("xh", 2, "[xh(2); -9.81*sin(xh(1)) - 0.1*xh(2)]", "[0; 0]")
      .symmetric("P", 2, "He([0, 1; -9.81*cos(xh(1)), -0.1]*P) + 0.01*I", "[1, 0; 0, 1]")
      .reacts("sample", {{"xh", "xh + P*[1; 0]/(P(1, 1) + 0.001)*(x(1) + w - xh(1))"},
                         {"P", "P - P*[1; 0]*[1, 0]*P/(P(1, 1) + 0.001)"}})
      .signal("run", "sample.left + since(sample) + count(sample)");
  return text;
}

/// Hysteresis with a component that sleeps while it heats.
DynamicsText thermostat() {
  DynamicsText text;
  text.state("T", 1, "30*q - T", "20")
      .mode("q", "1")
      .when("off", "q == 1 and T >= 22")
      .when("on", "q == 0 and T <= 18")
      .rises("hot", "T - 21")
      .falls("cold", "T - 19")
      .crosses("middle", "T - 20.5")
      .reacts("off", {{"q", "0"}})
      .reacts("on", {{"q", "1"}})
      .observer("counter")
      .state("c", 3, "", "[0; 0; 0]")
      .reacts("hot", {{"c", "c + [1; 0; 0]"}})
      .reacts("cold", {{"c", "c + [0; 1; 0]"}})
      .reacts("middle", {{"c", "c + [0; 0; 1]"}})
      .observer("sleeper")
      .state("z", 1, "cos(z)", "0")
      .frozen("q == 1");
  return text;
}

/// Van der Pol's stiff oscillator with a loop of maps at a zero crossing.
DynamicsText relaxation() {
  DynamicsText text;
  text.state("x", 2, "[x(2); 500*(1 - x(1)^2)*x(2) - x(1)]", "[2; 0]")
      .observer("o")
      .state("z", 1, "x(1)", "0")
      .when("out", "z >= 1")
      .repeats("out", {{"z", "0.5*z"}}, "z <= 0.1", "10")
      .state("k", 1, "", "0")
      .reacts("out", {{"k", "k + passes(out)"}});
  return text;
}

TEST(JudgedSimulation, ABallBounces) { expect_accepted(Simulated(ball(0.8), 2.5), 3); }

TEST(JudgedSimulation, ABallComesToRest) {
  expect_accepted(Simulated(ball(0.5), 5), 10, hybrid::Ending::zeno);
}

TEST(JudgedSimulation, AFilterSeesItsSamples) {
  for (std::uint64_t run = 0; run < 3; ++run) expect_accepted(Simulated(pendulum(), 4, run), 20);
  expect_accepted(Simulated(pendulum(), 4, 3, 1e-6), 20);
}

TEST(JudgedSimulation, AThermostatSwitches) { expect_accepted(Simulated(thermostat(), 8), 20); }

TEST(JudgedSimulation, AStiffFlowWithLoops) { expect_accepted(Simulated(relaxation(), 100), 50); }

/// What decays fast, at a rate that falls and rises within a step.
TEST(JudgedSimulation, AStiffFlowOfVaryingRate) {
  DynamicsText text;
  text.state("z", 2, "[z(2); -z(1)]", "[1; 0]")
      .state("y", 1, "-(500 + 6.2e4*(c - 0.5)^2)*y", "0.5")
      .state("c", 1, "1", "0")
      .every("tick", "1")
      .reacts("tick", {{"y", "0.5*z(1)"}, {"c", "0"}});
  expect_accepted(Simulated(text, 20), 20);
}

TEST(JudgedSimulation, LeavingZero) {
  DynamicsText text;
  text.state("x", 2, "[x(2); -sin(x(1))]", "[0; 1]")
      .rises("up", "x(1)")
      .falls("down", "x(1)")
      .crosses("both", "x(1)")
      .falls("top", "x(2)")
      .at("kick", {"[5; 6]"})
      .reacts("kick", {{"x", "[0; -x(2)]"}});
  expect_accepted(Simulated(text, 10), 10);
}

TEST(JudgedSimulation, TwoClocksInOrder) {
  DynamicsText text;
  text.state("x", 1, "-x", "1").every("slow", "0.3").every("fast", "0.1").only_if("x < 1.5");
  text.reacts("slow", {{"x", "2*x"}}).reacts("fast", {{"x", "x + 0.3"}});
  text.at("log", {"[0; 0.3; 1]"}).reacts("log", {{"x", "x + 1"}});
  expect_accepted(Simulated(text, 3), 10);
}

TEST(JudgedSimulation, NoiseSwitchesAFlow) {
  DynamicsText text;
  text.state("x", 2, "[x(2); w - sin(x(1)) - 0.3*x(2)]", "[0; 0]")
      .noise("w", model::Dynamics::NoiseKind::uniform, {"-1", "1"})
      .drawn_every("0.1")
      .crosses("zero", "x(1)")
      .reacts("zero", {{"x", "[x(1); 0.9*x(2)]"}});
  expect_accepted(Simulated(text, 20), 2);
}

TEST(JudgedSimulation, SwitchesOfAFlow) {
  DynamicsText text;
  text.state("x", 2, "[x(2); where(x(1) > 0, -1, 3) - 0.1*sign(x(2))]", "[1; 0]");
  expect_accepted(Simulated(text, 10), 0);
}

TEST(JudgedSimulation, ARunThatIsLeft) {
  DynamicsText text;
  text.state("x", 1, "x + sin(t)", "1").flow_set("x <= 5", "x is large");
  expect_accepted(Simulated(text, 10), 0, hybrid::Ending::left);
}

TEST(JudgedSimulation, ARunThatEscapes) {
  DynamicsText text;
  text.state("x", 1, "x^2", "1");
  expect_accepted(Simulated(text, 10), 0, hybrid::Ending::escaped);
}

TEST(JudgedSimulation, ARunThatSlides) {
  DynamicsText text;
  text.state("x", 1, "where(x > 0, -1, 1)", "1");
  expect_accepted(Simulated(text, 10), 0, hybrid::Ending::sliding);
}

TEST(JudgedSimulation, ARunWithoutAValue) {
  DynamicsText text;
  text.state("x", 1, "-1", "1").state("y", 1, "sqrt(x)", "0");
  expect_accepted(Simulated(text, 10), 0, hybrid::Ending::undefined);
}

/// Any recorded value of a right run, changed by more than the accuracy, is a fault of that part or
/// of the one behind it.
TEST(JudgedSimulation, AnyChangeIsFound) {
  std::mt19937 random(7);
  for (const DynamicsText& text : {ball(0.8), pendulum(), thermostat()}) {
    const Simulated right(text, 2);
    ASSERT_TRUE(right.judged().empty());
    for (int k = 0; k < 40; ++k) {
      Simulated changed = right;
      auto& parts = changed.trajectory.parts;
      const std::size_t at = random() % parts.size();
      const auto element = static_cast<Eigen::Index>(
          random() % static_cast<std::size_t>(right.trajectory.start.size()));
      double* value = nullptr;
      if (auto* jump = std::get_if<hybrid::JumpPoint>(&parts[at])) {
        value = &(k % 2 == 0 ? jump->before : jump->after)(element);
      } else {
        auto& piece = std::get<hybrid::FlowPiece>(parts[at]);
        hybrid::DenseStep& step = piece.steps[random() % piece.steps.size()];
        value = &step.coefficients(element, k % 2);
      }
      *value += 1e-5 * (1 + std::abs(*value));
      const auto faults = changed.judged();
      EXPECT_TRUE(has_fault(faults, at, "") || has_fault(faults, at + 1, ""))
          << "part " << at << ", element " << element << ", k = " << k << "\n"
          << to_text(faults);
    }
  }
}

}  // namespace
}  // namespace gainsmith::judge
