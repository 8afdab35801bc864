#include "lmi/matrix_program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "support/expect_counts.h"
#include "support/yaml_problem.h"

namespace gainsmith::lmi {
namespace {

using numbers::Matrix;

constexpr const char* kPlant =
    "  A: [[-1, 0.7, 0], [-2, -3, 0.5], [0.25, 0.3, -0.9]]\n  B: [[1, 0], [0.5, 2], [0, -1]]\n"
    "  C: [[1, 0, 2e3], [0, 0.3, 1]]\n  a: 0.3\n";

/// A method of one's own with this plant.
std::string of_plant(const std::string& rest) {
  return "problem: p\nmethod:\n  method: m\n"
         "  data: {A: n x n, B: n x m, C: p x n, a: scalar}\n" +
         rest + "data:\n" + kPlant;
}

struct Named {
  const char* name;
  std::string text;
};

const std::vector<Named>& problems() {
  static const std::vector<Named> list = {
      {"lyapunov", of_plant("  unknowns: {P: symmetric n}\n  require: {positive: P > 0, "
                            "decrease: He(P*A) + a*P < 0}\n")},
      {"written_out", of_plant("  unknowns: {P: symmetric n}\n  require: {positive: P > I, "
                               "decrease: A'*P + a*P + P*A + 0.1*eye(3) < 0}\n")},
      {"observer", of_plant("  unknowns: {P: symmetric n, Y: n x p}\n  require: {positive: P > 0, "
                            "decrease: He(P*A - Y*C) + a*P < 0}\n  gains: {L: inv(P)*Y}\n")},
      {"stated_bound",
       of_plant("  unknowns: {P: symmetric n, Y: n x p}\n  require: {positive: P > I, "
                "decrease: He(P*A - Y*C) + a*P < 0}\n  minimize: trace(P)\n"
                "  gains: {L: inv(P)*Y}\n") +
           "synthesis: {gain_bound: 30}\n"},
      {"feedback",
       of_plant("  unknowns: {Q: symmetric n, R: m x n}\n  require: {positive: Q > 0, "
                "decrease: \"A*Q + B*R + (A*Q + B*R)' < -a*Q\"}\n  gains: {K: R*inv(Q)}\n")},
      {"bounded_real",
       of_plant("  unknowns: {P: symmetric n, g: scalar}\n  require:\n    positive: P > 0\n"
                "    gain: \"[He(P*A) + C'*C, P*B; *, -g*I] < 0\"\n  minimize: g\n")},
      {"discrete", of_plant("  unknowns: {P: symmetric n}\n  require: {positive: P > 0, "
                            "decrease: A'*P*A - P/2 < 3*P}\n")},
      {"congruence",
       of_plant("  unknowns: {P: symmetric n, X: 3 x 3}\n  require:\n"
                "    positive: \"B'*(P + He(X))*B > 0\"\n"
                "    part: \"[P(1:2, 1:2), B'*P; *, expm(A)'*P*expm(A) - 0.01*P] > 0\"\n")},
      {"mixed", of_plant("  unknowns: {P: symmetric n, D: diagonal n, Y: n x p, g: scalar}\n"
                         "  require:\n    positive: \"P + D > g*I\"\n"
                         "    decrease: He(P*A - Y*C) + D < 0\n    bound: g > 1\n"
                         "  minimize: trace(P*B*B') + 3*Y(1, 2) + g\n")},
      {"interval",
       of_plant("  unknowns: {P: symmetric n, Y: n x p}\n  require:\n    positive: P > 0\n"
                "    all: {forall: \"tau in [0, 0.4]\", that: \"(1 + tau)*He(P*A - Y*C) + "
                "exp(a*tau)*P < tau*eye(3)\"}\n")},
      {"polytope",
       of_plant("  unknowns: {P: symmetric n}\n  require:\n    positive: P > 0\n"
                "    all: {forall: \"F in conv{A, A - eye(3), 1.5*A}\", that: He(P*F) < 0}\n")},
      {"functions",
       of_plant("  unknowns: {P: {shape: symmetric n, of: tau, degree: 2}, Y: n x p}\n  require:\n"
                "    positive: {forall: \"tau in [0, 1]\", that: P(tau) > 0}\n"
                "    all: {forall: \"tau in [0, 1]\", that: \"He(P(tau)*A + tau*P(0) - "
                "Y*C) < 0\"}\n")},
      {"sampled_data_hybrid",
       "problem: p\nmethod: sampled-data-hybrid\ndata:\n  A: [[-1, 0.7, 0], [-2, -3, 0.5], "
       "[0.25, 0.3, -0.9]]\n  C: [[1, 0, 2], [0, 0.3, 1]]\n  T1: 0.05\n  T2: 0.1\n  QF: I\n  QJ: "
       "0.01*I\nparameters: {delta: 0.03, eta: 1e-4, a1: 100, a2: 1}\nno campaign: static\n"},
  };
  return list;
}

/// The blocks with matrices in products, and those of the scalars.
struct Posed {
  tests::YamlProblem yaml;
  Inequalities inequalities;
  Lmi lmi;
  GainBounds bounds;

