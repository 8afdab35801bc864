// Flows step by step, scenarios and draws: against closed forms.
#include "simulate/exact_flow.h"
#include "simulate/integrated_flow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ode/integrator.h"
#include "support/event_problem.h"
#include "support/input_error.h"

namespace gainsmith::simulate {
namespace {

using Eigen::VectorXd;
using numbers::Matrix;
using tests::EventProblem;
using tests::input_error;
using tests::jumps_of;
using tests::part_of;

/// The steps of a flow from the start that the dynamics give.
std::vector<hybrid::DenseStep> steps_of(const hybrid::System& system, VectorField& field,
                                        Flow& flow, double last) {
  const hybrid::Scenario scenario = hybrid::make_scenario(last, system);
  VectorXd values = hybrid::draw_start(system, scenario, 1, 0);
  field.reset();
  field.begin(0, values);
  flow.start(0, values, last);
  std::vector<hybrid::DenseStep> steps;
  while (steps.empty() || steps.back().to < last) steps.push_back(flow.next());
  return steps;
}

double largest_error(const hybrid::System& system, const std::vector<hybrid::DenseStep>& steps,
                     const std::function<VectorXd(double)>& exact) {
  double error = 0;
  for (const hybrid::DenseStep& step : steps)
    for (int k = 0; k <= 7; ++k) {
      const double t = step.from + (step.to - step.from) * k / 7;
      const VectorXd difference = part_of(system, step(t), "x") - exact(t);
      error = std::max(error, difference.cwiseAbs().maxCoeff());
    }
  return error;
}

TEST(EventFlow, StiffAndSwingingModesAreExactBetweenStepsToo) {
  EventProblem problem;
  problem.state("x", {4, 1}, "[1; 1; 0; 2]");
  problem.flow("x", "[-1e6*x(1); 20*x(3); -20*x(2); 0.5*x(4) - 1]");
  const hybrid::System system = problem.system();
  ASSERT_TRUE(system.affine);
  VectorField field(system);
  const auto flow = exact_flow(field, 1);
  const auto steps = steps_of(system, field, *flow, 3);
  const auto exact = [](double t) {
    VectorXd x(4);
    x << std::exp(-1e6 * t), std::cos(20 * t), -std::sin(20 * t), 2;
    return x;
  };
  EXPECT_LT(largest_error(system, steps, exact), 1e-12);
  EXPECT_LT(steps.size(), 500U);
}

/// The poles of a fast observer, -1e6 (1 +- i): once they have died down, steps are those of the rest.
TEST(EventFlow, WhatSwingsAndDiesDownAsksForNoMoreSteps) {
  EventProblem problem;
  problem.state("x", {3, 1}, "[1; 0; 1]");
  problem.flow("x", "[-1e6*x(1) + 1e6*x(2); -1e6*x(1) - 1e6*x(2); -x(3)]");
  const hybrid::System system = problem.system();
  VectorField field(system);
  const auto flow = exact_flow(field, 5);
  const auto steps = steps_of(system, field, *flow, 5);
  const auto exact = [](double t) {
    const double decay = std::exp(-1e6 * t);
    return VectorXd(
        Eigen::Vector3d(decay * std::cos(1e6 * t), -decay * std::sin(1e6 * t), std::exp(-t)));
  };
  EXPECT_LT(largest_error(system, steps, exact), 1e-12);
  EXPECT_LT(steps.size(), 2000U);
}

/// What the squaring of an exponential multiplies is as large as |A| times the length.
TEST(EventFlow, AFastModeLeavesTheDigitsOfASlowOne) {
  EventProblem problem;
  problem.state("x", {4, 1}, "[1; 1; 0; 1]");
  problem.flow("x",
               "[-1e8*x(1) + 7e8*x(2); -7e8*x(1) - 1e8*x(2); -0.1*x(3) + 2*x(4); "
               "-2*x(3) - 0.1*x(4)]");
  const hybrid::System system = problem.system();
  VectorField field(system);
  const auto flow = exact_flow(field, 4);
  double error = 0;
  for (const hybrid::DenseStep& step : steps_of(system, field, *flow, 4)) {
    const VectorXd x = part_of(system, step(step.to), "x");
    const double decay = std::exp(-0.1 * step.to);
    error = std::max(error, std::abs(x(2) - decay * std::sin(2 * step.to)));
    error = std::max(error, std::abs(x(3) - decay * std::cos(2 * step.to)));
  }
  EXPECT_LT(error, 2e-13);
}

/// What each of 20,000 equal steps loses of the time is not lost 20,000 times.
TEST(EventFlow, AFastSwingKeepsItsPhase) {
  EventProblem problem;
  problem.state("x", {2, 1}, "[1; 0]").flow("x", "[1000*x(2); -1000*x(1)]");
  const hybrid::System system = problem.system();
  VectorField field(system);
  const auto flow = exact_flow(field, 20);
  const auto exact = [](double t) {
    return VectorXd(Eigen::Vector2d(std::cos(1000 * t), -std::sin(1000 * t)));
  };
  EXPECT_LT(largest_error(system, steps_of(system, field, *flow, 20), exact), 2e-11);
}

/// A claim may multiply it by exp(10*t).
TEST(EventFlow, WhatDiesKeepsItsDigits) {
  EventProblem problem;
  problem.state("x", {2, 1}, "[1; 1]").flow("x", "[-5*x(1); -10*x(2)]");
  const hybrid::System system = problem.system();
  VectorField field(system);
  const auto flow = exact_flow(field, 40);
  for (const hybrid::DenseStep& step : steps_of(system, field, *flow, 40)) {
    const double expected = std::exp(-5 * step.to);
    EXPECT_NEAR(part_of(system, step(step.to), "x")(0), expected, 1e-11 * expected) << step.to;
  }
}

TEST(EventFlow, NoiseThatIsHeldIsAnInputAndNoParameter) {
  EventProblem problem;
  problem.noise("w", model::Dynamics::NoiseKind::normal, {"0", "2"}, "", "0.5");
  problem.noise("v", model::Dynamics::NoiseKind::uniform, {"-1", "3"}, "", "0.5");
  problem.state("x", {2, 1}, "[1; 0]").state("s", {1, 1}, "0.5").state("q", {1, 1}, "3");
  problem.flow("x", "[x(2) + w + s; v*x(1) - x(2)]").flow("s", "w").flow("q", "0");
  const hybrid::System system = problem.system();
  ASSERT_TRUE(system.affine);
  VectorField field(system);
  const VectorXd values = VectorXd::Constant(system.whole, 1.5);
  // v, of which an exponential is made each time, and whether all are frozen.
  EXPECT_EQ(field.parameters(values).size(), 2);
  ASSERT_EQ(field.linear_inputs().size(), 2U);  // s, which is a line, and w
}

TEST(EventFlow, LinesAndHeldValuesMoveAnExactFlow) {
  EventProblem problem;
  problem.state("x", {2, 1}, "[1; 0]").state("s", {1, 1}, "0.5").state("q", {1, 1}, "3");
  problem.flow("x", "[x(2); s + q]").flow("s", "q - 1").flow("q", "0");
  const hybrid::System system = problem.system();
  VectorField field(system);
  EXPECT_EQ(field.parameters(VectorXd::Zero(system.whole)).size(), 1);
  const auto flow = exact_flow(field, 1);
  const auto steps = steps_of(system, field, *flow, 3);
  const auto exact = [](double t) {  // x'' = 3.5 + 2 t
    return VectorXd(Eigen::Vector2d(1 + 3.5 * t * t / 2 + t * t * t / 3, 3.5 * t + t * t));
  };
  EXPECT_LT(largest_error(system, steps, exact), 1e-13);
}

TEST(EventFlow, IntegratedStepsMeetAndKeepTheirAccuracy) {
  EventProblem problem;
  problem.state("x", {2, 1}, "[0; 2]").flow("x", "[x(2); -sin(x(1))]");  // the separatrix
  const hybrid::System system = problem.system();
  ASSERT_FALSE(system.affine);
  VectorField field(system);
  const auto exact = [](double t) {
    VectorXd x(2);
    x << 4 * std::atan(std::tanh(t / 2)), 2 / std::cosh(t);
    return x;
  };
  double before = 1;
  for (const double accuracy : {1e-6, 1e-8, 1e-10}) {
    const auto flow = integrated_flow(field, {accuracy, accuracy}, 1);
    const auto steps = steps_of(system, field, *flow, 3);
    const double error = largest_error(system, steps, exact);
    EXPECT_LT(error, 300 * accuracy);
    EXPECT_LT(error, before / 5);
    before = error;
    for (std::size_t k = 0; k + 1 < steps.size(); ++k) {
      EXPECT_EQ(steps[k].to, steps[k + 1].from);
      const VectorXd jump = steps[k](steps[k].to) - steps[k + 1](steps[k].to);
      EXPECT_LT(jump.cwiseAbs().maxCoeff(), 1e-14);
    }
  }
}

TEST(EventFlow, VeryStiffFlowsDoNotStandStill) {
  EventProblem problem;
  problem.state("x", {1, 1}, "2").flow("x", "-1e6*(x - cos(t)) + 0*x^2");
  const hybrid::System system = problem.system();
  VectorField field(system);
  const auto flow = integrated_flow(field, {1e-8, 1e-8}, 1);
  const auto steps = steps_of(system, field, *flow, 10);
  EXPECT_LT(steps.size(), 20000U);
  EXPECT_NEAR(part_of(system, steps.back()(10), "x")(0), std::cos(10), 1e-5);
}

TEST(EventFlow, WhatHasNoValueEndsTheFlow) {
  EventProblem problem;
  problem.state("x", {1, 1}, "1").flow("x", "-1/sqrt(x)");
  const hybrid::System system = problem.system();
  VectorField field(system);
  const auto flow = integrated_flow(field, {}, 1);
  try {
    steps_of(system, field, *flow, 5);
    FAIL();
  } catch (const ode::IntegrationError& error) {
    EXPECT_TRUE(error.undefined);
    EXPECT_NEAR(error.t, 2.0 / 3, 1e-3);
  }
}

TEST(EventScenarioTest, DrawsStayInTheirRangeAndHaveTheirMoments) {
  EventProblem problem;
  problem.noise("w", model::Dynamics::NoiseKind::normal, {"0", "2"}, "", "1");
  problem.noise("v", model::Dynamics::NoiseKind::uniform, {"-1", "3"}, "", "1");
  const hybrid::System system = problem.system();
  hybrid::NoiseDraws draws(system, {}, 7, 0);
  VectorXd values = VectorXd::Zero(system.whole);
  constexpr int kDraws = 20000;
  double mean = 0;
  double square = 0;
  double uniform = 0;
  for (int k = 0; k < kDraws; ++k) {
    draws.draw(0, values);
    draws.draw(1, values);
    const double w = part_of(system, values, "w")(0);
    const double v = part_of(system, values, "v")(0);
    mean += w / kDraws;
    square += w * w / kDraws;
    uniform += v / kDraws;
    ASSERT_GE(v, -1);
    ASSERT_LT(v, 3);
  }
  EXPECT_NEAR(mean, 0, 0.06);
  EXPECT_NEAR(square, 4, 0.2);
  EXPECT_NEAR(uniform, 1, 0.04);
}

TEST(EventScenarioTest, LawsAndFirstTimesRuleTheClocks) {
  EventProblem problem;
  problem.every("tick", "1", "2", "0");
  const hybrid::System system = problem.system();
  hybrid::Scenario scenario = hybrid::make_scenario(10, system);
  scenario.laws[0] = {{model::LawKind::list, 1, 2, {1, 1.5}},
                      {model::LawKind::constant, 1, 2, {2}}};
  Simulator simulator(system, scenario);
  const auto times = [&](std::uint64_t run) {
    std::vector<double> result;
    for (const hybrid::JumpPoint& jump : jumps_of(simulator.run(1, run))) result.push_back(jump.t);
    return result;
  };
  EXPECT_EQ(times(0), (std::vector<double>{0, 1, 2.5, 3.5, 5, 6, 7.5, 8.5, 10}));
  EXPECT_EQ(times(1), (std::vector<double>{0, 2, 4, 6, 8, 10}));
}

TEST(EventScenarioTest, StatesStartWhereTheyAreTold) {
  EventProblem problem;
  problem.state("x", {2, 1}, "[1; 2]").state("y", {}, "x(1) + 2*x(2)").symmetric("P", 2, "eye(2)");
  const hybrid::System system = problem.system();
  hybrid::Scenario scenario = hybrid::make_scenario(1, system);
  EXPECT_EQ(part_of(system, hybrid::draw_start(system, scenario, 1, 0), "y")(0), 5);
  const std::size_t P = system.slot("P").value();
  hybrid::StartRule box{model::StartKind::box, {-Matrix::Ones(2, 2), Matrix::Ones(2, 2)}, {}, {}};
  scenario.starts[P] = box;
  const Matrix drawn = part_of(system, hybrid::draw_start(system, scenario, 1, 3), "P");
  EXPECT_EQ(drawn(0, 1), drawn(1, 0));
  EXPECT_NE(drawn(0, 0), drawn(1, 1));
  EXPECT_EQ(drawn, part_of(system, hybrid::draw_start(system, scenario, 1, 3), "P"));
  EXPECT_NE(drawn, part_of(system, hybrid::draw_start(system, scenario, 1, 4), "P"));
}

TEST(EventScenarioTest, WhatDoesNotFitIsAnError) {
  EventProblem later;
  later.state("y", {}, "x").state("x", {}, "1");
  const hybrid::System early = later.system();
  EXPECT_NE(input_error([&] { hybrid::make_scenario(1, early); }).message().find("no value yet"),
            std::string::npos);
  EventProblem none;
  none.state("x", {}, "");
  const hybrid::System nowhere = none.system();
  EXPECT_NE(input_error([&] { hybrid::make_scenario(1, nowhere); }).message().find("has no start"),
            std::string::npos);
  EventProblem clock;
  clock.every("tick", "2", "1");
  EXPECT_NE(input_error([&] { clock.system(); }).message().find("expected 0 <= low <= high"),
            std::string::npos);
  EventProblem never;
  never.every("tick", "0", "0");
  EXPECT_NE(input_error([&] { never.system(); }).message().find("high > 0"), std::string::npos);
  EventProblem passes;
  passes.state("x", {}, "1").at("go", {"1"}).repeat("go", {{"x", "x/2"}}, "x < 0.1", "2.5");
  EXPECT_NE(input_error([&] { passes.system(); }).message().find("whole number of passes"),
            std::string::npos);
}

TEST(EventInstant, TheStartAndTheHorizonAreInstants) {
  EventProblem problem;
  problem.state("x", {}, "2").state("n", {}, "0").when("high", "x >= 2");
  problem.jump("high", {{"x", "x - 1"}}).at("mark", {"0", "3"}).jump("mark", {{"n", "n + 1"}});
  const hybrid::System system = problem.system();
  const hybrid::Scenario scenario = hybrid::make_scenario(3, system);
  const hybrid::Trajectory run = Simulator(system, scenario).run(1, 0);
  const auto jumps = jumps_of(run);
  ASSERT_EQ(jumps.size(), 3U);
  EXPECT_EQ(jumps[0].t, 0);
  EXPECT_EQ(jumps[0].event, 0U);
  EXPECT_EQ(jumps[1].t, 0);
  EXPECT_EQ(jumps[2].t, 3);
  EXPECT_EQ(run.ending, hybrid::Ending::horizon);
}

}  // namespace
}  // namespace gainsmith::simulate
