// Bisection, scans and outer optimisation of designs with known answers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "design/bisect.h"
#include "design/optimize.h"
#include "design/scan.h"
#include "search/ipopt.h"
#include "search/nlopt.h"
#include "support/input_error.h"
#include "support/yaml_problem.h"

namespace gainsmith::design {
namespace {

using tests::YamlProblem;

/// x'' + x' + (2 + k(t)) x = 0, k in [0, kmax]: one P exactly for kmax < 1 + 2 sqrt(2), by the
/// circle criterion.
const std::string kCircle = R"(problem: circle
method:
  method: quadratic-stability
  data: {kmax: scalar}
  unknowns: {P: symmetric 2}
  let: {A(k): "[0, 1; -2 - k, -1]"}
  require:
    positive: P > 0
    decrease: {forall: "k in [0, kmax]", that: "He(P*A(k)) < 0"}
data: {kmax: 1}
)";

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

/// The smallest x is (a - 2)^2 + (b - 3)^2 + 1, feasible up to 6.
const std::string kBowl = R"(problem: bowl
method:
  method: bowl
  parameters: {a: {default: 1, search: [0, 9]}, b: {default: 2, search: [0.01, 90]}}
  unknowns: {x: scalar}
  require: {floor: "x > (a - 2)^2 + (b - 3)^2 + 1", ceiling: x < 6}
  minimize: x
  gains: {K: 2*x}
)";

/// Feasible for c <= 4 - (a - 1)^2.
const std::string kRidge = R"(problem: ridge
method:
  method: ridge
  data: {a: scalar, c: scalar}
  unknowns: {x: scalar}
  require: {floor: x > 1, ceiling: "x < 5 - (a - 1)^2 - c"}
  minimize: x
search: {largest: {c: [-5, 9]}, tolerance: 1e-3, over: {a: [-2, 3]}, evaluations: 60}
)";

const search::Optimizers kOptimizers{search::nlopt_search(), search::ipopt_solver()};

TEST(Bisect, FindsTheLimitOfQuadraticStabilityWithProofsOnBothSides) {
  const YamlProblem problem(kCircle);
  const BisectResult result =
      bisect(*problem.problem, {}, {{"kmax", search::axis(1, 10)}, true, {1e-4}, {}}, {});
  ASSERT_EQ(result.gains.verdict, model::Verdict::yes);
  const double limit = 1 + 2 * std::sqrt(2.0);
  const model::SearchRecord& record = *result.gains.search;
  EXPECT_EQ(record.figure, "largest kmax");
  ASSERT_TRUE(record.value && record.beyond);
  EXPECT_LE(*record.value, limit);
  EXPECT_GE(*record.beyond, limit);
  EXPECT_LE(*record.beyond - *record.value, 1e-4);
  ASSERT_TRUE(record.certificate);
  EXPECT_TRUE(record.certificate->checked);
  EXPECT_TRUE(record.breaks.empty());
  for (const model::Margin& margin : result.gains.margins) EXPECT_TRUE(margin.holds);
  EXPECT_EQ(result.gains.searched, (model::Overrides{{"kmax", *record.value}}));
}

TEST(Bisect, WithoutAFeasibleValueNothingIsSaidOfThoseBetween) {
  const YamlProblem problem(kCircle);
  const BisectResult result =
      bisect(*problem.problem, {}, {{"kmax", search::axis(4, 10)}, true, {0.1}, {}}, {});
  EXPECT_EQ(result.gains.verdict, model::Verdict::undecided);
  EXPECT_FALSE(result.gains.certificate);
  EXPECT_FALSE(result.gains.search->value);
  EXPECT_NE(result.gains.solver.message.find("among the 9 values tried in [4, 10]; each is proved "
                                             "infeasible"),
            std::string::npos)
      << result.gains.solver.message;
}

