// Flows that are integrated: against closed forms, and shared by all runs.
#include "bounded/clocked_run.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bounded/sampled_problem.h"
#include "ode/integrator.h"
#include "simulate/simulator.h"

namespace gainsmith::bounded {
namespace {

using Eigen::VectorXd;
using model::StartKind;
using tests::TextProblem;

VectorXd vector(std::initializer_list<double> elements) {
  VectorXd x(static_cast<Eigen::Index>(elements.size()));
  std::copy(elements.begin(), elements.end(), x.data());
  return x;
}

TEST(Integrator, FollowsAnOscillatorAtItsAccuracy) {
  ode::Integrator flow(2, [](double, const VectorXd& x, VectorXd& rate) {
    rate(0) = x(1);
    rate(1) = -x(0);
  });
  double before = 1;
  for (const double relative : {1e-6, 1e-9, 1e-12}) {
    flow.start(0, vector({1, 0}), 10, relative, VectorXd::Constant(2, relative), 10);
    VectorXd x(2);
    double error = 0;
    for (int k = 1; k <= 50; ++k) {
      flow.advance(0.2 * k, x);
      error =
          std::max({error, std::abs(x(0) - std::cos(0.2 * k)), std::abs(x(1) + std::sin(0.2 * k))});
    }
    EXPECT_LT(error, 1e3 * relative);
    EXPECT_LT(error, before / 50);
    before = error;
  }
}

/// x' = -k (x - cos t) - sin t has the solution cos t; k = 1e7 over 10 s is 1e8 steps of Adams.
TEST(Integrator, GoesOnWithStiffSteps) {
  int calls = 0;
  ode::Integrator flow(1, [&](double t, const VectorXd& x, VectorXd& rate) {
    ++calls;
    rate(0) = -1e7 * (x(0) - std::cos(t)) - std::sin(t);
  });
  flow.start(0, vector({1}), 10, 1e-8, VectorXd::Constant(1, 1e-8), 10);
  VectorXd x(1);
  flow.advance(10, x);
  EXPECT_NEAR(x(0), std::cos(10), 1e-6);
  EXPECT_LT(calls, 100000);
}

TEST(Integrator, SaysWhereAFlowEnds) {
  ode::Integrator escape(1,
                         [](double, const VectorXd& x, VectorXd& rate) { rate(0) = x(0) * x(0); });
  escape.start(0, vector({1}), 5, 1e-9, VectorXd::Constant(1, 1e-12), 5);
  VectorXd x(1);
  try {
    escape.advance(2, x);
    ADD_FAILURE() << x(0);
  } catch (const ode::IntegrationError& error) {
    EXPECT_NEAR(error.t, 1, 1e-6);
  }
  ode::Integrator without(1, [](double t, const VectorXd&, VectorXd& rate) {
    if (t > 0.5) throw InputError({"f", 1, 1}, "no value here");
    rate(0) = 1;
  });
  without.start(0, vector({0}), 5, 1e-9, VectorXd::Constant(1, 1e-12), 5);
  try {
    without.advance(2, x);
    ADD_FAILURE() << x(0);
  } catch (const ode::IntegrationError& error) {
    EXPECT_NE(std::string(error.what()).find("no value here"), std::string::npos);
    EXPECT_NEAR(error.t, 0.5, 1e-6);
  }
}

/// x' = [0 1; -1 -s] x + [0; s], s since the last jump: against the careful simulator.
TEST(ClockedRun, SharesFlowsThatAreLinearButForClocks) {
  TextProblem problem;
  problem.state("x", "2").state("k", "scalar").state("s", "scalar").state("c", "scalar");
  problem.flow({{"x", "[0, 1; -1, -s]*x + [k; s]"}, {"s", "1"}, {"c", "x'*x/(1 + s) + k*x(2)"}});
  problem.jump({{"x", "x*exp(-s)"}, {"k", "x(1)"}, {"s", "0"}}).timer("0.1", "2", "0", "2");
  problem.start("c", StartKind::expression, {"0"});
  problem.horizon("15").start("s", StartKind::expression, {"0"});
  const SampledProblem made(problem);
  const Coordinates states = made.states();
  const Eigen::Index integral = states.layout.size - 1;
  ClockedFlows flows(made.system(), made.scenario, states, {integral});
  ASSERT_NE(flows.to(1e-8), nullptr);
  EXPECT_EQ(flows.to(1e-8), flows.to(1e-8));
  EXPECT_LT(flows.to(1e-8)->pieces(), 40U);
  ClockedSimulator simulator(made.system(), made.scenario, states, flows);
  simulate::Simulator careful(made.dynamics, made.scenario);
  for (std::uint64_t run = 0; run < 20; ++run) {
    const Track<double>& track = simulator.run(5, run, 1e-8);
    const hybrid::Trajectory trajectory = careful.run(5, run, {1e-11, 1e-11});
    std::size_t k = 0;
    for (const auto& part : trajectory.parts) {
      const auto* jump = std::get_if<hybrid::JumpPoint>(&part);
      if (jump == nullptr) continue;
      while (!track.moves.at(k).jump) ++k;
      const VectorXd difference = (track.state(k) - jump->before.head(track.size)).cwiseAbs();
      EXPECT_TRUE((difference.array() <= track.bound(k).array() + 1e-9).all())
          << run << " " << k << ": " << difference.transpose();
      ++k;
    }
    EXPECT_EQ(track.t.back(), 15);
  }
}

/// x' = -s x + 1 + s^2 from 1 has the solution s + exp(-s^2/2).
TEST(ClockedRun, BoundsHoldTheErrorOfAClosedForm) {
  TextProblem problem;
  problem.state("x", "scalar").state("s", "scalar");
  problem.flow({{"x", "-s*x + 1 + s^2"}, {"s", "1"}}).timer("3", "3", "3", "3").horizon("3");
  problem.start("x", StartKind::expression, {"1"}).start("s", StartKind::expression, {"0"});
  problem.jump({{"s", "0"}});
  const SampledProblem made(problem);
  const Coordinates states = made.states();
  ClockedFlows flows(made.system(), made.scenario, states, {});
  ClockedSimulator simulator(made.system(), made.scenario, states, flows);
  const Track<double>& track = simulator.run(1, 0, 1e-5);
  for (std::size_t k = 0; k < track.samples() && !(k > 0 && track.moves[k - 1].jump); ++k) {
    const double s = track.t[k];
    const double error = std::abs(track.state(k)(0) - s - std::exp(-s * s / 2));
    EXPECT_LE(error, track.bound(k)(0)) << s;
    EXPECT_LE(track.bound(k)(0), 1e-3) << s;
  }
}

/// x' = -(20 + s) x falls to exp(-20.5) of its start in a second.
TEST(ClockedRun, FollowsADecayOverManyDecades) {
  TextProblem problem;
  problem.state("x", "scalar").state("s", "scalar");
  problem.flow({{"x", "-(20 + s)*x"}, {"s", "1"}}).jump({{"s", "0"}}).horizon("1");
  problem.timer("2", "2", "2", "2").start("x", StartKind::expression, {"1"});
  problem.start("s", StartKind::expression, {"0"});
  const SampledProblem made(problem);
  const Coordinates states = made.states();
  ClockedFlows flows(made.system(), made.scenario, states, {});
  ClockedSimulator simulator(made.system(), made.scenario, states, flows);
  const Track<double>& track = simulator.run(1, 0, 1e-8);
  EXPECT_NEAR(track.state(track.samples() - 1)(0) * std::exp(20.5), 1, 1e-5);
}

TEST(ClockedRun, SharesNoOtherFlows) {
  const auto is_shared = [](const char* flow, const char* jump, const char* start) {
    TextProblem problem;
    problem.state("x", "scalar").state("s", "scalar").flow({{"x", flow}, {"s", "1"}});
    problem.jump({{"s", jump}}).timer("0.5", "1", "0.5", "1");
    problem.start("s", StartKind::expression, {start});
    const SampledProblem made(problem);
    const Coordinates states = made.states();
    ClockedFlows shared(made.system(), made.scenario, states, {});
    return shared.to(1e-8) != nullptr;
  };
  EXPECT_TRUE(is_shared("-s*x", "0", "0"));
  EXPECT_TRUE(is_shared("-s*x", "0.25", "1/4"));
  EXPECT_FALSE(is_shared("-s*x", "0", "0.25"));
  EXPECT_FALSE(is_shared("-s*x", "s", "0"));
  EXPECT_FALSE(is_shared("-s*x", "s/2", "0"));
  EXPECT_FALSE(is_shared("-s*x^2", "0", "0"));
  EXPECT_FALSE(is_shared("-tau*x", "0", "0"));
  EXPECT_TRUE(is_shared("sin(300*s)*x", "0", "0"));   // of many pieces
  EXPECT_FALSE(is_shared("sin(1e6*s)*x", "0", "0"));  // of too many pieces
}

}  // namespace
}  // namespace gainsmith::bounded
