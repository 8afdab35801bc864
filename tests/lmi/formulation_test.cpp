#include "lmi/formulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lmi/correlation.h"
#include "sdp/solver.h"
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

Formulation interior_of(const Lmi& lmi) { return formulate_interior(lmi, {}, {}); }

/// S_k B_k(x) S_k, with rows and units of the balance.
numbers::Matrix in_units(const Lmi& lmi, const Balance& balance, std::size_t k,
                         const std::vector<double>& x) {
  numbers::Vector rows(lmi.blocks[k].size);
  for (int r = 0; r < rows.size(); ++r) rows[r] = balance.row(k, r);
  return rows.asDiagonal() * lmi.blocks[k].value(x) * rows.asDiagonal();
}

/// x_i / d_i.
std::vector<double> in_units(const Balance& balance, std::vector<double> x) {
  for (std::size_t i = 0; i < x.size(); ++i) x[i] /= balance.unit(static_cast<int>(i) + 1);
  return x;
}

TEST(FormulationTest, AnObjectiveHasAMinimumOnlyBesideConstants) {
  const auto minimum = [](const std::string& require) {
    const tests::YamlProblem yaml(problem_with(require) + kData);
    return has_minimum(compile(Inequalities(yaml.instance)), {});
  };
  EXPECT_FALSE(minimum("    a: P > 0\n"));
  EXPECT_FALSE(minimum("    a: P > I\n"));
  EXPECT_FALSE(minimum("    a: P > 0\n  minimize: trace(P)\n"));
  EXPECT_TRUE(minimum("    a: P > I\n  minimize: trace(P)\n"));
}

TEST(FormulationTest, TheObjectiveIsSolvedInBalancedUnitsWithItsShift) {
  const tests::YamlProblem yaml(
      problem_with("    strict: He(P*A) + 1e6*s*I < 0\n    loose: 1e-3*P >= s*I\n  minimize: "
                   "trace(P)\n") +
      kData);
  const Lmi lmi = compile(Inequalities(yaml.instance));
  const double shift = 1e-3;
  const Formulation formulation = formulate_objective(lmi, {}, shift);
  const std::vector<double> x = {1.5e4, 0.25e4, 2.5e4};
  const std::vector<double> y = in_units(formulation.balance, x);
  double cost = 0;
  double largest = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    cost += formulation.problem.c[i] * y[i];
    largest = std::max(largest, std::abs(formulation.problem.c[i]));
  }
  EXPECT_DOUBLE_EQ(cost, lmi.objective_at(x) * formulation.cost_unit);
  EXPECT_GE(largest, 1);
  EXPECT_LT(largest, 2);
  for (std::size_t k = 0; k < 2; ++k) {
    const numbers::Matrix expected =
        in_units(lmi, formulation.balance, k, x) - shift * numbers::Matrix::Identity(2, 2);
    EXPECT_LT((slack(formulation.problem, static_cast<int>(k), y) - expected).norm(),
              1e-13 * expected.norm());
  }
}

/// minimise x with x > 2 and y > 1e-9, in units far from those of the solution: the objective does not see y,
/// which the weight keeps small.
/// 1e-6 of the size of the optimum, whatever the unit of the costs, but for one that is 0.
TEST(FormulationTest, ABracketIsNarrowBesideItsOptimum) {
  Formulation formulation;
  for (const double unit : {1.0, 0x1p-30, 0x1p30}) {
    formulation.cost_unit = 1 / unit;
    const auto narrow = [&](double low, double high) {
      return is_narrow_bracket(low * unit, high * unit, formulation);
    };
    EXPECT_TRUE(narrow(1 - 9e-7, 1));
    EXPECT_FALSE(narrow(1 - 2e-6, 1));
    EXPECT_FALSE(narrow(1e-7 - 5e-7, 1e-7));
    EXPECT_TRUE(narrow(1e-7 - 9e-14, 1e-7));
    EXPECT_TRUE(narrow(-1e-9, 2e-9));
    EXPECT_FALSE(narrow(-2e-8, 2e-9));
    EXPECT_FALSE(narrow(-1, -1 + 2e-6));
  }
}

