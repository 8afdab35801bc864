// Gains in single precision, and what makes a problem have gains that hold there.
#include "design/single_precision.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "design/fixed_gains.h"
#include "design/synthesize.h"
#include "support/input_error.h"
#include "support/yaml_problem.h"

namespace gainsmith::design {
namespace {

TEST(SinglePrecision, KeepsItsExactDecimals) {
  const tests::YamlProblem yaml(
      "problem: p\nmethod:\n  method: m\n  unknowns: {x: scalar}\n  require: {positive: x > 1}\n"
      "  gains: {L: \"[x; 1]\"}\n");
  model::Gains gains = synthesize(yaml.instance, {});
  gains.gains[0].second = numbers::Matrix{{0.1}, {-3}};
  const model::Gains rounded = rounded_to_single(yaml.instance, gains);
  EXPECT_EQ(rounded.gains[0].second(0), static_cast<double>(0.1F));
  EXPECT_EQ(rounded.decimals.at("gains.L"),
            (std::vector<std::string>{"0.100000001490116119384765625", "-3"}));
  gains.gains[0].second = numbers::Matrix{{1e39}, {0}};
  const InputError error = tests::input_error([&] { rounded_to_single(yaml.instance, gains); });
  EXPECT_NE(error.message().find("gains.L"), std::string::npos) << error.message();
}

/// The smallest x above 1/3, which single precision rounds to less or more than 1/3 by 1e-8 of it: a margin
/// is the distance to 1/3.
TEST(SinglePrecision, ALargerMarginIsFound) {
  const tests::YamlProblem yaml(
      "problem: p\nmethod:\n  method: m\n  unknowns: {x: scalar}\n"
      "  require: {above: \"[x, 1; 1, 3] > 0\"}\n  minimize: x\n  gains: {K: -x}\n");
  const model::Gains gains = synthesize(yaml.instance, {});
  const auto holds = [&](const model::Instance& instance, const model::Gains& found) {
    return check_gains(instance, rounded_to_single(instance, found), {}).verdict;
  };
  const auto remedy = remedy_at_single(yaml.instance, gains, {});
  ASSERT_TRUE(remedy);
  EXPECT_EQ(remedy->name, "margin");
  EXPECT_GT(remedy->objective.value(), 1.0 / 3);
  const model::Instance changed = model::with_design(
      yaml.instance, [&](model::Design& design) { design.synthesis.margin = remedy->value; });
  EXPECT_EQ(holds(changed, synthesize(changed, {})), model::Verdict::yes);
}

TEST(SinglePrecision, WhatNothingHelpsHasNoRemedy) {
  const tests::YamlProblem yaml(
      "problem: p\nmethod:\n  method: m\n  unknowns: {x: scalar}\n"
      "  require: {low: 3*x > 2 + 1e-10, high: 3*x < 2 + 2e-10}\n  gains: {K: x}\n");
  EXPECT_FALSE(remedy_at_single(yaml.instance, synthesize(yaml.instance, {}), {}));
}

}  // namespace
}  // namespace gainsmith::design
