// Flows that are integrated: against closed forms, against exact flows, and where they end.
#include "hybrid/integrated_run.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hybrid/exact_values.h"
#include "hybrid/text_problem.h"

namespace gainsmith::hybrid {
namespace {

using Eigen::VectorXd;
using model::StartKind;
using tests::column;
using tests::sampled_data;
using tests::scalar;
using tests::TextProblem;

VectorXd vector(std::initializer_list<double> elements) {
  VectorXd x(static_cast<Eigen::Index>(elements.size()));
  std::copy(elements.begin(), elements.end(), x.data());
  return x;
}

TEST(Integrator, FollowsAnOscillatorAtItsAccuracy) {
  Integrator flow(2, [](double, const VectorXd& x, VectorXd& rate) {
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
  Integrator flow(1, [&](double t, const VectorXd& x, VectorXd& rate) {
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
  Integrator escape(1, [](double, const VectorXd& x, VectorXd& rate) { rate(0) = x(0) * x(0); });
  escape.start(0, vector({1}), 5, 1e-9, VectorXd::Constant(1, 1e-12), 5);
  VectorXd x(1);
  try {
    escape.advance(2, x);
    ADD_FAILURE() << x(0);
  } catch (const IntegrationError& error) {
    EXPECT_NEAR(error.t, 1, 1e-6);
  }
  Integrator without(1, [](double t, const VectorXd&, VectorXd& rate) {
    if (t > 0.5) throw InputError({"f", 1, 1}, "no value here");
    rate(0) = 1;
  });
  without.start(0, vector({0}), 5, 1e-9, VectorXd::Constant(1, 1e-12), 5);
  try {
    without.advance(2, x);
    ADD_FAILURE() << x(0);
  } catch (const IntegrationError& error) {
    EXPECT_NE(std::string(error.what()).find("no value here"), std::string::npos);
    EXPECT_NEAR(error.t, 0.5, 1e-6);
  }
}

struct Made {
  explicit Made(TextProblem& problem)
      : instance(problem.instance()),
        system(make_system(instance, problem.gains)),
        scenario(make_scenario(*instance.design, system)),
        states(states_as_coordinates(system, exact_values(instance, system, problem.gains))),
        simulator(system, scenario, states) {}

  model::Instance instance;
  System system;
  Scenario scenario;
  Coordinates states;
  IntegratedSimulator simulator;
};

/// x' = -c x^2 from x0 is x0/(1 + c x0 t); x+ = x + 1.
TEST(IntegratedRun, StaysWithinItsBoundsOfTheClosedForm) {
  TextProblem problem;
  problem.state("x", "scalar").flow({{"x", "-2*x^2"}}).jump({{"x", "x + 1"}});
  problem.timer("0.1", "3", "0", "3").horizon("30").start("x", StartKind::box, {"0.5", "4"});
  Made made(problem);
  EXPECT_FALSE(made.system.flow);
  for (const double accuracy : {1e-6, 1e-8, 1e-10})
    for (std::uint64_t run = 0; run < 20; ++run) {
      const Track<double>& track = made.simulator.run(3, run, accuracy);
      ASSERT_EQ(track.termination, Termination::horizon) << track.message;
      EXPECT_EQ(track.t.back(), 30);
      long double x = track.state(0)(0);
      for (std::size_t k = 1; k < track.samples(); ++k) {
        const long double length = static_cast<long double>(track.timer[k - 1]) - track.timer[k];
        x = track.moves[k - 1].jump ? x + 1 : x / (1 + 2 * x * length);
        const double error = std::abs(static_cast<double>(x) - track.state(k)(0));
        EXPECT_LE(error, track.bound(k)(0) + 1e-14) << accuracy << " " << run << " " << k;
        EXPECT_LT(track.bound(k)(0), 100 * accuracy);
      }
    }
}

/// x' = [0 1; -1 -s] x + [0; s], s since the last jump, and the integral of x'x/(1 + s): the same
/// run by itself and with flows that all runs share.
TEST(IntegratedRun, SharesFlowsThatAreLinearButForClocks) {
  TextProblem problem;
  problem.state("x", "2").state("k", "scalar").state("s", "scalar");
  problem.flow({{"x", "[0, 1; -1, -s]*x + [k; s]"}, {"s", "1"}});
  problem.jump({{"x", "x*exp(-s)"}, {"k", "x(1)"}, {"s", "0"}}).timer("0.1", "2", "0", "2");
  problem.horizon("15").start("s", StartKind::expression, {"0"});
  Made made(problem);
  Coordinates states = made.states;
  const Eigen::Index integral = add_integral(states, "c", problem.program("x'*x/(1 + s) + k*x(2)"));
  SharedFlows shared(made.system, made.scenario, states, {integral});
  ASSERT_NE(shared.to(1e-8), nullptr);
  EXPECT_EQ(shared.to(1e-8), shared.to(1e-8));
  EXPECT_LT(shared.to(1e-8)->pieces(), 40U);
  IntegratedSimulator with(made.system, made.scenario, states, &shared);
  IntegratedSimulator without(made.system, made.scenario, states);
  for (std::uint64_t run = 0; run < 20; ++run) {
    const Track<double>& a = with.run(5, run, 1e-8);
    const Track<double>& b = without.run(5, run, 1e-8);
    ASSERT_EQ(a.samples(), b.samples());
    for (std::size_t k = 0; k < a.samples(); ++k) {
      EXPECT_EQ(a.t[k], b.t[k]);
      const VectorXd difference = (a.state(k) - b.state(k)).cwiseAbs();
      EXPECT_TRUE((difference.array() <= a.bound(k).array() + b.bound(k).array()).all())
          << run << " " << k << ": " << difference.transpose();
    }
  }
}

TEST(IntegratedRun, SharesNoOtherFlows) {
  const auto is_shared = [](const char* flow, const char* jump, const char* start) {
    TextProblem problem;
    problem.state("x", "scalar").state("s", "scalar").flow({{"x", flow}, {"s", "1"}});
    problem.jump({{"s", jump}}).timer("0.5", "1", "0.5", "1");
    problem.start("s", StartKind::expression, {start});
    Made made(problem);
    SharedFlows shared(made.system, made.scenario, made.states, {});
    return shared.to(1e-8) != nullptr;
  };
  EXPECT_TRUE(is_shared("-s*x", "0", "0"));
  EXPECT_TRUE(is_shared("-s*x", "0.25", "1/4"));
  EXPECT_FALSE(is_shared("-s*x", "0", "0.25"));
  EXPECT_FALSE(is_shared("-s*x", "s", "0"));
  EXPECT_FALSE(is_shared("-s*x", "s/2", "0"));
  EXPECT_FALSE(is_shared("-s*x^2", "0", "0"));
  EXPECT_FALSE(is_shared("-tau*x", "0", "0"));
}

/// The published observer, once exactly and once with a flow that only says that it moves.
TEST(IntegratedRun, AgreesWithTheExactFlow) {
  const auto make = [](const char* nothing) {
    TextProblem problem =
        sampled_data("1.1", column({3.68, -24.47}), column({0.104, -0.948}), scalar(-25.93));
    problem.horizon("20");
    problem.flow({{"z", std::string("A*z") + nothing}});
    return problem;
  };
  TextProblem exact = make("");
  TextProblem moving = make(" + 0*tau*z");
  Made made(moving);
  ASSERT_FALSE(made.system.flow);
  const model::Instance instance = exact.instance();
  const System system = make_system(instance, exact.gains);
  const Scenario scenario = make_scenario(*instance.design, system);
  const FlowSteps steps = make_steps(system);
  Simulator simulator(system, scenario, steps);
  for (std::uint64_t run = 0; run < 10; ++run) {
    const Arc arc = simulator.run(7, run);
    const Track<double>& track = made.simulator.run(7, run, 1e-10);
    EXPECT_EQ(arc.t.back(), track.t.back());
    EXPECT_EQ(arc.j.back(), track.j.back());
    EXPECT_EQ(arc.state(0), track.state(0));
    const VectorXd error = (arc.state(arc.samples() - 1) - track.state(track.samples() - 1));
    const double size = arc.states().cwiseAbs().maxCoeff();
    EXPECT_LT(error.cwiseAbs().maxCoeff(), 1e-8 * size) << run;
  }
}

TEST(IntegratedRun, StillAndTickingStatesHaveNoErrorOfIntegration) {
  TextProblem problem;
  problem.state("x", "scalar").state("s", "scalar").state("k", "scalar");
  problem.flow({{"x", "s*sin(x)"}, {"s", "1"}}).jump({{"s", "0"}, {"k", "k + 1"}});
  problem.timer("0.3", "0.3", "0.3", "0.3").horizon("3");
  problem.start("s", StartKind::expression, {"0"}).start("k", StartKind::expression, {"0.1"});
  Made made(problem);
  const Track<double>& track = made.simulator.run(1, 0, 1e-6);
  for (std::size_t k = 1; k < track.samples(); ++k) {
    EXPECT_NEAR(track.state(k)(1) + track.timer[k], 0.3, 1e-15);
    EXPECT_LE(track.bound(k)(1), 1e-15);
    if (!track.moves[k - 1].jump) {
      EXPECT_EQ(track.state(k)(2), track.state(k - 1)(2));
    }
  }
}

/// Intervals that are as short as the shortest step of the one before.
TEST(IntegratedRun, FlowsMayBeOfAnyLength) {
  TextProblem problem;
  problem.state("x", "scalar").flow({{"x", "-x*abs(x)"}}).timer("0", "1", "1", "1");
  problem.law(model::LawKind::list, {"1e-13", "1", "0", "1e-9", "1e-15", "0.5"}).horizon("7");
  problem.start("x", StartKind::expression, {"1"});
  Made made(problem);
  const Track<double>& track = made.simulator.run(1, 0, 1e-8);
  EXPECT_EQ(track.termination, Termination::horizon) << track.message;
  EXPECT_NEAR(track.state(track.samples() - 1)(0), 1.0 / 8, 1e-9);
}

/// What hangs on the rounding of a jump is not certain: 0.1 + 0.2 is 0.3.
TEST(IntegratedRun, IsLostWhereRoundingDecidesAboutAValue) {
  TextProblem problem;
  problem.state("x", "scalar").flow({{"x", "-x*abs(x)"}}).timer("1", "1", "1", "1");
  problem.jump({{"x", "1/(0.1 + 0.2 - 0.3)"}}).horizon("3");
  problem.start("x", StartKind::expression, {"1"});
  Made made(problem);
  EXPECT_EQ(made.simulator.run(1, 0, 1e-8).termination, Termination::lost);
}

/// A flow that slides, after a rest, on a state that has grown, does not escape.
TEST(IntegratedRun, SlidingIsNoEscape) {
  TextProblem problem;
  problem.state("x", "scalar").state("s", "scalar").timer("1", "1", "1", "1").horizon("1");
  problem.flow({{"x", "where(s < 0.2, 0, 10*sign(1 - x))"}, {"s", "1"}});
  problem.start("x", StartKind::expression, {"1e-9"}).start("s", StartKind::expression, {"0"});
  Made made(problem);
  EXPECT_NE(made.simulator.run(1, 0, 1e-8).termination, Termination::undefined);
}

TEST(IntegratedRun, EndsWhereTheFlowDoes) {
  TextProblem escape;
  escape.state("x", "scalar").flow({{"x", "x^2"}}).timer("1", "1", "10", "10");
  escape.start("x", StartKind::expression, {"1"});
  Made made(escape);
  const Track<double>& track = made.simulator.run(1, 0, 1e-8);
  EXPECT_EQ(track.termination, Termination::undefined);
  EXPECT_NE(track.message.find("after the last jump"), std::string::npos) << track.message;
  EXPECT_LT(track.t.back(), 1);
  TextProblem root;
  root.state("x", "scalar").flow({{"x", "-sqrt(x) - 1"}}).timer("1", "1", "10", "10");
  root.start("x", StartKind::expression, {"1"});
  Made ends(root);
  const Track<double>& ended = ends.simulator.run(1, 0, 1e-8);
  EXPECT_EQ(ended.termination, Termination::lost) << ended.message;
  EXPECT_NE(ended.message.find("sqrt"), std::string::npos) << ended.message;
}

}  // namespace
}  // namespace gainsmith::hybrid
