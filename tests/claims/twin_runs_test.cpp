// Runs with their twins: until when they are certain, and when they part.
#include "claims/twin_runs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "bind/stated.h"
#include "support/yaml_problem.h"

namespace gainsmith::claims {
namespace {

using tests::YamlProblem;

/// x' = -x beside a map of y at each tick.
std::string problem(const std::string& map) {
  return R"(problem: p
method:
  method: m
  events: {tick: {every: 1}}
  plant:
    state: {x: {shape: scalar, start: 1}, y: {shape: scalar, start: 0.3}}
    flow: {x: -x}
    at: {tick: {y: ")" +
         map + R"("}}
campaign: {horizon: 80.5}
)";
}

struct Twins {
  explicit Twins(const std::string& text)
      : yaml(text),
        setup(make_run_setup(bind::run_texts(yaml.instance, {}))),
        runs(TwinRuns(*setup)(1, 0, kAccuracyOfOne)) {}

  std::string unknown(double until, const char* variable) const {
    const auto slot = *setup->system.slot(variable);
    return runs.unknown(until, {setup->system.layout.slots[slot].offset}, setup->system);
  }

  YamlProblem yaml;
  std::unique_ptr<const RunSetup> setup;
  TwinRun runs;
};

TEST(TwinRuns, WhatIsChaoticParts) {
  const Twins chaotic(problem("4*y*(1 - y)"));
  // Errors double at each tick: 2^-53 and what the first ticks round come to 1e-3 after about 43.
  EXPECT_EQ(chaotic.unknown(30.5, "y"), "");
  EXPECT_NE(chaotic.unknown(60.5, "y").find("size of y"), std::string::npos);
  EXPECT_EQ(chaotic.unknown(80.5, "x"), "") << "x does not depend on y";
  EXPECT_EQ(Twins(problem("0.5*y + 0.1")).unknown(80.5, "y"), "");
}

/// x(1) = sin(t) turns at 1.
TEST(TwinRuns, AnEventThatIsOnlyJustReachedEndsWhatIsCertain) {
  const auto twins = [](const std::string& level) {
    return Twins(R"(problem: p
method:
  method: m
  events: {top: {rises: "plant.x(1) - )" +
                 level + R"("}}
  plant: {state: {x: {shape: 2, start: "[0; 1]"}, n: {shape: scalar, start: 0}}, flow: {x: "[x(2); -x(1)]"}, at: {top: {n: n + 1}}}
campaign: {horizon: 3}
)");
  };
  const Twins tied = twins("1");
  EXPECT_EQ(tied.unknown(1.5, "n"), "");
  EXPECT_NE(tied.unknown(1.6, "n"), "");
  EXPECT_EQ(twins("0.999999").unknown(3, "n"), "");
  EXPECT_EQ(twins("1.000001").unknown(3, "n"), "");
}

TEST(TwinRuns, AStepAtATieEndsWhatIsCertain) {
  // y + 0.1 k comes to 0.5 at the second tick.
  const Twins tied(problem("y + where(y >= 0.4, 1, 0.1)"));
  EXPECT_EQ(tied.unknown(1.5, "y"), "");
  EXPECT_NE(tied.unknown(2, "y").find("takes a step"), std::string::npos) << tied.runs.doubt;
}

}  // namespace
}  // namespace gainsmith::claims