TEST(FormulationTest, TheWeightBoundsWhatTheObjectiveDoesNotSee) {
  const tests::YamlProblem yaml(
      "problem: p\nmethod:\n  method: m\n  unknowns: {x: scalar, y: scalar}\n"
      "  require: {a: x > 2, b: \"[y, 1e-3*x; *, 1e6*y] > 0\"}\n  minimize: x\ndata: {}\n");
  const Lmi lmi = compile(Inequalities(yaml.instance));
  const std::vector<double> near = {2.1, 1e-5};
  const Formulation data = formulate_objective(lmi, {}, 0);
  Formulation formulation = in_units_of_solution(lmi, {}, data, in_units(data.balance, near));
  for (std::size_t k = 0; k < 2; ++k) {
    const numbers::Matrix block = in_units(lmi, formulation.balance, k, near);
    for (int r = 0; r < block.rows(); ++r) {
      EXPECT_GT(block(r, r), 0.01) << k;  // of 2.1 - 2 the terms are 2.1 and 2
      EXPECT_LT(block(r, r), 4) << k;
    }
  }
  formulation.weight = 1e-6;
  assemble(lmi, {}, {}, formulation);
  const sdp::Solution solution = sdp::solve(formulation.problem);
  ASSERT_EQ(solution.status, sdp::Status::optimal);
  const std::vector<double> x = read_back(lmi, formulation, solution);
  EXPECT_NEAR(x[0], 2, 1e-5);
  EXPECT_LT(x[1], 1e-3);
  const double bound = objective_lower_bound(lmi, {}, formulation, solution);
  EXPECT_LE(bound, 2);
  EXPECT_GT(bound, 2 - 1e-3);
}

/// In a round with t and D_k a block is B - t diag(B) - s D_k and the sizes of all, measured by
/// D_k, are at most the number of rows; x_0 stands where the constants stood.
TEST(FormulationTest, ARoundAsksForALargerMarginInItsOwnDiagonals) {
  const tests::YamlProblem yaml(problem_with("    a: P > 0\n    b: He(P*A) + s*I < 0\n") + kData);
  const Lmi lmi = compile(Inequalities(yaml.instance));
  Round round;
  round.margin = 0.25;
  round.diagonals = {numbers::Vector::Constant(2, 3), (numbers::Vector(2) << 5, 0.5).finished()};
  round.constant = 4;
  const Formulation formulation = formulate_interior(lmi, {}, round);
  ASSERT_TRUE(formulation.homogenised);
  ASSERT_EQ(formulation.problem.m(), 5);
  EXPECT_EQ(formulation.rows, 5);
  EXPECT_EQ(formulation.problem.c, (std::vector<double>{0, 0, 0, 0, -1}));
  const double constant = 2;
  const double s = 0.125;
  const std::vector<double> x = {1, -3, 2};
  std::vector<double> y = in_units(formulation.balance, x);
  y.push_back(constant);
  y.push_back(s);
  double sizes = constant / round.constant;
  std::vector<double> scaled = x;
  for (double& value : scaled) value /= constant;
  for (std::size_t k = 0; k < 2; ++k) {
    const numbers::Matrix B = constant * in_units(lmi, formulation.balance, k, scaled);
    numbers::Matrix expected = B;
    expected.diagonal() -= round.margin * B.diagonal() + s * round.diagonals[k];
    EXPECT_LT((slack(formulation.problem, static_cast<int>(k), y) - expected).norm(), 1e-12);
    sizes += B.diagonal().cwiseQuotient(round.diagonals[k]).sum();
  }
  EXPECT_DOUBLE_EQ(slack(formulation.problem, 2, y)(0, 0),
                   constant * (1 - round.margin) - s * round.constant);
  EXPECT_NEAR(slack(formulation.problem, 3, y)(0, 0), 5 - sizes, 1e-12);
}

TEST(FormulationTest, WithoutConstantsNothingIsHomogenised) {
  const tests::YamlProblem yaml(problem_with("    a: P > 0\n    b: He(P*A) < 0\n") + kData);
  const Formulation formulation = interior_of(compile(Inequalities(yaml.instance)));
  EXPECT_FALSE(formulation.homogenised);
  EXPECT_EQ(formulation.problem.m(), 4);
  EXPECT_EQ(formulation.problem.blocks.size(), 3U);
}

