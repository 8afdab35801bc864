#include "design/joint_refinement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "design/optimize.h"
#include "design/search_problems.h"
#include "support/input_error.h"
#include "support/yaml_problem.h"

namespace gainsmith::design {
namespace {

using testing::kBowl;
using testing::kRidge;
using tests::YamlProblem;

/// A coarse search, refined: the bottom of the bowl to many more digits.
TEST(JointRefinement, MovesScalarsAndUnknownsTogetherToTheOptimum) {
  const YamlProblem problem(kBowl +
                            "search: {over: {a: [0, 9], b: [0.01, 90]}, evaluations: 20}\n");
  SearchRequest request = request_of(problem.instance);
  const model::Gains coarse = synthesize_searched(problem.instance, request, 1, {});
  request.refine = true;
  const model::Gains fine = synthesize_searched(problem.instance, request, 1, {});
  ASSERT_TRUE(fine.search->joint_refinement);
  EXPECT_TRUE(fine.search->joint_refinement->kept) << fine.search->joint_refinement->cause;
  EXPECT_EQ(fine.search->joint_refinement->before, *coarse.objective);
  EXPECT_LT(*fine.objective, *coarse.objective);
  EXPECT_NEAR(*fine.objective, 1, 1e-5);
  EXPECT_NEAR(fine.searched.at("a"), 2, 1e-3);
  EXPECT_NEAR(fine.searched.at("b"), 3, 1e-3);
  for (const model::Margin& margin : fine.margins) EXPECT_TRUE(margin.holds);
}

/// The floor vanishes at a design; what is left of it, rounding, is no unit for its row.
TEST(JointRefinement, RowsOfVanishingBlocksHaveTheSizeOfTheirTerms) {
  const YamlProblem problem(kBowl +
                            "search: {over: {a: [0, 9], b: [0.01, 90]}, evaluations: 20}\n");
  const SearchRequest request = request_of(problem.instance);
  double largest = 0;
  const search::SmoothSolver recorder = [&](const search::SmoothProgram& program, double, int) {
    for (const double element : program.jacobian(program.start))
      largest = std::max(largest, std::abs(element));
    return search::SmoothSolution{program.start, true, "recorded", 0};
  };
  refine_jointly(problem.instance, request, synthesize_searched(problem.instance, request, 1, {}),
                 recorder);
  EXPECT_GT(largest, 1);
  EXPECT_LT(largest, 100);
}

TEST(JointRefinement, MovesTheLargestScalarToo) {
  const YamlProblem problem(std::string(kRidge).replace(kRidge.find("60"), 2, "12"));
  SearchRequest request = request_of(problem.instance);
  request.tolerance = {1e-6};
  request.refine = true;
  const model::Gains gains = synthesize_searched(problem.instance, request, 1, {});
  ASSERT_EQ(gains.verdict, model::Verdict::yes);
  EXPECT_TRUE(gains.search->joint_refinement->kept) << gains.search->joint_refinement->cause;
  EXPECT_NEAR(gains.searched.at("c"), 4, 1e-5);
  EXPECT_NEAR(gains.searched.at("a"), 1, 1e-2);
}

/// With matrices: the P of smallest trace for A' P + P A + I < 0 with A = [-1 a; 0 -2] is smallest
/// at a = 0, where P = diag(1/2, 1/4).
TEST(JointRefinement, WorksOnMatrixInequalities) {
  const YamlProblem problem(
      "problem: m\nmethod:\n  method: m\n  parameters: {a: {default: 2, search: [-1, 3]}}\n"
      "  unknowns: {P: symmetric 2}\n  let: {A: \"[-1, a; 0, -2]\"}\n"
      "  require: {decrease: He(P*A) + I < 0, positive: P > 0}\n  minimize: trace(P)\n"
      "search: {over: {a: [-1, 2.5]}, evaluations: 6}\n");
  SearchRequest request = request_of(problem.instance);
  request.refine = true;
  const model::Gains gains = synthesize_searched(problem.instance, request, 1, {});
  ASSERT_EQ(gains.verdict, model::Verdict::yes);
  EXPECT_TRUE(gains.search->joint_refinement->kept) << gains.search->joint_refinement->cause;
  EXPECT_NEAR(gains.searched.at("a"), 0, 2e-2);
  EXPECT_NEAR(*gains.objective, 0.75, 1e-4);
}

/// What is no better is not kept, and a figure that is not affine is said.
TEST(JointRefinement, IsNotKeptWithoutGain) {
  const YamlProblem problem(kBowl +
                            "search: {over: {a: [0, 9]}, minimize: K^2}\nparameters: {b: 3}\n");
  SearchRequest request = request_of(problem.instance);
  request.refine = true;
  const model::Gains gains = synthesize_searched(problem.instance, request, 1, {});
  ASSERT_EQ(gains.verdict, model::Verdict::yes);
  ASSERT_TRUE(gains.search->joint_refinement);
  EXPECT_FALSE(gains.search->joint_refinement->kept);
  EXPECT_FALSE(gains.search->joint_refinement->after);
  EXPECT_NE(gains.search->joint_refinement->cause, "");
}

}  // namespace
}  // namespace gainsmith::design