/// Feasible exactly for 0.29 < k < 0.31, between two values of the spread.
std::string window(double k) {
  return R"(problem: window
method:
  method: window
  data: {k: scalar}
  unknowns: {P: scalar}
  require: {pos: P > 1, win: "P*(1e-4 - (k - 0.3)^2) > 0"}
search: {largest: {k: [0, 1]}}
data: {k: )" +
         std::to_string(k) + "}\n";
}

TEST(Bisect, TheProblemsOwnValueIsTried) {
  const YamlProblem inside(window(0.3));
  const BisectResult found =
      bisect(*inside.problem, {}, {{"k", search::axis(0, 1)}, true, {1e-4}, {}}, {});
  EXPECT_EQ(found.gains.verdict, model::Verdict::yes);
  EXPECT_NEAR(found.found.yes.value(), 0.31, 2e-4);
  const YamlProblem outside(window(0));
  EXPECT_EQ(
      synthesize_searched(*outside.problem, request_of(*outside.problem), nullptr, 1, {}).verdict,
      model::Verdict::undecided);
}

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

TEST(Bisect, RefusedValuesAreNoErrorUnlessAllAre) {
  const YamlProblem problem(kAssumed);
  const auto over = [&](double low, double high) {
    return bisect(*problem.problem, {}, {{"k", search::axis(low, high)}, true, {1e-4}, {}}, {});
  };
  const BisectResult found = over(-1, 5);
  EXPECT_NEAR(found.found.yes.value(), 1, 2e-4);
  EXPECT_EQ(found.found.samples.front().answer, search::Answer::refused);
  EXPECT_NE(over(-80, 80).gains.solver.message.find("are refused by the assumptions"),
            std::string::npos);
  EXPECT_NE(tests::input_error([&] { over(-3, -1); }).message().find("k > 0"), std::string::npos);
}

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

TEST(Bisect, AnEndThatOnlyTheHullProvesSaysSo) {
  const YamlProblem problem(kHull);
  const BisectResult found =
      bisect(*problem.problem, {}, {{"c", search::axis(0, 9)}, true, {1e-3}, {}}, {});
  ASSERT_TRUE(found.found.no);
  EXPECT_LT(*found.found.no, 3.9);
  EXPECT_EQ(found.gains.search->certificate.value().about, "hull");
  const BisectResult none =
      bisect(*problem.problem, {}, {{"c", search::axis(3.5, 9)}, true, {1e-3}, {}}, {});
  EXPECT_NE(none.gains.solver.message.find("proved infeasible for the hull only"),
            std::string::npos)
      << none.gains.solver.message;
}

TEST(Search, AnOptimumAtTheEndOfARangeIsNamed) {
  const YamlProblem problem(kBowl + "search: {over: {a: [2.5, 9], b: [1, 4]}, evaluations: 150}\n");
  const model::Gains gains =
      synthesize_searched(*problem.problem, request_of(*problem.problem), &kOptimizers, 1, {});
  ASSERT_EQ(gains.verdict, model::Verdict::yes);
  EXPECT_NEAR(gains.searched.at("b"), 3, 0.03);
  EXPECT_EQ(gains.search->at_end, std::vector<std::string>{"a"});
}

TEST(Bisect, TheDefaultToleranceIsRelativeOnALogarithmicScale) {
  EXPECT_TRUE(default_tolerance(search::axis(1e-6, 1)).relative);
  EXPECT_EQ(default_tolerance(search::axis(1e-6, 1)).at(0.5), 0.5e-4);
  EXPECT_EQ(default_tolerance(search::axis(0, 10)).at(0.5), 1e-3);
  EXPECT_EQ(tolerance_of(0.25, search::axis(1e-6, 1)).at(0.5), 0.25);
}

