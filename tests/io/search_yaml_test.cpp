#include <gtest/gtest.h>

#include "bind/bind.h"
#include "io/problem_text.h"

namespace gainsmith::io {
namespace {

using tests::input_error;

/// The small problem with a block more.
std::string with(const std::string& block) {
  return replaced(kProblem, "campaign:", block + "\ncampaign:");
}

TEST(Search, IsReadWithItsRanges) {
  const model::Problem problem =
      read_problem(with("search: {smallest: {T2: [T1, 2*T1]}, tolerance: 1e-3,\n"
                        "         over: {delta: [1e-3, 10], eta: [1e-6, 1]}, evaluations: 50}\n"
                        "negotiable: {T2: [T1, 1.1]}"));
  ASSERT_TRUE(problem.search && problem.search->extreme);
  EXPECT_FALSE(problem.search->largest);
  EXPECT_EQ(problem.search->extreme->name, "T2");
  EXPECT_EQ(problem.search->tolerance, 1e-3);
  ASSERT_EQ(problem.search->over.size(), 2U);
  EXPECT_EQ(problem.search->over[1].name, "eta");
  EXPECT_EQ(problem.search->evaluations, 50);
  ASSERT_EQ(problem.negotiable.size(), 1U);
  const model::Instance instance = bind::bind(problem);
  EXPECT_EQ(ends_of(*instance.design->search->extreme, instance.values), (std::pair(0.5, 1.0)));
}

TEST(Search, AFigureMayBeStatedForOver) {
  const model::Problem problem =
      read_problem(with("search: {over: {delta: [1e-3, 10]}, minimize: trace(P1)}"));
  EXPECT_FALSE(problem.search->extreme);
  EXPECT_TRUE(problem.search->minimize);
  EXPECT_EQ(problem.search->evaluations, 200);
  EXPECT_NO_THROW(bind::bind(problem));
}

TEST(Search, AFigureMayBeOneOfRuns) {
  const model::Problem problem =
      read_problem(with("search: {over: {delta: [1e-3, 10]}, runs: 7,\n"
                        "         minimize: {observer: ekf, rms: norm(e), over: [0, 20]}}"));
  ASSERT_TRUE(problem.search && problem.search->run_figure);
  EXPECT_FALSE(problem.search->minimize);
  EXPECT_EQ(problem.search->runs, 7U);
  EXPECT_EQ(problem.search->run_figure->kind, model::FigureKind::rms);
  EXPECT_EQ(problem.search->run_figure->observer, "ekf");
  const InputError error = input_error([&] { bind::bind(problem); });
  EXPECT_NE(error.message().find("there is no observer 'ekf'"), std::string::npos) << error.what();
}

TEST(Search, MistakesAreShownAtTheirPlace) {
  const std::vector<std::pair<std::string, std::string>> mistakes = {
      {"search: {}", "expected 'largest', 'smallest' or 'over'"},
      {"search: {largst: {T2: [1, 2]}}", "did you mean 'largest'?"},
      {"search: {largest: {T2: [1, 2]}, smallest: {T1: [0, 1]}}", "not both"},
      {"search: {largest: {T22: [1, 2]}}", "did you mean 'T2'?"},
      {"search: {largest: {A: [1, 2]}}", "'A' is a matrix"},
      {"search: {largest: {T1: [0, 1], T2: [1, 2]}}", "expected one scalar"},
      {"search: {largest: {T2: 3}}", "expected a range [low, high]"},
      {"search: {largest: {T2: [1, 2, 3]}}", "expected a range [low, high]"},
      {"search: {largest: {T2: [1, 2]}, tolerance: 0}", "positive"},
      {"search: {over: {delta: [1, 2]}, tolerance: 1}", "'tolerance' belongs to"},
      {"search: {largest: {T2: [1, 2]}, evaluations: 9}", "'evaluations' belongs to 'over'"},
      {"search: {over: {delta: [1, 2]}, evaluations: 0.5}", "whole number"},
      {"search: {over: {delta: [1, 2]}, evaluations: 1e9}", "whole number"},
      {"search: {largest: {T2: [1, 2]}, minimize: g1}", "leave out 'minimize'"},
      {"search: {over: {delta: [1, 2]}, runs: 3}", "'runs' belongs to a figure of runs"},
      {"search: {over: {delta: [1, 2]}, minimize: {rms: e, over: [0, 1]}, runs: 0}",
       "whole number"},
      {"search: {over: {delta: [1, 2]}, minimize: {rms: e}}", "a figure is one of"},
      {"search: {over: {delta: [1, 2]}, minimize: {ended: zeno}}", "ended"},
      {"search: {largest: {T2: [1, 2]}, minimize: {peak: e}}", "leave out 'minimize'"},
      {"negotiable: {T22: [0, 1]}", "did you mean 'T2'?"}};
  for (const auto& [block, message] : mistakes) {
    const InputError error = input_error([&] { read_problem(with(block)); });
    EXPECT_NE(error.message().find(message), std::string::npos) << block << ": " << error.what();
    EXPECT_EQ(error.place().line, 11) << block;
    EXPECT_GT(error.place().column, 0) << block;
  }
}

TEST(Search, RangesAreCheckedWithTheProblem) {
  for (const char* block : {"search: {largest: {T2: [2, 1]}}", "search: {over: {delta: [1, 1]}}",
                            "negotiable: {T2: [1, T1]}"}) {
    const model::Problem problem = read_problem(with(block));
    const InputError error = input_error([&] { bind::bind(problem); });
    EXPECT_NE(error.message().find("low < high"), std::string::npos) << error.what();
  }
}

TEST(Search, FiguresAndRepetitionsAreCheckedWithTheProblem) {
  const std::vector<std::pair<std::string, std::string>> mistakes = {
      {"search: {over: {delta: [1, 2]}, minimize: trace(P3)}", "P3"},
      {"search: {over: {delta: [1, 2]}, minimize: P1}", "1 x 1"},
      {"search: {largest: {T2: [1, 2]}, over: {T2: [1, 2]}}", "'T2' is searched already"}};
  for (const auto& [block, message] : mistakes) {
    const model::Problem problem = read_problem(with(block));
    const InputError error = input_error([&] { bind::bind(problem); });
    EXPECT_NE(error.message().find(message), std::string::npos) << error.what();
    EXPECT_EQ(error.place().line, 11) << block;
  }
}

/// What is searched need not be given: it stands at the end from which the search goes.
TEST(Search, ASearchedScalarNeedsNoValue) {
  const auto started = [](const std::string& block) {
    const model::Problem problem = read_problem(
        replaced(replaced(kProblem, "  T2: 0.7\n", ""), "campaign:", block + "\ncampaign:"));
    return bind::bind(problem).values.at("T2")(0, 0);
  };
  EXPECT_EQ(started("search: {largest: {T2: [0.6, 1.1]}}"), 0.6);
  EXPECT_EQ(started("search: {smallest: {T2: [T1, 1.1]}}"), 1.1);
  EXPECT_EQ(started("search: {over: {T2: [T1, 1.1]}}"), 0.5);
}

TEST(Search, ParametersThatTheProblemLeavesOpen) {
  const model::Problem problem = read_problem(
      "problem: open\nmethod:\n  method: m\n  parameters: {a: {default: 1, search: [0, 2]}, "
      "b: {search: [3, 4]}, c: 5}\n  unknowns: {x: scalar}\n  require: {r: x > a + b + c}\n");
  const model::Instance instance = bind::bind(problem);
  const auto& open = instance.design->open;
  ASSERT_EQ(open.size(), 2U);
  EXPECT_EQ(open[0].name, "a");
  EXPECT_EQ(open[1].name, "b");
  EXPECT_EQ(instance.values.at("a")(0, 0), 1);
  EXPECT_EQ(instance.values.at("b")(0, 0), 3);
}

}  // namespace
}  // namespace gainsmith::io