  Posed(const std::string& text, int large) : yaml(text), inequalities(yaml.instance) {
    inequalities.unknowns =
        Unknowns(model::unknown_matrices(inequalities.design(), inequalities.functions), large);
    lmi = compile(inequalities);
    bounds = gain_bounds(inequalities, lmi);
  }
};

Matrix dense(const sdp::DenseMatrix& matrix) {
  return Eigen::Map<const Matrix>(matrix.values.data(), matrix.rows, matrix.columns);
}

Matrix value(const sdp::MatrixProgram::Unknown& unknown, const std::vector<double>& x) {
  return matrix_at({unknown.first + 1, unknown.rows, unknown.columns, unknown.symmetric}, x);
}

/// S_k(x) as sdp/schur/matrix_program.h states it.
Matrix slack(const sdp::MatrixProgram& program, std::size_t k, const std::vector<double>& x) {
  const sdp::MatrixProgram::Block& block = program.blocks[k];
  Matrix result = Matrix::Zero(block.size, block.size);
  for (const auto& product : block.products) {
    const Matrix M = dense(product.E) *
                     value(program.unknowns[static_cast<std::size_t>(product.unknown)], x) *
                     dense(product.F);
    result += M + M.transpose();
  }
  for (const auto& e : block.elements) {
    const double part = e.value * (e.variable < 0 ? 1 : x[static_cast<std::size_t>(e.variable)]);
    result(e.row, e.column) += part;
    if (e.row != e.column) result(e.column, e.row) += part;
  }
  return result;
}

/// sum x_i F_i - F_0 of one block, and the sum of the sizes of its terms.
std::pair<Matrix, double> slack_and_sizes(const sdp::Problem& problem, int block,
                                          const std::vector<double>& x) {
  const int size = problem.blocks[static_cast<std::size_t>(block)].size;
  Matrix result = Matrix::Zero(size, size);
  double sizes = 0;
  for (std::size_t i = 0; i < problem.f.size(); ++i)
    for (const sdp::Entry& entry : problem.f[i]) {
      if (entry.block != block) continue;
      const double part = entry.value * (i == 0 ? -1.0 : x[i - 1]);
      sizes = std::max(sizes, std::abs(part));
      result(entry.row, entry.column) += part;
      if (entry.row != entry.column) result(entry.column, entry.row) += part;
    }
  return {result, sizes};
}

class MatrixProgramTest : public ::testing::TestWithParam<Named> {
 protected:
  /// Compares the programs at random points.
  void expect_same(const Posed& posed, const Formulation& formulation, const Round& round) {
    const auto program = matrix_program(posed.lmi, posed.bounds, formulation, round);
    ASSERT_EQ(program.has_value(), formulation.free_variables.list.empty());
    if (!program) return;
    const sdp::Problem& problem = formulation.problem;
    ASSERT_EQ(program->c.size(), problem.c.size());
    std::uniform_real_distribution<double> number(-1, 1);
    for (int trial = 0; trial < 3; ++trial) {
      std::vector<double> x;
      for (std::size_t i = 0; i < problem.c.size(); ++i) x.push_back(number(generator_));
      const std::vector<double> y = balanced_variables(formulation, *program, x);
      std::size_t dense = 0, row = 0;
      for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
        const auto [expected, sizes] = slack_and_sizes(problem, static_cast<int>(b), y);
        Matrix found(1, 1);
        if (problem.blocks[b].diagonal) {
          ASSERT_LT(row, program->rows.size());
          found(0, 0) = program->rows[row].constant;
          for (const auto& [i, a] : program->rows[row].coefficients)
            found(0, 0) += a * x[static_cast<std::size_t>(i)];
          ++row;
        } else {
          ASSERT_LT(dense, program->blocks.size());
          found = slack(*program, dense++, x);
        }
        ASSERT_EQ(found.rows(), expected.rows());
        EXPECT_LE((found - expected).cwiseAbs().maxCoeff(), 1e-13 * sizes) << "block " << b;
      }
      EXPECT_EQ(dense, program->blocks.size());
      EXPECT_EQ(row, program->rows.size());
      double cost = 0, expected_cost = 0;
      for (std::size_t i = 0; i < x.size(); ++i) {
        cost += program->c[i] * x[i];
        expected_cost += problem.c[i] * y[i];
      }
      EXPECT_NEAR(cost, expected_cost, 1e-13 * (1 + std::abs(expected_cost)));
    }
  }