/// A generalised eigenvalue problem is a bisection.
TEST(Search, TheSmallestContractionIsTheSpectralRadius) {
  const YamlProblem problem(kContraction);
  const SearchRequest request = request_of(*problem.problem);
  ASSERT_TRUE(request.extreme && request.over.empty());
  const model::Gains gains = synthesize_searched(*problem.problem, request, nullptr, 1, {});
  ASSERT_EQ(gains.verdict, model::Verdict::yes);
  EXPECT_NEAR(gains.searched.at("rho"), 0.8, 2e-5);
  EXPECT_GE(gains.searched.at("rho"), 0.8);
  EXPECT_LE(*gains.search->beyond, 0.8 + 1e-5);
}

TEST(Search, ParametersWithoutAValueAreFound) {
  const YamlProblem problem(kBowl);
  const SearchRequest request = request_of(*problem.problem);
  ASSERT_EQ(request.over.size(), 2U);
  EXPECT_EQ(figure_name(request, *problem.instance.method), "objective");
  const model::Gains gains = synthesize_searched(*problem.problem, request, &kOptimizers, 1, {});
  ASSERT_EQ(gains.verdict, model::Verdict::yes);
  EXPECT_NEAR(*gains.objective, 1, 1e-3);
  EXPECT_NEAR(gains.searched.at("a"), 2, 0.03);
  EXPECT_NEAR(gains.searched.at("b"), 3, 0.03);
  EXPECT_LT(gains.search->feasible, gains.search->evaluations);
  EXPECT_EQ(gains.search->over, (std::vector<std::string>{"a", "b"}));
}

TEST(Search, ThreadsDoNotChangeTheResult) {
  const YamlProblem problem(kBowl);
  const SearchRequest request = request_of(*problem.problem);
  const auto run = [&](unsigned threads) {
    return synthesize_searched(*problem.problem, request, &kOptimizers, threads, {});
  };
  EXPECT_EQ(run(1).searched, run(4).searched);
}

TEST(Search, OnlyWhatIsOpenIsSearched) {
  const YamlProblem problem(kBowl + "parameters: {a: 2.5}\n");
  const SearchRequest request = request_of(*problem.problem);
  ASSERT_EQ(request.over.size(), 1U);
  EXPECT_EQ(request.over[0].name, "b");
  EXPECT_TRUE(request.over[0].axis.logarithmic);
  EXPECT_TRUE(request_of(*YamlProblem(kCircle).problem).empty());
}

TEST(Search, AFigureOfItsOwnIsMinimised) {
  const YamlProblem problem(kBowl + "search: {over: {a: [0, 9]}, minimize: K + 10*a}\n" +
                            "parameters: {b: 3}\n");
  const SearchRequest request = request_of(*problem.problem);
  const model::Gains gains = synthesize_searched(*problem.problem, request, &kOptimizers, 1, {});
  // 2((a - 2)^2 + 1) + 10 a is least at a = -0.5; feasible a is at least 0.
  ASSERT_EQ(gains.verdict, model::Verdict::yes);
  EXPECT_EQ(gains.search->figure, "K + 10*a");
  EXPECT_NEAR(gains.searched.at("a"), 0, 1e-3);
  EXPECT_NEAR(*gains.search->value, 10, 0.02);
}

TEST(Search, TheLargestScalarOverAnother) {
  const YamlProblem problem(kRidge);
  const SearchRequest request = request_of(*problem.problem);
  const model::Gains gains = synthesize_searched(*problem.problem, request, &kOptimizers, 2, {});
  ASSERT_EQ(gains.verdict, model::Verdict::yes);
  EXPECT_NEAR(gains.searched.at("c"), 4, 2e-3);
  EXPECT_NEAR(gains.searched.at("a"), 1, 0.05);
  EXPECT_TRUE(gains.search->certificate);
  EXPECT_GE(*gains.search->beyond, gains.searched.at("c"));
}

