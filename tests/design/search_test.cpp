#include "design/optimize.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "design/search_problems.h"
#include "support/input_error.h"
#include "support/stop.h"
#include "support/yaml_problem.h"

namespace gainsmith::design {
namespace {

using testing::kBowl;
using testing::kCircle;
using testing::kRidge;
using tests::YamlProblem;

/// The spectral radius as the smallest contraction: 0.8.
const std::string kContraction = R"(problem: contraction
method:
  method: contraction
  data: {A: n x n, rho: scalar}
  unknowns: {P: symmetric n}
  require: {positive: P > 0, contraction: "A'*P*A < rho^2*P"}
data: {A: [[0.5, 3], [0, -0.8]]}
search: {smallest: {rho: [0.05, 2]}, tolerance: 1e-5}
)";

/// A design by formula, whose figure is what somebody measures of its gains.
const std::string kMeasured = R"(problem: measured
method:
  method: measured
  parameters: {a: 1, b: 0.5}
  gains: {K: a*b}
  report: {sum: a + b}
search: {over: {a: [0, 4], b: [0, 1]}, evaluations: 300}
)";

TEST(Search, AMeasureIsMinimisedAcrossItsJumps) {
  const YamlProblem problem(kMeasured);
  SearchRequest request = request_of(problem.instance);
  request.measure_name = "staircase";
  // Lowest where a lies above the jump at 2.6; there is no value for b > 0.9.
  request.measure = [](const model::Instance& at, const model::Gains& gains) {
    const double a = at.values.at("a")(0, 0), b = at.values.at("b")(0, 0);
    EXPECT_EQ((*gains.find("K"))(0, 0), a * b);
    if (b > 0.9) return std::optional<double>();
    return std::optional((a > 2.6 ? 0.0 : 5.0) + (a - 2) * (a - 2) + std::floor(4 * b) + b * b);
  };
  const auto found = [&](unsigned threads) {
    return synthesize_searched(problem.instance, request, threads, {});
  };
  const model::Gains gains = found(1);
  ASSERT_EQ(gains.verdict, model::Verdict::yes);
  EXPECT_NEAR(gains.searched.at("a"), 2.6, 1e-3);
  EXPECT_GT(gains.searched.at("a"), 2.6);
  EXPECT_NEAR(gains.searched.at("b"), 0, 1e-3);
  EXPECT_EQ(gains.search->figure, "staircase");
  EXPECT_NEAR(gains.search->value.value(), 0.36, 2e-3);
  EXPECT_LE(gains.search->evaluations, 300);
  EXPECT_LT(gains.search->feasible, gains.search->evaluations);
  EXPECT_EQ(found(2).searched, gains.searched);
}

TEST(Search, AMeasureWithoutAnyValueDecidesNothing) {
  const YamlProblem problem(kMeasured);
  SearchRequest request = request_of(problem.instance);
  request.measure_name = "nothing";
  request.measure = [](const model::Instance&, const model::Gains&) {
    return std::optional<double>();
  };
  request.evaluations = 20;
  const model::Gains gains = synthesize_searched(problem.instance, request, 1, {});
  EXPECT_EQ(gains.verdict, model::Verdict::undecided);
  EXPECT_FALSE(gains.search->value);
}

TEST(Search, AnOptimumAtTheEndOfARangeIsNamed) {
  const YamlProblem problem(kBowl + "search: {over: {a: [2.5, 9], b: [1, 4]}, evaluations: 150}\n");
  const model::Gains gains =
      synthesize_searched(problem.instance, request_of(problem.instance), 1, {});
  ASSERT_EQ(gains.verdict, model::Verdict::yes);
  EXPECT_NEAR(gains.searched.at("b"), 3, 0.03);
  EXPECT_EQ(gains.search->at_end, std::vector<std::string>{"a"});
}

/// A generalised eigenvalue problem is a bisection.
TEST(Search, TheSmallestContractionIsTheSpectralRadius) {
  const YamlProblem problem(kContraction);
  const SearchRequest request = request_of(problem.instance);
  ASSERT_TRUE(request.extreme && request.over.empty());
  const model::Gains gains = synthesize_searched(problem.instance, request, 1, {});
  ASSERT_EQ(gains.verdict, model::Verdict::yes);
  EXPECT_NEAR(gains.searched.at("rho"), 0.8, 2e-5);
  EXPECT_GE(gains.searched.at("rho"), 0.8);
  EXPECT_LE(*gains.search->beyond, 0.8 + 1e-5);
}