  std::mt19937 generator_{5};
};

TEST_P(MatrixProgramTest, IsTheProgramOfTheLargestMargin) {
  const Posed posed(GetParam().text, 1);
  Round round;
  expect_same(posed, formulate_interior(posed.lmi, posed.bounds, round), round);
  round.constant = 0.7;
  std::uniform_real_distribution<double> size(0.5, 2);
  for (const auto* list : {&posed.lmi.blocks, &posed.bounds.blocks})
    for (const Block& block : *list)
      round.diagonals.push_back(
          numbers::Vector::NullaryExpr(block.size, [&] { return size(generator_); }));
  const Formulation formulation = formulate_interior(posed.lmi, posed.bounds, round);
  expect_same(posed, formulation, round);
  round.margin = 0.1;
  EXPECT_FALSE(matrix_program(posed.lmi, posed.bounds, formulation, round));
}

/// Without a program a round is measured by the blocks of the Lmi.
TEST_P(MatrixProgramTest, TheNextRoundNeedsNoProgram) {
  const Posed posed(GetParam().text, 1);
  const Formulation assembled = formulate_interior(posed.lmi, posed.bounds, {});
  const Formulation plain = pose_interior(posed.lmi, posed.bounds);
  EXPECT_TRUE(plain.blocks.empty());
  EXPECT_EQ(plain.variables, assembled.problem.m());
  std::uniform_real_distribution<double> number(-1, 1);
  for (int trial = 0; trial < 100; ++trial) {
    sdp::Solution solution;
    for (int i = 0; i < plain.variables; ++i) solution.x.push_back(number(generator_));
    // Near P = I some are inside.
    for (const Unknown& unknown : posed.inequalities.unknowns.list())
      for (int k = 0; k < unknown.count; ++k) {
        const auto [row, column] = unknown.places(k).front();
        double& value = solution.x[static_cast<std::size_t>(unknown.first + k) - 1];
        value = 0.1 * value + (unknown.structure == model::Structure::symmetric && row == column);
      }
    const auto one = next_round(posed.lmi, posed.bounds, plain, solution.x);
    const auto other = next_round(posed.lmi, posed.bounds, assembled, solution.x);
    ASSERT_EQ(one.has_value(), other.has_value());
    if (!one) continue;
    EXPECT_NEAR(one->margin, other->margin, 1e-12);
    EXPECT_EQ(one->constant, other->constant);
    for (std::size_t k = 0; k < one->diagonals.size(); ++k)
      EXPECT_LT((one->diagonals[k] - other->diagonals[k]).norm(), 1e-12 * one->diagonals[k].norm());
  }
}

TEST_P(MatrixProgramTest, IsTheProgramOfTheObjective) {
  const Posed posed(GetParam().text, 1);
  if (!posed.lmi.has_objective) return;
  expect_same(posed, formulate_objective(posed.lmi, posed.bounds, 1e-3), {});
}

/// Products and scalars are two ways to the same blocks.
TEST_P(MatrixProgramTest, BlocksAreThoseOfTheScalars) {
  const Posed posed(GetParam().text, 1);
  const Posed scalars(GetParam().text, 1000);
  const auto expect_same = [](const std::vector<Block>& blocks,
                              const std::vector<Block>& expected) {
    ASSERT_EQ(blocks.size(), expected.size());
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      ASSERT_EQ(blocks[k].terms.size(), expected[k].terms.size());
      EXPECT_EQ(blocks[k].constant_size, expected[k].constant_size);
      const double size = std::max(expected[k].coefficient_size, expected[k].constant_size);
      EXPECT_NEAR(blocks[k].coefficient_size, expected[k].coefficient_size, 1e-15 * size);
      for (std::size_t t = 0; t < blocks[k].terms.size(); ++t) {
        EXPECT_EQ(blocks[k].terms[t].first, expected[k].terms[t].first);
        const Sparse& found = blocks[k].terms[t].second;
        EXPECT_TRUE(is_symmetric(found));
        EXPECT_LE((Matrix(found) - Matrix(expected[k].terms[t].second)).cwiseAbs().maxCoeff(),
                  1e-15 * size);
      }
      ASSERT_TRUE(expected[k].products);
      EXPECT_TRUE(expected[k].products->empty());
    }
  };
  expect_same(posed.lmi.blocks, scalars.lmi.blocks);
  expect_same(posed.bounds.blocks, scalars.bounds.blocks);
  EXPECT_EQ(posed.lmi.objective, scalars.lmi.objective);
  EXPECT_FALSE(matrix_program(scalars.lmi, scalars.bounds,
                              formulate_interior(scalars.lmi, scalars.bounds, {}), {}));
}