/// A coarse search, polished: the bottom of the bowl to many more digits.
TEST(Polish, MovesScalarsAndUnknownsTogetherToTheOptimum) {
  const YamlProblem problem(kBowl +
                            "search: {over: {a: [0, 9], b: [0.01, 90]}, evaluations: 20}\n");
  SearchRequest request = request_of(*problem.problem);
  const model::Gains coarse = optimize(*problem.problem, request, kOptimizers, 1, {});
  request.polish = true;
  const model::Gains fine = optimize(*problem.problem, request, kOptimizers, 1, {});
  ASSERT_TRUE(fine.search->polish);
  EXPECT_TRUE(fine.search->polish->kept) << fine.search->polish->cause;
  EXPECT_EQ(fine.search->polish->before, *coarse.objective);
  EXPECT_LT(*fine.objective, *coarse.objective);
  EXPECT_NEAR(*fine.objective, 1, 1e-5);
  EXPECT_NEAR(fine.searched.at("a"), 2, 1e-3);
  EXPECT_NEAR(fine.searched.at("b"), 3, 1e-3);
  for (const model::Margin& margin : fine.margins) EXPECT_TRUE(margin.holds);
}

/// The floor vanishes at a design; what is left of it, rounding, is no unit for its row.
TEST(Polish, RowsOfVanishingBlocksHaveTheSizeOfTheirTerms) {
  const YamlProblem problem(kBowl +
                            "search: {over: {a: [0, 9], b: [0.01, 90]}, evaluations: 20}\n");
  SearchRequest request = request_of(*problem.problem);
  request.polish = true;
  double largest = 0;
  const search::SmoothSolver recorder = [&](const search::SmoothProgram& program, double, int) {
    for (const double element : program.jacobian(program.start))
      largest = std::max(largest, std::abs(element));
    return search::SmoothSolution{program.start, true, "recorded", 0};
  };
  optimize(*problem.problem, request, {kOptimizers.local, recorder}, 1, {});
  EXPECT_GT(largest, 1);
  EXPECT_LT(largest, 100);
}

TEST(Polish, TheLargestScalarIsPolishedToo) {
  const YamlProblem problem(std::string(kRidge).replace(kRidge.find("60"), 2, "12"));
  SearchRequest request = request_of(*problem.problem);
  request.tolerance = {1e-6};
  request.polish = true;
  const model::Gains gains = optimize(*problem.problem, request, kOptimizers, 1, {});
  ASSERT_EQ(gains.verdict, model::Verdict::yes);
  EXPECT_TRUE(gains.search->polish->kept) << gains.search->polish->cause;
  EXPECT_NEAR(gains.searched.at("c"), 4, 1e-5);
  EXPECT_NEAR(gains.searched.at("a"), 1, 1e-2);
}

/// With matrices: the P of smallest trace for A' P + P A + I < 0 with A = [-1 a; 0 -2] is smallest
/// at a = 0, where P = diag(1/2, 1/4).
TEST(Polish, WorksOnMatrixInequalities) {
  const YamlProblem problem(
      "problem: m\nmethod:\n  method: m\n  parameters: {a: {default: 2, search: [-1, 3]}}\n"
      "  unknowns: {P: symmetric 2}\n  let: {A: \"[-1, a; 0, -2]\"}\n"
      "  require: {decrease: He(P*A) + I < 0, positive: P > 0}\n  minimize: trace(P)\n"
      "search: {over: {a: [-1, 2.5]}, evaluations: 6}\n");
  SearchRequest request = request_of(*problem.problem);
  request.polish = true;
  const model::Gains gains = optimize(*problem.problem, request, kOptimizers, 1, {});
  ASSERT_EQ(gains.verdict, model::Verdict::yes);
  EXPECT_TRUE(gains.search->polish->kept) << gains.search->polish->cause;
  EXPECT_NEAR(gains.searched.at("a"), 0, 2e-2);
  EXPECT_NEAR(*gains.objective, 0.75, 1e-4);
}