TEST(Search, ParametersWithoutAValueAreFound) {
  const YamlProblem problem(kBowl);
  const SearchRequest request = request_of(problem.instance);
  ASSERT_EQ(request.over.size(), 2U);
  EXPECT_EQ(figure_name(request, *problem.instance.design), "objective");
  const model::Gains gains = synthesize_searched(problem.instance, request, 1, {});
  ASSERT_EQ(gains.verdict, model::Verdict::yes);
  EXPECT_NEAR(*gains.objective, 1, 1e-3);
  EXPECT_NEAR(gains.searched.at("a"), 2, 0.03);
  EXPECT_NEAR(gains.searched.at("b"), 3, 0.03);
  EXPECT_LT(gains.search->feasible, gains.search->evaluations);
  EXPECT_EQ(gains.search->over, (std::vector<std::string>{"a", "b"}));
}

/// No b moves what y does not show: the own values and the ends of the range are tried, no more.
TEST(Search, AHiddenModeEndsItWithItsName) {
  const YamlProblem problem(
      "problem: p\nmethod: static-output-feedback\n"
      "data: {A: [[1, 0, 0], [0, 1.5, 0], [0, 0, 2]], B: [[1, 0, 0], [0, 1, 0], [1, 1, 1]], "
      "C: [[1, 0, 0], [0, 1, 0]]}\nno campaign: static\n");
  const model::Gains gains =
      synthesize_searched(problem.instance, request_of(problem.instance), 1, {});
  EXPECT_EQ(gains.verdict, model::Verdict::undecided);
  EXPECT_EQ(gains.search->evaluations, 3);
  EXPECT_NE(gains.solver.message.find("eigenvalue 2 in the direction [0; 0; 1]"), std::string::npos)
      << gains.solver.message;
}

/// Position feedback adds no damping; s^2 - (6 + F) s + 9 + 2 F has no F with a decay rate of 3.
TEST(Search, InequalitiesWithoutTheSearchedScalarExcludeAllItsValues) {
  for (const char* data :
       {"{A: [[0, 1], [-1, 0]], B: [[0], [1]], C: [1, 0]}\n",
        "{A: [[0, 1], [0, 0]], B: [[0], [1]], C: [1, 1]}\nparameters: {alpha: 3}\n",
        "{A: [[0, 0, 1, 0], [0, 0, 0, 1], [-2, 1, 0, 0], [1, -1, 0, 0]], "
        "B: [[0, 0], [0, 0], [1, 0], [0, 1]], C: [[1, 0, 0, 0], [0, 1, 0, 0]]}\n"}) {
    const YamlProblem problem("problem: p\nmethod: static-output-feedback\ndata: " +
                              std::string(data) + "no campaign: static\n");
    const model::Gains gains =
        synthesize_searched(problem.instance, request_of(problem.instance), 1, {});
    EXPECT_EQ(gains.verdict, model::Verdict::no) << data;
    EXPECT_TRUE(gains.certificate && gains.certificate->exact);
    EXPECT_NE(gains.solver.message.find("no b has gains"), std::string::npos);
  }
}

/// At h = 1 there is none; larger h, through a parameter, the size of a range or a rank, have one.
TEST(Search, WhatASearchedScalarChangesIndirectlyExcludesNothing) {
  for (const char* method :
       {"  data: {h: {shape: scalar, default: 1}}\n  parameters: {c: {default: 1/h}}\n"
        "  require: {low: x > c, high: x < 0.4}\n",
        "  data: {h: {shape: scalar, default: 1}, v: {shape: 2, default: \"[9; 1]\"}}\n"
        "  require: {high: x < 3, low: \"x > v(rank([1, 0; 0, where(h > 5, 1, 0)]))\"}\n"}) {
    const YamlProblem problem("problem: p\nmethod:\n  method: m\n  unknowns: {x: scalar}\n" +
                              std::string(method) +
                              "  no campaign: static\nsearch: {over: {h: [1, 10]}}\n");
    const model::Gains gains =
        synthesize_searched(problem.instance, request_of(problem.instance), 1, {});
    EXPECT_EQ(gains.verdict, model::Verdict::yes) << method << gains.solver.message;
  }
}

TEST(Search, WhatIsNecessaryExcludesAndRestrictsNothing) {
  for (const bool fails : {true, false}) {
    const YamlProblem problem(
        "problem: p\nmethod:\n  method: m\n  data: {h: {shape: scalar, default: 2}}\n"
        "  unknowns: {x: scalar, y: scalar}\n  require: {low: x > h}\n"
        "  necessary: {test: \"1 < y and y < " +
        std::string(fails ? "0.5" : "3") +
        "\"}\n  no campaign: static\nsearch: {over: {h: [1, 10]}}\n");
    const model::Gains gains =
        synthesize_searched(problem.instance, request_of(problem.instance), 1, {});
    EXPECT_EQ(gains.verdict, fails ? model::Verdict::no : model::Verdict::yes);
    EXPECT_EQ(gains.margins.size(), fails ? 0U : 1U);
    EXPECT_EQ(gains.unknowns.size(), fails ? 0U : 1U);
  }
}

