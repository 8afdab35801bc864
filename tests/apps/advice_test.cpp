#include "gainsmith/advice.h"

#include <gtest/gtest.h>

#include "support/yaml_problem.h"

namespace gainsmith::app {
namespace {

using model::Verdict;

std::vector<std::string> commands(const std::string& text, Verdict verdict,
                                  const std::string& file = "plant.yaml") {
  const tests::YamlProblem yaml(text);
  model::Gains gains;
  gains.verdict = verdict;
  return next_commands(yaml.instance, gains, file);
}

const std::string kSampled =
    "problem: p\nmethod:\n  method: m\n  data: {low: scalar, T2: scalar}\n  unknowns: {x: scalar}\n"
    "  require:\n    a: {forall: \"tau in [low, T2]\", that: x > tau}\n"
    "    b: {forall: \"tau in [0, T2]\", that: x < 2 - tau}\n"
    "    c: {forall: \"tau in [0, 3]\", that: x < 5}\ndata: {low: 0.25, T2: 1.5}\n";

TEST(AdviceTest, TheEndOfAnIntervalIsAskedForOnce) {
  const std::string bisect = "gainsmith bisect plant.yaml --largest T2 --in 0.25 1.5";
  EXPECT_EQ(commands(kSampled, Verdict::no),
            (std::vector<std::string>{"gainsmith explain plant.yaml", bisect}));
  EXPECT_EQ(commands(kSampled, Verdict::undecided),
            (std::vector<std::string>{"gainsmith explain plant.yaml --time 60", bisect}));
  EXPECT_TRUE(commands(kSampled, Verdict::yes).empty());
}

/// A bisection would keep the defaults of the scalars that were searched.
TEST(AdviceTest, WhatWasSearchedIsSearchedAgain) {
  const tests::YamlProblem yaml(kSampled);
  model::Gains gains;
  gains.verdict = Verdict::undecided;
  gains.search.emplace();
  EXPECT_EQ(next_commands(yaml.instance, gains, "plant.yaml")[1],
            "gainsmith optimize plant.yaml --largest T2=0.25:1.5");
}

TEST(AdviceTest, ScalarsThatOnlySynthSearchesAreSaid) {
  const tests::YamlProblem yaml(
      "problem: p\nmethod:\n  method: m\n  data: {k: scalar}\n  parameters:\n"
      "    delta: {default: 0.5, search: [0.1, 1]}\n    eta: {default: 2, search: [1, 3]}\n"
      "  unknowns: {x: scalar}\n  require: {a: x > delta*k, b: x < eta}\ndata: {k: 1}\n"
      "parameters: {eta: 2}\n");
  EXPECT_EQ(held_line(yaml.instance),
            "held        delta = 0.5; synth and optimize search what this keeps\n");
  EXPECT_EQ(held_line(yaml.instance, {"delta"}), "");
}

TEST(AdviceTest, NamesThatAShellWouldSplitAreQuoted) {
  EXPECT_EQ(commands(kSampled, Verdict::undecided, "my plant's.yaml")[0],
            "gainsmith explain 'my plant'\\''s.yaml' --time 60");
}

TEST(AdviceTest, WhatWasSetIsSetAgain) {
  tests::YamlProblem yaml(kSampled);
  yaml.instance = model::with_design(yaml.instance, [](model::Design& design) {
    design.statement.settings = {{"T2", "1.5"}, {"low", "1 / 4"}};
  });
  model::Gains gains;
  gains.verdict = Verdict::undecided;
  EXPECT_EQ(next_commands(yaml.instance, gains, "plant.yaml"),
            (std::vector<std::string>{
                "gainsmith explain plant.yaml --set T2=1.5 --set 'low=1 / 4' --time 60",
                "gainsmith bisect plant.yaml --set T2=1.5 --set 'low=1 / 4' --largest T2 --in 0.25 "
                "1.5"}));
}

TEST(AdviceTest, TheLimitOfAnInputIsNotAskedForWhereItAlsoHelps) {
  const auto with = [](const std::string& bound) {
    return "problem: p\nmethod:\n  method: m\n  data: {limit: scalar}\n  unknowns: {x: scalar}\n"
           "  require: {a: {forall: \"u in [-limit, limit]\", that: x > u}, c: \"x < " +
           bound + "\"}\ndata: {limit: 2}\n";
  };
  EXPECT_EQ(commands(with("limit"), Verdict::no).size(), 1U);
  EXPECT_EQ(commands(with("1"), Verdict::no).size(), 2U);
}

TEST(AdviceTest, WithoutIntervalsANoIsExplained) {
  const std::string fixed =
      "problem: p\nmethod:\n  method: m\n  data: {b: scalar}\n  unknowns: {x: scalar}\n"
      "  require: {a: x > b, c: x < 1}\ndata: {b: 2}\n";
  EXPECT_EQ(commands(fixed, Verdict::no), std::vector<std::string>{"gainsmith explain plant.yaml"});
}

}  // namespace
}  // namespace gainsmith::app
