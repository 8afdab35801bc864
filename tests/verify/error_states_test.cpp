#include "verify/error_states.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "bind/bind.h"
#include "io/problem_text.h"
#include "verify/campaign.h"

namespace gainsmith::verify {
namespace {

using model::CampaignVerdict;

/// z grows by exp(20), one of its elements after the other is measured.
model::Instance two_sensors(const std::string& flow, const std::string& jump,
                            const std::string& claims) {
  return bind::bind(io::read_problem(R"yaml(problem: p
method:
  method: m
  events: {one: {every: [0.05, 0.1]}, two: {every: [0.04, 0.13]}}
  plant:
    state: {z: {shape: 2, start: "[1; -1]"}}
    output: {y1: {value: z(1), at: one}, y2: {value: z(2), at: two}}
    flow: {z: "[2*z(1) + z(2); 1.5*z(2)]"}
  observer:
    state: {zh: {shape: 2, start: "[0.3; 0.2]"}}
    at:
      one: {zh: "zh + [0.7; 0]*(y1 - zh(1))"}
      two: {zh: ")yaml" + jump + "\"}\n    flow: {zh: \"" +
                                     flow + "\"}\n  claims: " + claims +
                                     "\ncampaign: {runs: 3, horizon: 10}\n"));
}

const std::string kCopy = "[2*zh(1) + zh(2); 1.5*zh(2)]";
const std::string kCorrection = "zh + [0; 0.7]*(y2 - zh(2))";

TEST(ErrorStates, AnObserverOfAGrowingPlantIsJudgedByItsError) {
  const model::Instance instance =
      two_sensors(kCopy, kCorrection, "{small: {shrinks: norm(z - zh), to: 1e-12}}");
  CampaignOptions options;
  options.threads = 1;
  EXPECT_EQ(run_campaign(*make_setup(instance, {}), options).verdict, CampaignVerdict::held);
}

TEST(ErrorStates, RunsOfBothSystemsAreTheSame) {
  const model::Instance instance =
      two_sensors(kCopy, kCorrection, "{small: {shrinks: norm(z - zh), to: 1e-12}}");
  const auto both = make_setup(instance, {});
  const auto& written = both->events;
  const auto& errors = both->errors;
  ASSERT_NE(errors, nullptr);
  const auto end_of = [](const claims::RunSetup& setup) {
    const hybrid::Trajectory run = simulate::Simulator(setup.system, setup.scenario)
                                       .run(7, 0, setup.accuracy(claims::kAccuracyOfOne));
    return std::get<hybrid::FlowPiece>(run.parts[40]).start;
  };
  const Eigen::VectorXd x = end_of(*written);
  const Eigen::VectorXd d = end_of(*errors);
  const Eigen::Index z = written->layout.slots[*written->system.slot("z")].offset;
  const Eigen::Index zh = written->layout.slots[*written->system.slot("observer.zh")].offset;
  ASSERT_FALSE(errors->system.slot("observer.zh"));
  EXPECT_EQ(*errors->system.slot("z - observer.zh"), *written->system.slot("observer.zh"));
  EXPECT_LE((x.segment(z, 2) - d.segment(z, 2)).norm(), 1e-12 * x.norm());
  EXPECT_LE((x.segment(z, 2) - x.segment(zh, 2) - d.segment(zh, 2)).norm(), 1e-13 * x.norm());
}

TEST(ErrorStates, AnErrorThatDoesNotMoveByItselfIsNone) {
  const std::string claims = "{small: {shrinks: norm(z - zh), to: 1e-12}}";
  const auto errors = [](const model::Instance& instance) {
    return make_setup(instance, {})->errors != nullptr;
  };
  EXPECT_FALSE(errors(two_sensors("[2*zh(1); 1.5*zh(2)]", kCorrection, claims)));
  EXPECT_FALSE(errors(two_sensors(kCopy, "[zh(1); sin(y2)]", claims)));
  EXPECT_FALSE(errors(two_sensors(kCopy, kCorrection, "{small: {below: norm(zh), bound: 1}}")));
}

TEST(ErrorStates, AnErrorOfNothingIsNoSignOfTwoRuns) {
  const model::Instance instance = bind::bind(io::read_problem(R"(problem: p
method:
  method: m
  events: {push: {at: [1]}}
  plant:
    state: {z: {shape: scalar, start: 3}}
    flow: {z: -sin(z)}
    at: {push: {z: z + 0.5}}
  observer:
    state: {zh: {shape: scalar, start: 3}}
    flow: {zh: -sin(zh)}
  claims: {pushed: {below: "z - zh", bound: 1.4}}
campaign: {runs: 1, horizon: 2}
)"));
  ASSERT_EQ(make_setup(instance, {})->errors, nullptr);
  CampaignOptions options;
  options.threads = 1;
  EXPECT_EQ(run_campaign(*make_setup(instance, {}), options).verdict, CampaignVerdict::held);
}

TEST(ErrorStates, AJumpOfThePlantAloneIsAJumpOfTheError) {
  const std::string plant = R"(problem: p
method:
  method: m
  events: {push: {at: [1]}}
  plant:
    state: {z: {shape: scalar, start: 3}}
    flow: {z: z}
    at: {push: {z: z + 0.5}}
  observer:
    state: {zh: {shape: scalar, start: 3}}
    flow: {zh: zh}
  claims: {pushed: {below: "z - zh", bound: )";
  const auto verdict = [&](const std::string& bound) {
    CampaignOptions options;
    options.threads = 1;
    const model::Instance instance =
        bind::bind(io::read_problem(plant + bound + "}}\ncampaign: {runs: 1, horizon: 2}\n"));
    return run_campaign(*make_setup(instance, {}), options).verdict;
  };
  // z - zh = 0.5 exp(t - 1) after t = 1.
  EXPECT_EQ(verdict("1.35915"), CampaignVerdict::held);
  EXPECT_EQ(verdict("1.35913"), CampaignVerdict::violated);
}

}  // namespace
}  // namespace gainsmith::verify
