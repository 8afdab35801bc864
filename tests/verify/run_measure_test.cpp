// Means of figures over runs, against closed forms and against the runs themselves.
#include "verify/run_measure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "bind/stated.h"
#include "statistics/bound_figure.h"
#include "support/stop.h"
#include "support/yaml_problem.h"

namespace gainsmith::verify {
namespace {

using tests::YamlProblem;

/// x' = -k x from a start that is drawn in [0, 2]; an event when x is below 0.1.
std::string decay(const std::string& figure) {
  return R"(problem: decay
method:
  method: decay
  parameters: {k: 2}
  events: {low: {when: x < 0.1, if: count(low) < 1}}
  plant: {state: {x: {shape: scalar, start: 1}}, flow: {x: -k*x}}
search: {over: {k: [1, 3]}, runs: 4, minimize: )" +
         figure + R"(}
campaign: {horizon: 3, seed: 5, initial: {x: {box: [0, 2]}}}
)";
}

class Measures : public testing::Test {
 protected:
  static std::optional<double> mean(const YamlProblem& problem, std::uint64_t runs) {
    return mean_figure(problem.instance, {}, *problem.instance.design->search->run_figure, runs);
  }
  static double error(const YamlProblem& problem, std::uint64_t runs) {
    return mean_error(problem.instance, {}, *problem.instance.design->search->run_figure, runs);
  }
  static double start_of(const YamlProblem& problem, std::uint64_t run) {
    const auto setup = claims::make_run_setup(bind::run_texts(problem.instance, {}));
    simulate::Simulator simulator(setup->system, setup->scenario);
    const YamlProblem first(decay("{at: {t: 0}, value: x}"));
    statistics::BoundFigure start(*first.instance.design->search->run_figure, *setup);
    return start.of(simulator.run(5, run)).value();
  }
};

TEST_F(Measures, AreMeansOfWhatTheRunsGive) {
  const YamlProblem peak(decay("{peak: x}"));
  const YamlProblem rms(decay("{rms: x, over: [0, 3]}"));
  const double factor = std::sqrt((1 - std::exp(-12.0)) / 4 / 3);
  double sum = 0;
  for (std::uint64_t run = 0; run < 4; ++run) {
    sum += start_of(peak, run);
    const double runs = static_cast<double>(run + 1);
    EXPECT_NEAR(mean(peak, run + 1).value(), sum / runs, 1e-9);
    EXPECT_NEAR(mean(rms, run + 1).value(), factor * sum / runs, 1e-8);
  }
}

TEST_F(Measures, FollowTextsThatAreFasterThanTheSteps) {
  const YamlProblem rms(decay("{rms: sin(60*t), over: [0, 3]}"));
  EXPECT_NEAR(mean(rms, 1).value(), std::sqrt((1.5 - std::sin(360.0) / 240) / 3), 1e-9);
  const YamlProblem peak(decay("{peak: sin(60*t) + 0.1*cos(t)}"));
  EXPECT_NEAR(mean(peak, 1).value(), 1 + 0.1 * std::cos(std::numbers::pi / 120), 1e-9);
  const YamlProblem sign(decay("{rms: sign(sin(7*t)), over: [0, 3]}"));
  EXPECT_NEAR(mean(sign, 1).value(), 1, 1e-9);
  const YamlProblem settles(decay("{settles: sin(60*t), below: 0.5}"));
  // The last t <= 3 with sin(60 t) = 1/2 on the way down, 60 t = 5 pi/6 + 56 pi.
  EXPECT_NEAR(mean(settles, 1).value(), (5.0 / 6 + 56) * std::numbers::pi / 60, 1e-9);
}

TEST_F(Measures, HaveNoValueWhereARunHasNone) {
  EXPECT_TRUE(mean(YamlProblem(decay("{count: low}")), 4));
  EXPECT_FALSE(mean(YamlProblem(decay("{at: {event: low, count: 9}, value: x}")), 1));
  EXPECT_FALSE(mean(YamlProblem(decay("{at: {t: 4}, value: x}")), 1));
  EXPECT_FALSE(mean(YamlProblem(decay("{settles: x, below: 0}")), 1));
}

/// x(t) = x(0)*exp(-2 t), beside a pendulum, which makes the flow one that is integrated.
TEST_F(Measures, HaveErrors) {
  for (const std::string more : {"", ", p: sin(x)"}) {
    std::string text = decay("{at: {t: 1}, value: x}");
    text.replace(text.find("flow: {x: -k*x"), 14, "flow: {x: -k*x" + more);
    if (!more.empty())
      text.replace(text.find("start: 1}"), 9, "start: 1}, p: {shape: scalar, start: 0}");
    const YamlProblem problem(text);
    const YamlProblem start(decay("{at: {t: 0}, value: x}"));
    const double truth = mean(start, 4).value() * std::exp(-2);
    EXPECT_LE(std::abs(mean(problem, 4).value() - truth), error(problem, 4));
    EXPECT_LT(error(problem, 4), 1e-4);
  }
}

TEST_F(Measures, HaveNoErrorWhereARunDoesNotKnowThem) {
  const auto chaotic = [](const std::string& t) {
    return YamlProblem(R"(problem: p
method:
  method: m
  parameters: {k: 4}
  events: {tick: {every: 1}}
  plant: {state: {y: {shape: scalar, start: 0.3}}, at: {tick: {y: k*y*(1 - y)}}}
search: {over: {k: [3, 4]}, minimize: {at: {t: )" +
                       t + R"(}, value: y}}
campaign: {horizon: 90}
)");
  };
  EXPECT_LT(error(chaotic("10"), 1), 1e-9);
  EXPECT_TRUE(std::isinf(error(chaotic("90"), 1)));
}

TEST_F(Measures, AreTheSameBitsAgain) {
  const YamlProblem problem(decay("{rms: x, over: [0, 3]}"));
  EXPECT_EQ(mean(problem, 3), mean(problem, 3));
}

TEST_F(Measures, EndWhenTheyAreStopped) {
  const YamlProblem problem(decay("{rms: x, over: [0, 3]}"));
  const tests::StopInTest stop(true);
  EXPECT_THROW(mean(problem, 2), Stopped);
}

}  // namespace
}  // namespace gainsmith::verify
