// Flows across kinks: abs, max, min, clip, and jacobians of them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "base/number.h"
#include "judge/judge.h"
#include "numbers/types/real.h"
#include "simulate/simulator.h"
#include "support/dynamics_text.h"
#include "support/event_problem.h"
#include "support/reference_run.h"

namespace gainsmith::simulate {
namespace {

using Eigen::VectorXd;
using tests::DynamicsText;
using tests::EventProblem;
using tests::part_of;
using tests::value_at;

std::size_t steps_of(const hybrid::Trajectory& run) {
  std::size_t steps = 0;
  for (const auto& part : run.parts)
    if (const auto* piece = std::get_if<hybrid::FlowPiece>(&part)) steps += piece->steps.size();
  return steps;
}

/// The run of a text, which the judge accepts.
struct Judged {
  model::Dynamics dynamics;
  model::Stated stated;
  hybrid::System system;
  hybrid::Trajectory run;

  Judged(const DynamicsText& text, double horizon, double accuracy = 1e-10)
      : dynamics(text.dynamics()), stated(text.stated()) {
    system = hybrid::make_system(dynamics, stated.values);
    const hybrid::Scenario scenario = hybrid::make_scenario(horizon, system);
    run = Simulator(system, scenario).run(1, 0, {accuracy, accuracy});
    judge::Question question;
    question.relative = question.absolute = accuracy;
    const auto faults = judge::check_trajectory(run, dynamics, stated, question);
    EXPECT_TRUE(faults.empty()) << tests::to_text(faults);
    EXPECT_EQ(to_string(run.ending), "horizon") << run.message;
  }
  double at(const std::string& name, double t) const { return value_at(system, run, name, t)(0); }
};

/// x = sin(7 t) along the flow, and y its integral of the absolute value: 2/7 a half wave.
TEST(EventKinks, TheIntegralOfAnAbsoluteValue) {
  DynamicsText text;
  text.state("x", 2, "[7*x(2); -7*x(1)]", "[0; 1]").state("y", 1, "abs(x(1)) + 0*y^2", "0");
  for (const double accuracy : {1e-6, 1e-8, 1e-10}) {
    const Judged judged(text, 10, accuracy);
    const double half_waves = std::floor(70 / std::numbers::pi);
    const double expected = (2 * half_waves + 1 - std::cos(70 - half_waves * std::numbers::pi)) / 7;
    // The oscillation itself drifts over its 22 half waves.
    EXPECT_NEAR(judged.at("y", 10), expected, 1e4 * accuracy);
  }
}

/// Saturated feedback is affine on each of its three branches: steps are exact.
TEST(EventKinks, BranchesOfAnAffineFlowAreExact) {
  DynamicsText text;
  text.state("x", 2, "[x(2); clip(-2*x(1), -1, 1)]", "[3; 0]");
  const Judged judged(text, 2.5);
  EXPECT_TRUE(judged.system.affine);
  const double leaves = std::sqrt(5);  // 3 - t^2/2 comes down to 1/2
  EXPECT_NEAR(judged.at("x", leaves), 0.5, 1e-14);
  const double s = 2.5 - leaves;
  const double w = std::sqrt(2.0);
  EXPECT_NEAR(judged.at("x", 2.5), 0.5 * std::cos(w * s) - leaves / w * std::sin(w * s), 1e-13);
  EXPECT_LT(steps_of(judged.run), 40U);
}

TEST(EventKinks, ElementsOfAVectorTurnOneByOne) {
  DynamicsText text;
  text.state("x", 3, "max(min([1; 2; 3]*t - 2, 1), -1)", "[0; 0; 0]");
  text.signal("run", "t");
  const Judged judged(text, 4);
  for (int k = 1; k <= 3; ++k) {
    // -1 up to t = 1/k, a ramp to t = 3/k, then 1.
    const double expected = -1.0 / k + (4 - 3.0 / k);
    EXPECT_NEAR(value_at(judged.system, judged.run, "x", 4)(k - 1), expected, 1e-13) << k;
  }
}

/// max(x, 0)^2 has a derivative with a kink: 2 max(x, 0).
TEST(EventKinks, InsideAJacobian) {
  DynamicsText text;
  text.state("x", 1, "-1", "1")
      .state("y", 1, "jacobian(max(x, 0)^2, x)*jacobian(abs(x)*x, x) + 0*y^2", "0");
  const Judged judged(text, 2);
  EXPECT_EQ(judged.system.switches.size(), 2U);
  EXPECT_NEAR(judged.at("y", 2), 4.0 / 3, 1e-10);  // the integral of 2x 2|x| up to t = 1
}

/// The same D inside and outside of a jacobian is one switch; a jacobian by another name that holds
/// one by this name has the same branches too.
TEST(EventKinks, ABranchIsFixedOnce) {
  const hybrid::System system = EventProblem()
                                    .state("x", {2, 1}, "[1; -1]")
                                    .flow("x", "-max(x, 0) - jacobian(max(x, 0).^2, x)*[1; 1]")
                                    .system();
  EXPECT_EQ(system.switches.size(), 1U);
}

/// The branch of a kink where its argument has no value on the other side.
TEST(EventKinks, ATankRunsEmpty) {
  DynamicsText text;
  text.state("h", 1, "-sqrt(max(h, 0))", "1");
  const Judged judged(text, 4);
  EXPECT_NEAR(judged.at("h", 1), 0.25, 1e-9);
  EXPECT_NEAR(judged.at("h", 4), 0, 1e-8);
}

TEST(EventKinks, AKinkTouchedOrFollowedEndsNothing) {
  DynamicsText touched;
  touched.state("x", 1, "2*(t - 1) + 0*x^2", "1")
      .state("y", 1, "abs(x) + 0*y^2", "0")
      .signal("run", "t");
  EXPECT_NEAR(Judged(touched, 2).at("y", 2), 2.0 / 3, 1e-9);  // x = (t - 1)^2
  DynamicsText followed;
  followed.state("x", 2, "[abs(x(1) - x(2)) - sin(x(1)); -sin(x(2))]", "[1; 1]");
  const Judged along(followed, 10);
  EXPECT_LT(steps_of(along.run), 400U);
  DynamicsText resting;
  resting.state("x", 1, "-abs(x) - 100*x + 0*x^2", "1");
  EXPECT_LT(steps_of(Judged(resting, 10).run), 3000U);
}

/// A pulse between two steps: kinks of the time are stepped to.
TEST(EventKinks, ANarrowPulseOfTheTimeIsSeen) {
  DynamicsText text;
  text.state("x", 1, "max(0, 1 - abs(t - 5.0123)/0.001) - 0*x^2", "0").signal("run", "t");
  EXPECT_NEAR(Judged(text, 100).at("x", 100), 0.001, 1e-12);
}

/// Kinks at random against a reference that steps to every one of them: x' = a_k on pieces.
TEST(EventKinks, RandomPiecewiseFlows) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 20; ++trial) {
    const double a = uniform(random);
    const double b = uniform(random);
    const double c = 1 + uniform(random) / 2;
    DynamicsText text;
    text.datum("a", numbers::Matrix::Constant(1, 1, a))
        .datum("b", numbers::Matrix::Constant(1, 1, b))
        .datum("c", numbers::Matrix::Constant(1, 1, c))
        .state("x", 2, "[x(2); -c*x(1)]", "[1; 0]")
        .state("y", 1, "max(x(1) - a, b*x(1)) + 0*y^2", "0");
    const Judged judged(text, 6);
    // By the trapezoidal rule with a corrected error, on a fine grid.
    const double w = std::sqrt(c);
    const auto f = [&](double t) {
      const double x = std::cos(w * t);
      return std::max(x - a, b * x);
    };
    constexpr int kPoints = 600000;
    double sum = (f(0) + f(6)) / 2;
    for (int k = 1; k < kPoints; ++k) sum += f(6.0 * k / kPoints);
    EXPECT_NEAR(judged.at("y", 6), sum * 6 / kPoints, 1e-7) << a << " " << b << " " << c;
  }
}