INSTANTIATE_TEST_SUITE_P(Problems, MatrixProgramTest, ::testing::ValuesIn(problems()),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(MatrixProgram, ProductsAreAsFewAsTheyCanBe) {
  const auto count = [](const std::string& that) {
    const Posed posed(
        of_plant("  unknowns: {P: symmetric n, Y: n x p}\n  require: {it: \"" + that + "\"}\n"), 1);
    return posed.lmi.blocks[0].products->size();
  };
  tests::expect_counts(count, {{"P > 0", 1},
                               {"He(P*A) + a*P < 0", 1},
                               {"A'*P + a*P + P*A < 0", 1},
                               {"He(P*A - Y*C) + a*P < 0", 2},
                               {"[He(P*A), P*B; *, -eye(2)] < 0", 1},
                               {"A'*P*A < P", 2}});
}

TEST(MatrixProgram, NoneWhereAMatrixStandsByItsScalars) {
  const auto program = [](const std::string& require) {
    const Posed posed(of_plant("  unknowns: {P: symmetric n}\n  require: {" + require + "}\n"), 1);
    return matrix_program(posed.lmi, {}, formulate_interior(posed.lmi, {}, {}), {});
  };
  EXPECT_FALSE(program("it: P + trace(P)*eye(3) > 0"));
  EXPECT_FALSE(program("it: P > 0, small: trace(P) < 1"));
  EXPECT_FALSE(program("it: P.*A - P.*eye(3) + P.*A' > 0"));
  EXPECT_TRUE(program("\"it\": P > 0, \"element\": \"P(2, 2) + C(1, :)*P*C(1, :)' < 1\""));
}

/// The sum is symmetric, what stands in products alone is not.
TEST(MatrixProgram, TermsAndProductsAreSymmetricTogether) {
  const Posed posed(of_plant("  unknowns: {P: symmetric n}\n  require: {it: "
                             "\"P*A + (P*A)'.*ones(3, 3) < 0\"}\n"),
                    1);
  EXPECT_FALSE(posed.lmi.blocks[0].products);
  const Posed other(of_plant("  unknowns: {P: symmetric n}\n  require: {it: He(P*A) < 0}\n"), 1);
  std::vector<double> x = {1, 0.3, -0.2, 2, 0.5, 3};
  EXPECT_LT((posed.lmi.blocks[0].value(x) - other.lmi.blocks[0].value(x)).norm(), 1e-14);
}

TEST(MatrixProgram, NoneWhereScalarsAreFree) {
  const Posed posed(of_plant("  unknowns: {P: symmetric n, Y: n x p, g: scalar}\n  require:\n"
                             "    it: \"[P, P*B; *, g*eye(2)] > 0\"\n"),
                    1);
  const Formulation formulation = formulate_interior(posed.lmi, {}, {});
  ASSERT_FALSE(formulation.free_variables.list.empty());
  EXPECT_FALSE(matrix_program(posed.lmi, {}, formulation, {}));
}

TEST(MatrixProgram, AnAsymmetricSumIsRefused) {
  for (const char* that : {"P*A < 0", "P*A + A'*P + Y*C < 0"})
    EXPECT_THROW(Posed(of_plant("  unknowns: {P: symmetric n, Y: n x p}\n  require: {it: \"" +
                                std::string(that) + "\"}\n"),
                       1),
                 InputError)
        << that;
}

}  // namespace
}  // namespace gainsmith::lmi