/// Time and states in units that are powers of two: the very same program.
TEST(FormulationTest, UnitsThatArePowersOfTwoGiveTheSameProgram) {
  const auto program = [](const std::string& A) {
    const tests::YamlProblem yaml(
        "problem: p\nmethod: {method: m, data: {A: n x n}, unknowns: {P: symmetric n}, require: "
        "{a: P > 0, b: He(P*A) < 0}}\ndata: {A: " +
        A + "}\n");
    return interior_of(compile(Inequalities(yaml.instance))).problem;
  };
  const sdp::Problem one = program("[[0.1, 0.7, 0], [-2, -3, 5], [1, 0.3, -0.9]]");
  // z_1 = 1024 x_1, z_3 = x_3 / 8, t -> 4 t.
  const sdp::Problem other = program(
      "[[0.025, 179.2, 0], [-0.00048828125, -0.75, 10], [0.000030517578125, 0.009375, -0.225]]");
  EXPECT_EQ(one.f, other.f);
  EXPECT_EQ(one.c, other.c);
}

/// x = x_f / x_0 in the units of the problem; the next round measures by the diagonals there.
TEST(FormulationTest, APointInsideIsReadBackAndMeasured) {
  const tests::YamlProblem yaml(problem_with("    a: P > 0\n    b: He(P*A) + 1e5*s*I < 0\n") +
                                kData);
  const Lmi lmi = compile(Inequalities(yaml.instance));
  const Formulation formulation = interior_of(lmi);
  const double constant = 0.5;
  const std::vector<double> x = {5e6, 1e6, 1e6};
  sdp::Solution solution;
  solution.x = in_units(formulation.balance, x);
  for (double& value : solution.x) value *= constant;
  solution.x.push_back(constant);
  solution.x.push_back(0.01);
  EXPECT_EQ(interior_margin(solution), 0.01);
  const std::vector<double> back = read_back(lmi, formulation, solution);
  ASSERT_EQ(back.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_DOUBLE_EQ(back[i], x[i]);
  const auto next = next_round(lmi, {}, formulation, solution.x);
  ASSERT_TRUE(next);
  EXPECT_EQ(next->constant, constant);
  double least = 1;
  for (std::size_t k = 0; k < 2; ++k) {
    least = std::min(least, correlation_margin(lmi.blocks[k].value(x)));
    const numbers::Vector expected = constant * in_units(lmi, formulation.balance, k, x).diagonal();
    EXPECT_LT((next->diagonals[k] - expected).norm(), 1e-12 * expected.norm());
  }
  EXPECT_NEAR(next->margin, least, 1e-12);
  solution.x[0] = -1;
  EXPECT_FALSE(next_round(lmi, {}, formulation, solution.x));
  solution.x = {1, 0, 1, -0.5, 0.01};
  EXPECT_FALSE(next_round(lmi, {}, formulation, solution.x));
}

/// <B_ki, Y_k> is the same number whatever the units.
TEST(FormulationTest, MultipliersAreInTheUnitsOfTheData) {
  const tests::YamlProblem yaml(problem_with("    a: 1e4*P > 0\n    b: He(P*A) + 1e-3*s*I < 0\n") +
                                kData);
  const Lmi lmi = compile(Inequalities(yaml.instance));
  const Formulation formulation = interior_of(lmi);
  sdp::Solution solution;
  solution.Y.values = {{2, 0.5, 0.5, 1}, {3, -1, -1, 4}, {1}, {1}};
  const auto Y = multipliers(lmi, {}, formulation, solution);
  ASSERT_EQ(Y.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    const Eigen::Map<const numbers::Matrix> balanced(solution.Y.values[k].data(), 2, 2);
    for (int i = 1; i <= 3; ++i) {
      std::vector<double> unit(3, 0.0);
      unit[static_cast<std::size_t>(i) - 1] = 1;
      const numbers::Matrix B = lmi.blocks[k].value(unit) - lmi.blocks[k].value({0, 0, 0});
      std::vector<double> y(5, 0.0);
      y[static_cast<std::size_t>(i) - 1] = 1;
      const numbers::Matrix F = slack(formulation.problem, static_cast<int>(k), y) -
                                slack(formulation.problem, static_cast<int>(k), {0, 0, 0, 0, 0});
      EXPECT_NEAR(B.cwiseProduct(Y[k]).sum() * formulation.balance.unit(i),
                  F.cwiseProduct(balanced).sum(), 1e-12);
    }
  }
}

TEST(FormulationTest, EntriesAreMergedSortedAndInTheUpperTriangle) {
  const tests::YamlProblem yaml(problem_with("    a: He(P*A) + A + A' < P\n") + kData);
  const Formulation formulation = interior_of(compile(Inequalities(yaml.instance)));
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
    formulation.free_variables.kept.push_back({0, 1});
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
