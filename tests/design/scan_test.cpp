#include "design/scan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "design/search_problems.h"
#include "design/synthesize.h"
#include "expr/text/parser.h"
#include "search/axis.h"
#include "support/input_error.h"
#include "support/stop.h"
#include "support/yaml_problem.h"

namespace gainsmith::design {
namespace {

using testing::kBowl;
using testing::window;
using tests::YamlProblem;

TEST(Scan, GivesEveryPointInOrderForAnyThreads) {
  model::Problem problem = *YamlProblem(kBowl).problem;
  problem.questions.figures = {expr::parse(expr::Text("2*K", "--show"))};
  const auto points = search::grid({{1, 2, 9}, {3, 4}});
  const auto rows = scan(bind::bind(problem).design, {"a", "b"}, points, 4, {});
  ASSERT_EQ(rows.size(), 6U);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].at, points[i]);
    const double value = std::pow(points[i][0] - 2, 2) + std::pow(points[i][1] - 3, 2) + 1;
    if (value < 6) {
      EXPECT_NEAR(*rows[i].objective, value, 1e-5);
      EXPECT_NEAR(rows[i].figures[0].value(), 4 * value, 1e-4);
    } else {
      EXPECT_EQ(rows[i].verdict, model::Verdict::no);
      EXPECT_FALSE(rows[i].figures[0]);
    }
  }
}

TEST(Scan, AnInterruptMarksWhatHasNoAnswer) {
  const YamlProblem problem(window(0.3));
  const tests::StopInTest stop;
  sdp::Options solver;
  solver.progress = [](const sdp::Progress&) { request_stop(); };
  const auto rows = scan(problem.instance.design, {"k"}, {{0.3}, {0.3}, {0.3}}, 1, solver);
  ASSERT_EQ(rows.size(), 3U);
  for (const ScanRow& row : rows) EXPECT_TRUE(row.interrupted);
  stop_requested = false;
  const auto whole = scan(problem.instance.design, {"k"}, {{0.3}}, 1, {});
  EXPECT_FALSE(whole[0].interrupted);
}

/// A row says less than synthesize does, and nothing else.
TEST(Scan, ARowIsWhatSynthesizeSays) {
  const YamlProblem problem(
      "problem: p\nmethod:\n  method: m\n  data: {A: n x n, T: scalar}\n"
      "  unknowns: {P: symmetric n, Y: n x n}\n  require:\n    positive: P > I\n"
      "    cap: P < 40*I\n    bounded: \"[P, Y; Y', P] > 0\"\n"
      "    shrinks: {forall: \"t in [0.1, T]\", that: "
      "\"[P, (1.1*P*expm(A*t) - t*Y)'; 1.1*P*expm(A*t) - t*Y, P] > 0\"}\n"
      "  minimize: trace(P)\n  gains: {K: inv(P)*Y}\n"
      "data: {A: [[0.1, 1], [-1, -0.2]], T: 1}\n");
  std::vector<std::vector<double>> points;
  for (int k = 1; k <= 16; ++k) points.push_back({0.25 * k});
  const auto rows = scan(problem.instance.design, {"T"}, points, 2, {});
  int yes = 0;
  for (const ScanRow& row : rows) {
    const model::Gains gains = synthesize_at(problem.instance.design, {{"T", row.at[0]}}, {});
    EXPECT_EQ(row.verdict, gains.verdict) << row.at[0];
    if (gains.verdict != model::Verdict::yes) continue;
    ++yes;
    EXPECT_EQ(*row.objective, *gains.objective) << row.at[0];
  }
  EXPECT_GT(yes, 0);
  EXPECT_LT(yes, 16);
}

TEST(Scan, RefusesUnknownNamesAndKeepsRefusedPoints) {
  const YamlProblem problem(
      "problem: p\nmethod:\n  method: m\n  data: {a: scalar}\n  assume: {low: a < 2}\n"
      "  unknowns: {x: scalar}\n  require: {r: x > a}\n  minimize: x\ndata: {a: 1}\n");
  EXPECT_THROW(scan(problem.instance.design, {"b"}, {{1}}, 1, {}), InputError);
  const auto rows = scan(problem.instance.design, {"a"}, {{1}, {3}}, 1, {});
  EXPECT_EQ(rows[0].refused, "");
  EXPECT_NE(rows[1].refused.find("expected a < 2"), std::string::npos);
  const InputError error = tests::input_error([&] {
    scan(problem.instance.design, {"a"}, {{3}, {4}}, 1, {});
  });
  EXPECT_NE(error.message().find("expected a < 2"), std::string::npos);
}

}  // namespace
}  // namespace gainsmith::design
