// Flows that are integrated: against closed forms, and shared by all runs.
#include "bounded/clocked_run.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bounded/sampled_problem.h"
#include "simulate/simulator.h"

namespace gainsmith::bounded {
namespace {

using Eigen::VectorXd;
using model::StartKind;
using tests::TextProblem;

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