// At the zero crossing the state rounds to either side of it.
TEST(EventKinks, AnExactFlowPassesOne) {
  for (const double at : {0.1, 0.5, 0.7, 0.9, 1.3}) {
    EventProblem problem;
    const std::string kink = brief(at, 17);
    problem.state("x", {}, "0").flow("x", "1 - 3*max(x - " + kink + ", 0)");
    const hybrid::System system = problem.system();
    const hybrid::Scenario scenario = hybrid::make_scenario(3, system);
    const hybrid::Trajectory run = Simulator(system, scenario).run(1, 0);
    ASSERT_EQ(run.ending, hybrid::Ending::horizon) << at << " " << run.message;
    const double x = at + (1 - std::exp(-3 * (3 - at))) / 3;
    EXPECT_NEAR(value_at(system, run, "x", 3)(0), x, 1e-14) << at;
  }
}

// Six periods a step of a clock: the values at its ends and middle say nothing.
TEST(EventKinks, TextsThatWaveWithinAStepTurnEachTime) {
  EventProblem problem;
  problem.state("x", {}, "0").flow("x", "1");
  problem.state("y", {}, "0").flow("y", "where(sin(20*pi*x) > 0.5, 1, 0)");
  problem.state("z", {}, "0").flow("z", "max(sin(20*pi*x), 0.5)");
  const hybrid::System system = problem.system();
  const hybrid::Scenario scenario = hybrid::make_scenario(10, system);
  const hybrid::Trajectory run = Simulator(system, scenario).run(1, 0);
  ASSERT_EQ(run.ending, hybrid::Ending::horizon) << run.message;
  EXPECT_NEAR(value_at(system, run, "y", 10)(0), 10.0 / 3, 1e-9);
  const double mean = 0.5 * 2 / 3 + std::sqrt(3.0) / (2 * std::numbers::pi);
  EXPECT_NEAR(value_at(system, run, "z", 10)(0), 10 * mean, 1e-6);
}

}  // namespace
}  // namespace gainsmith::simulate