/// What is no better is not kept, and a figure that is not affine is said.
TEST(Polish, IsNotKeptWithoutGain) {
  const YamlProblem problem(kBowl +
                            "search: {over: {a: [0, 9]}, minimize: K^2}\nparameters: {b: 3}\n");
  SearchRequest request = request_of(*problem.problem);
  request.polish = true;
  const model::Gains gains = optimize(*problem.problem, request, kOptimizers, 1, {});
  ASSERT_EQ(gains.verdict, model::Verdict::yes);
  ASSERT_TRUE(gains.search->polish);
  EXPECT_FALSE(gains.search->polish->kept);
  EXPECT_FALSE(gains.search->polish->after);
  EXPECT_NE(gains.search->polish->cause, "");
}

/// What was found before an interrupt is designed with all its margins.
TEST(Search, AnInterruptLeavesTheBestSoFar) {
  const YamlProblem problem(kBowl);
  const SearchRequest request = request_of(*problem.problem);
  int asked = 0;
  sdp::Options solver;
  solver.interrupted = [&] { return ++asked > 90; };
  const model::Gains gains =
      synthesize_searched(*problem.problem, request, &kOptimizers, 1, solver);
  EXPECT_EQ(gains.verdict, model::Verdict::yes);
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
      synthesize_searched(*problem.problem, request_of(*problem.problem), &kOptimizers, 2, {});
  ASSERT_EQ(gains.verdict, model::Verdict::yes);
  EXPECT_NEAR(gains.searched.at("a"), 700, 0.1);
  EXPECT_LT(*gains.objective, 0.01);
}

TEST(Search, NothingFeasibleIsUndecided) {
  const YamlProblem problem(kBowl +
                            "search: {over: {a: [6, 9]}, evaluations: 20}\nparameters: {b: 3}\n");
  const model::Gains gains =
      synthesize_searched(*problem.problem, request_of(*problem.problem), &kOptimizers, 1, {});
  EXPECT_EQ(gains.verdict, model::Verdict::undecided);
  EXPECT_NE(gains.solver.message.find("a in [6, 9]"), std::string::npos);
  EXPECT_FALSE(gains.search->value);
  EXPECT_TRUE(gains.gains.empty());
}

TEST(Scan, GivesEveryPointInOrderForAnyThreads) {
  const YamlProblem problem(kBowl);
  const std::vector<expr::Expression> figures = {expr::parse(expr::Text("2*K", "--show"))};
  const auto points = search::grid({{1, 2, 9}, {3, 4}});
  const auto rows = scan(*problem.problem, {"a", "b"}, points, figures, 4, {});
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
  bool enough = false;
  sdp::Options solver;
  solver.interrupted = [&] { return std::exchange(enough, true); };
  const auto rows = scan(*problem.problem, {"k"}, {{0.3}, {0.3}, {0.3}}, {}, 1, solver);
  ASSERT_EQ(rows.size(), 3U);
  for (const ScanRow& row : rows) EXPECT_TRUE(row.interrupted);
  const auto whole = scan(*problem.problem, {"k"}, {{0.3}}, {}, 1, {});
  EXPECT_FALSE(whole[0].interrupted);
}

TEST(Scan, RefusesUnknownNamesAndKeepsRefusedPoints) {
  const YamlProblem problem(
      "problem: p\nmethod:\n  method: m\n  data: {a: scalar}\n  assume: {low: a < 2}\n"
      "  unknowns: {x: scalar}\n  require: {r: x > a}\n  minimize: x\ndata: {a: 1}\n");
  EXPECT_THROW(scan(*problem.problem, {"b"}, {{1}}, {}, 1, {}), InputError);
  const auto rows = scan(*problem.problem, {"a"}, {{1}, {3}}, {}, 1, {});
  EXPECT_EQ(rows[0].refused, "");
  EXPECT_NE(rows[1].refused.find("expected a < 2"), std::string::npos);
  const InputError error = tests::input_error([&] {
    scan(*problem.problem, {"a"}, {{3}, {4}}, {}, 1, {});
  });
  EXPECT_NE(error.message().find("expected a < 2"), std::string::npos);
}

}  // namespace
}  // namespace gainsmith::design
