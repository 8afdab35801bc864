#include "design/bisect.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "bind/instance.h"
#include "design/optimize.h"
#include "design/search_problems.h"
#include "support/input_error.h"
#include "support/yaml_problem.h"

namespace gainsmith::design {
namespace {

using testing::kCircle;
using testing::window;
using tests::YamlProblem;

/// Feasible for 0 < k < 1; k <= 0 makes no sense.
const std::string kAssumed = R"(problem: assumed
method:
  method: assumed
  data: {k: scalar}
  assume: {pos: k > 0}
  unknowns: {P: scalar}
  require: {pos: P > 1, win: "P*(1 - k) > 0"}
data: {k: 1.5}
)";

/// 1 > c (k - k^2) on [0, 1] holds for c < 4; the hull lets k^2 be less than that.
const std::string kHull = R"(problem: hull
method:
  method: hull
  data: {c: scalar}
  unknowns: {x: scalar}
  require: {pos: x > 1, win: {forall: "k in [0, 1]", that: "x*(1 - c*(k - k^2)) > 0"}}
data: {c: 3.9}
synthesis: {forall: hull}
)";

TEST(Bisect, FindsTheLimitOfQuadraticStabilityWithProofsOnBothSides) {
  const YamlProblem problem(kCircle);
  const BisectResult result =
      bisect(problem.instance, {}, {{"kmax", search::axis(1, 10)}, true, {1e-4}, {}}, {});
  ASSERT_EQ(result.gains.verdict, model::Verdict::yes);
  const double limit = 1 + 2 * std::sqrt(2.0);
  const model::SearchRecord& record = *result.gains.search;
  EXPECT_EQ(record.figure, "largest kmax");
  ASSERT_TRUE(record.value && record.beyond);
  EXPECT_LE(*record.value, limit);
  EXPECT_GE(*record.beyond, limit);
  EXPECT_LE(*record.beyond - *record.value, 1e-4);
  ASSERT_TRUE(record.certificate);
  EXPECT_TRUE(record.certificate->exact || record.certificate->backward_error <= 1e-30);
  EXPECT_TRUE(record.breaks.empty());
  for (const model::Margin& margin : result.gains.margins) EXPECT_TRUE(margin.holds);
  EXPECT_EQ(result.gains.searched, (model::Overrides{{"kmax", *record.value}}));
}

TEST(Bisect, WithoutAFeasibleValueNothingIsSaidOfThoseBetween) {
  const YamlProblem problem(kCircle);
  const BisectResult result =
      bisect(problem.instance, {}, {{"kmax", search::axis(4, 10)}, true, {0.1}, {}}, {});
  EXPECT_EQ(result.gains.verdict, model::Verdict::undecided);
  EXPECT_FALSE(result.gains.certificate);
  EXPECT_FALSE(result.gains.search->value);
  EXPECT_NE(result.gains.solver.message.find("among the 9 values tried in [4, 10]; each is "
                                             "infeasible by a certificate"),
            std::string::npos)
      << result.gains.solver.message;
}

TEST(Bisect, TheProblemsOwnValueIsTried) {
  const YamlProblem inside(window(0.3));
  const BisectResult found =
      bisect(inside.instance, {}, {{"k", search::axis(0, 1)}, true, {1e-4}, {}}, {});
  EXPECT_EQ(found.gains.verdict, model::Verdict::yes);
  EXPECT_NEAR(found.found.yes.value(), 0.31, 2e-4);
  const YamlProblem outside(window(0));
  EXPECT_EQ(synthesize_searched(outside.instance, request_of(outside.instance), 1, {}).verdict,
            model::Verdict::undecided);
}

/// The largest c is 4 - (a - 1)^2.
TEST(Bisect, WhatAnInstanceOverridesIsHeld) {
  const YamlProblem problem(testing::kRidge + "data: {a: 1, c: 0}\n");
  const BisectChoices choices{{"c", search::axis(-5, 9)}, true, {1e-3}, {}};
  const model::Instance moved = bind::evaluate(problem.instance.design, {{"a", 2}});
  EXPECT_NEAR(bisect(moved, {}, choices, {}).found.yes.value(), 3, 2e-3);
  EXPECT_NEAR(bisect(moved, {{"a", 3}}, choices, {}).found.yes.value(), 0, 2e-3);
}

TEST(Bisect, RefusedValuesAreNoErrorUnlessAllAre) {
  const YamlProblem problem(kAssumed);
  const auto over = [&](double low, double high) {
    return bisect(problem.instance, {}, {{"k", search::axis(low, high)}, true, {1e-4}, {}}, {});
  };
  const BisectResult found = over(-1, 5);
  EXPECT_NEAR(found.found.yes.value(), 1, 2e-4);
  EXPECT_EQ(found.found.samples.front().answer, search::Answer::refused);
  EXPECT_NE(over(-80, 80).gains.solver.message.find("are refused by the assumptions"),
            std::string::npos);
  EXPECT_NE(tests::input_error([&] { over(-3, -1); }).message().find("k > 0"), std::string::npos);
}

TEST(Bisect, AnEndThatOnlyTheHullProvesSaysSo) {
  const YamlProblem problem(kHull);
  const BisectResult found =
      bisect(problem.instance, {}, {{"c", search::axis(0, 9)}, true, {1e-3}, {}}, {});
  ASSERT_TRUE(found.found.no);
  EXPECT_LT(*found.found.no, 3.9);
  EXPECT_EQ(found.gains.search->certificate.value().about, "hull");
  const BisectResult none =
      bisect(problem.instance, {}, {{"c", search::axis(3.5, 9)}, true, {1e-3}, {}}, {});
  EXPECT_NE(none.gains.solver.message.find("infeasible by a certificate for the hull only"),
            std::string::npos)
      << none.gains.solver.message;
}

TEST(Bisect, TheDefaultToleranceIsRelativeOnALogarithmicScale) {
  EXPECT_TRUE(default_tolerance(search::axis(1e-6, 1)).relative);
  EXPECT_EQ(default_tolerance(search::axis(1e-6, 1)).at(0.5), 0.5e-4);
  EXPECT_EQ(default_tolerance(search::axis(0, 10)).at(0.5), 1e-3);
  EXPECT_EQ(tolerance_of(0.25, search::axis(1e-6, 1)).at(0.5), 0.25);
}

}  // namespace
}  // namespace gainsmith::design
