#include "lmi/formulation.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/yaml_problem.h"

namespace gainsmith::lmi {
namespace {

std::string problem_with(const std::string& require) {
  return "problem: p\nmethod:\n  method: m\n  data: {A: n x n, s: scalar}\n  unknowns: {P: "
         "symmetric n}\n  require:\n" +
         require;
}

constexpr const char* kData = "data: {A: [[0, 1], [-2, -3]], s: 5}\n";

/// X = sum x_i F_i - F_0 of one block of the SDP, from its entries.
numbers::Matrix slack(const sdp::Problem& problem, int block, const std::vector<double>& x) {
  const int size = problem.blocks[static_cast<std::size_t>(block)].size;
  numbers::Matrix result = numbers::Matrix::Zero(size, size);
  for (std::size_t i = 0; i < problem.f.size(); ++i) {
    for (const sdp::Entry& entry : problem.f[i]) {
      if (entry.block != block) continue;
      const double value = entry.value * (i == 0 ? -1.0 : x[i - 1]);
      result(entry.row, entry.column) += value;
      if (entry.row != entry.column) result(entry.column, entry.row) += value;
    }
  }
  return result;
}

Formulation formulation_of(const Lmi& lmi) { return formulate(lmi, {}, {}, goal_of(lmi, {})); }

TEST(FormulationTest, TheGoalFollowsFromObjectiveAndConstants) {
  const auto goal = [](const std::string& require) {
    const tests::YamlProblem yaml(problem_with(require) + kData);
    return goal_of(compile(Inequalities(yaml.instance)), {});
  };
  EXPECT_EQ(goal("    a: P > 0\n"), Goal::homogeneous_feasibility);
  EXPECT_EQ(goal("    a: P > I\n"), Goal::feasibility);
  EXPECT_EQ(goal("    a: P > 0\n  minimize: trace(P)\n"), Goal::normalised_objective);
  EXPECT_EQ(goal("    a: P > I\n  minimize: trace(P)\n"), Goal::bounded_objective);
}

TEST(FormulationTest, StrictBlocksKeepTheirMarginAndOthersDoNot) {
  const tests::YamlProblem yaml(
      problem_with("    strict: He(P*A) + s*I < 0\n    loose: P >= s*I\n  minimize: trace(P)\n") +
      kData);
  const Lmi lmi = compile(Inequalities(yaml.instance));
  const Formulation formulation = formulation_of(lmi);
  const std::vector<double> x = {1.5, 0.25, 2.5};
  for (int k = 0; k < 2; ++k) {
    const Block& block = lmi.blocks[static_cast<std::size_t>(k)];
    const double margin =
        block.strict ? formulation.margin * formulation.scales[static_cast<std::size_t>(k)] : 0;
    const numbers::Matrix expected = block.value(x) - margin * numbers::Matrix::Identity(2, 2);
    std::vector<double> scaled = x;
    for (double& value : scaled) value /= formulation.unit;
    EXPECT_LT((formulation.unit * slack(formulation.problem, k, scaled) - expected).norm(), 1e-13);
  }
  EXPECT_GT(formulation.scales[0], 0);
}

TEST(FormulationTest, ScalesFollowTheData) {
  const auto scales = [](double s) {
    const tests::YamlProblem yaml(problem_with("    a: P > 0\n    b: He(P*A) + s*I < 0\n") +
                                  "data: {A: [[0, 1], [-2, -3]], s: " + std::to_string(s) + "}\n");
    return formulation_of(compile(Inequalities(yaml.instance))).scales;
  };
  const auto one = scales(1);
  const auto thousand = scales(1000);
  for (std::size_t k = 0; k < one.size(); ++k)
    EXPECT_NEAR(thousand[k], 1000 * one[k], 1e-9 * thousand[k]);
}

TEST(FormulationTest, HomogeneousFeasibilityAddsTheSizeOfX) {
  const tests::YamlProblem yaml(problem_with("    a: P > 0\n    b: He(P*A) < 0\n") + kData);
  const Lmi lmi = compile(Inequalities(yaml.instance));
  const Formulation formulation = formulation_of(lmi);
  ASSERT_EQ(formulation.problem.m(), 4);
  EXPECT_EQ(formulation.problem.c, (std::vector<double>{0, 0, 0, 1}));
  const std::vector<double> x = {1, -3, 2, 5};
  const numbers::Matrix limits = slack(formulation.problem, 2, x);
  ASSERT_EQ(limits.rows(), 6);
  const numbers::Matrix expected = (Eigen::VectorXd(6) << 6, 4, 2, 8, 7, 3).finished().asDiagonal();
  EXPECT_EQ(limits, expected);
}

TEST(FormulationTest, EntriesAreMergedSortedAndInTheUpperTriangle) {
  const tests::YamlProblem yaml(problem_with("    a: He(P*A) + A + A' < P\n") + kData);
  const Formulation formulation = formulation_of(compile(Inequalities(yaml.instance)));
  for (const auto& entries : formulation.problem.f) {
    for (const sdp::Entry& entry : entries) EXPECT_LE(entry.row, entry.column);
    const auto same = [](const sdp::Entry& a, const sdp::Entry& b) {
      return a.block == b.block && a.row == b.row && a.column == b.column;
    };
    EXPECT_EQ(std::adjacent_find(entries.begin(), entries.end(), same), entries.end());
  }
}

TEST(FormulationTest, MultiplierSizesAddComparisonsAndVertices) {
  const tests::YamlProblem yaml(
      "problem: p\nmethod:\n  method: m\n  data: {A: n x n}\n  unknowns: {P: symmetric n}\n"
      "  require:\n    other: P > 0\n    all:\n      forall: [\"tau in [0, 2]\", \"B in conv{A, "
      "2*A}\"]\n"
      "      that: \"-3*I < P + sin(tau)*B + tau*I < 5*I\"\n"
      "data: {A: [[0, 1], [1, 0]]}\nsynthesis: {forall: exchange}\n");
  forall::Plan plan = forall::make_plan(*yaml.instance.design);
  const Lmi lmi = compile(Inequalities(yaml.instance), plan);
  const std::size_t points = plan.inequalities[1].points.size();
  ASSERT_EQ(points, 3U);
  Formulation formulation;
  sdp::Solution solution;
  std::vector<double> expected(points, 0.0);
  for (const Block& block : lmi.blocks) {
    formulation.releases.kept.push_back({0, 1});
    const double size = static_cast<double>(solution.Y.values.size());
    solution.Y.values.push_back({size, 9, 9, 1});
    for (std::size_t k = 0; k < points; ++k)
      if ((block.point + ", ").starts_with(plan.inequalities[1].points[k].label + ", "))
        expected[k] += size + 1;
  }
  // At tau = 0 nothing of B is left: two blocks there, four at each of the other points.
  ASSERT_EQ(lmi.blocks.size(), 1U + 2U + 4U + 4U);
  EXPECT_EQ(multiplier_sizes(lmi, formulation, solution, "all", points), expected);
}

}  // namespace
}  // namespace gainsmith::lmi