TEST(Search, ThreadsDoNotChangeTheResult) {
  const YamlProblem problem(kBowl);
  const SearchRequest request = request_of(problem.instance);
  const auto run = [&](unsigned threads) {
    return synthesize_searched(problem.instance, request, threads, {});
  };
  EXPECT_EQ(run(1).searched, run(4).searched);
}

TEST(Search, OnlyWhatIsOpenIsSearched) {
  const YamlProblem problem(kBowl + "parameters: {a: 2.5}\n");
  const SearchRequest request = request_of(problem.instance);
  ASSERT_EQ(request.over.size(), 1U);
  EXPECT_EQ(request.over[0].name, "b");
  EXPECT_TRUE(request.over[0].axis.logarithmic);
  EXPECT_TRUE(request_of(YamlProblem(kCircle).instance).empty());
}

TEST(Search, AFigureOfItsOwnIsMinimised) {
  const YamlProblem problem(kBowl + "search: {over: {a: [0, 9]}, minimize: K + 10*a}\n" +
                            "parameters: {b: 3}\n");
  const SearchRequest request = request_of(problem.instance);
  const model::Gains gains = synthesize_searched(problem.instance, request, 1, {});
  // 2((a - 2)^2 + 1) + 10 a is least at a = -0.5; feasible a is at least 0.
  ASSERT_EQ(gains.verdict, model::Verdict::yes);
  EXPECT_EQ(gains.search->figure, "K + 10*a");
  EXPECT_NEAR(gains.searched.at("a"), 0, 1e-3);
  EXPECT_NEAR(*gains.search->value, 10, 0.02);
}

TEST(Search, TheLargestScalarOverAnother) {
  const YamlProblem problem(kRidge);
  const SearchRequest request = request_of(problem.instance);
  const model::Gains gains = synthesize_searched(problem.instance, request, 2, {});
  ASSERT_EQ(gains.verdict, model::Verdict::yes);
  EXPECT_NEAR(gains.searched.at("c"), 4, 2e-3);
  EXPECT_NEAR(gains.searched.at("a"), 1, 0.05);
  EXPECT_TRUE(gains.search->certificate);
  EXPECT_GE(*gains.search->beyond, gains.searched.at("c"));
}

/// What was found before a stop is there with all its margins.
TEST(Search, AnInterruptLeavesTheBestSoFar) {
  const YamlProblem problem(kBowl);
  const SearchRequest request = request_of(problem.instance);
  const tests::StopInTest stop;
  int asked = 0;
  sdp::Options solver;
  solver.progress = [&](const sdp::Progress&) {
    if (++asked > 90) request_stop();
  };
  const model::Gains gains = synthesize_searched(problem.instance, request, 1, solver);
  ASSERT_EQ(gains.verdict, model::Verdict::yes);
  EXPECT_FALSE(gains.margins.empty());
  for (const model::Margin& margin : gains.margins) EXPECT_TRUE(margin.holds);
  EXPECT_EQ(*gains.search->value, *gains.objective);
  EXPECT_FALSE(gains.search->finished);
  EXPECT_GT(gains.search->feasible, 0);
  EXPECT_LT(gains.search->evaluations, request.evaluations);
  EXPECT_TRUE(gains.search->value);
}

/// Feasible for |a - 700| < 1 only, which no cell of the grid meets: the slacks lead there.
TEST(Search, ANarrowFeasibleRangeIsFound) {
  const YamlProblem problem(
      "problem: narrow\nmethod:\n  method: m\n  parameters: {a: {default: 100, search: [0, "
      "1000]}}\n"
      "  unknowns: {x: scalar}\n  require: {floor: \"x > (a - 700)^2\", ceiling: x < 1}\n"
      "  minimize: x\nsearch: {over: {a: [0, 1000]}, evaluations: 100}\n");
  const model::Gains gains =
      synthesize_searched(problem.instance, request_of(problem.instance), 2, {});
  ASSERT_EQ(gains.verdict, model::Verdict::yes);
  EXPECT_NEAR(gains.searched.at("a"), 700, 0.1);
  EXPECT_LT(*gains.objective, 0.01);
}

TEST(Search, NothingFeasibleIsUndecided) {
  const YamlProblem problem(kBowl +
                            "search: {over: {a: [6, 9]}, evaluations: 20}\nparameters: {b: 3}\n");
  const model::Gains gains =
      synthesize_searched(problem.instance, request_of(problem.instance), 1, {});
  EXPECT_EQ(gains.verdict, model::Verdict::undecided);
  EXPECT_NE(gains.solver.message.find("a in [6, 9]"), std::string::npos);
  EXPECT_FALSE(gains.search->value);
  EXPECT_TRUE(gains.gains.empty());
}

}  // namespace
}  // namespace gainsmith::design
