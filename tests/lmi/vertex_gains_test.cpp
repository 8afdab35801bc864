#include "lmi/vertex_gains.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "lmi/compile.h"
#include "numbers/types/real.h"
#include "support/input_error.h"
#include "support/yaml_problem.h"

namespace gainsmith::lmi {
namespace {

/// The hidden part of a rotating plant, with gains at the vertices.
std::string rotation(const std::string& require) {
  return "problem: p\nmethod:\n  method: m\n  data: {F: n x n, H: p x n, w: scalar}\n"
         "  unknowns: {Q: symmetric n, Y: {shape: n x p, of: s}}\n"
         "  let: {E(t): expm(F*t), S(t): \"(Q - Y(t)*H)*E(t)\"}\n  require:\n" +
         require +
         "data: {F: [[-0.1, -2], [2, -0.1]], H: [[1, 0.3]], w: 0.2}\n"
         "synthesis: {forall: vertex_gains}\n";
}

const char* const kStep =
    "    size: I <= Q <= 100*I\n"
    "    step: {forall: \"tau in [0.1, 1.2]\", that: \"[Q, S(tau)'; *, Q] > 0\"}\n";

/// The values of data, unknowns at random x, and tau.
numbers::Values random_values(const Inequalities& of, double tau, std::vector<double>& x,
                              std::mt19937& generator) {
  std::normal_distribution<double> normal;
  x.clear();
  for (int i = 0; i < of.unknowns.size(); ++i) x.push_back(normal(generator));
  numbers::Values values = of.instance.values;
  for (auto& [name, matrix] : of.unknowns.values(x)) values[name] = matrix;
  values["tau"] = numbers::Matrix::Constant(1, 1, tau);
  return values;
}

/// sum over the blocks of alpha_i alpha_j M_ij is the inequality itself, at every tau and x, for
/// one function and for two.
void expect_blocks_to_sum_up(const std::string& text, std::size_t vertices) {
  const tests::YamlProblem yaml(text);
  const Inequalities of(yaml.instance);
  const forall::Box& box = of.box.value();
  ASSERT_EQ(box.vertices.size(), vertices);
  for (const model::Function& function : of.functions) ASSERT_EQ(function.size(), vertices);
  const Lmi lmi = compile(of);
  ASSERT_EQ(lmi.blocks.size(), 2U + vertices * (vertices + 1) / 2);
  std::mt19937 generator(11);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<double> x;
    const double tau = 0.1 + 1.1 * trial / 19;
    const numbers::Values values = random_values(of, tau, x, generator);
    std::vector<double> alpha;
    for (const auto& vertex : box.vertices) {
      double weight = 1;
      for (std::size_t k = 0; k < box.atoms.size(); ++k) {
        const auto [low, high] = box.ranges[k];
        const double share = (forall::evaluate(box.atoms[k], tau) - low) / (high - low);
        weight *= vertex[k] == high ? share : 1 - share;
      }
      alpha.push_back(weight);
    }
    numbers::Matrix sum = numbers::Matrix::Zero(4, 4);
    std::size_t at = 2;
    for (std::size_t i = 0; i < vertices; ++i)
      for (std::size_t j = i; j < vertices; ++j)
        sum += (i == j ? 1 : 2) * alpha[i] * alpha[j] * lmi.blocks[at++].value(x);
    const numbers::Matrix direct = numbers::evaluate(of.statements[1].differences.at(0), values);
    EXPECT_LT((sum - direct).norm(), 1e-13 * (1 + direct.norm())) << tau;
  }
}

TEST(VertexGainsTest, TheBlocksSumUpToTheInequality) {
  expect_blocks_to_sum_up(rotation(kStep), 4);
}

TEST(VertexGainsTest, TwoFunctionsShareTheBox) {
  std::string text = rotation(
      "    size: I <= Q <= 100*I\n"
      "    step: {forall: \"tau in [0.1, 1.2]\", that: \"[Q, S(tau)'; *, Q + He(Z(tau)*H)] > "
      "0\"}\n");
  const std::string one = "Y: {shape: n x p, of: s}";
  text.replace(text.find(one), one.size(), one + ", Z: {shape: n x p, of: r, degree: 3}");
  expect_blocks_to_sum_up(text, 4);
}

/// With equal coefficients the function is that constant: the weights sum to 1.
TEST(VertexGainsTest, WeightsSumToOne) {
  const tests::YamlProblem yaml(rotation(kStep));
  const Inequalities of(yaml.instance);
  const expr::Body body = of.functions.at(0).body();
  numbers::Values values;
  for (const std::string& name : of.functions.at(0).coefficients())
    values[name] = numbers::Matrix::Constant(2, 1, 3);
  for (const double t : {0.1, 0.4, 0.77, 1.2}) {
    values[body.variable] = numbers::Matrix::Constant(1, 1, t);
    EXPECT_LT((numbers::evaluate(body.program, values) - numbers::Matrix::Constant(2, 1, 3)).norm(),
              1e-14);
  }
}

TEST(VertexGainsTest, SetsAndPolytopesMultiplyTheBlocks) {
  const tests::YamlProblem yaml(rotation(
      "    step:\n      forall: [\"tau in [0.1, 1.2]\", \"k in {1, 2, 3}\", \"A in conv{F, "
      "2*F}\"]\n"
      "      that: \"[Q, S(tau)'; *, Q] + [A, 0*I; 0*I, A]'*[A, 0*I; 0*I, 0*I]*0 > k*I\"\n"));
  EXPECT_NE(tests::input_error([&] { const Inequalities of(yaml.instance); })
                .message()
                .find("not affine in A"),
            std::string::npos);
  const tests::YamlProblem affine(
      rotation("    step:\n      forall: [\"tau in [0.1, 1.2]\", \"k in {1, 2, 3}\", \"A in "
               "conv{F, 2*F}\"]\n"
               "      that: \"He(A*Q) + [S(tau) + S(tau)'] < k*I\"\n"));
  const auto blocks = compile(Inequalities(affine.instance)).blocks;
  EXPECT_EQ(blocks.size(), 3U * 2U * 10U);
}

TEST(VertexGainsTest, OverASetTheValuesOfTheFunctionCount) {
  const tests::YamlProblem yaml(
      rotation(std::string(kStep) + "    points: {forall: \"k in {0.3, 1.2}\", that: \"[Q, S(k)'; "
                                    "*, 3*Q] > 0\"}\n"));
  const Inequalities of(yaml.instance);
  const Lmi lmi = compile(of);
  std::mt19937 generator(5);
  std::vector<double> x;
  int found = 0;
  for (const Block& block : lmi.blocks) {
    if (block.name != "points") continue;
    const double k = ++found == 1 ? 0.3 : 1.2;
    numbers::Values values = random_values(of, k, x, generator);
    values["k"] = numbers::Matrix::Constant(1, 1, k);
    const numbers::Matrix exact =
        numbers::evaluate(of.statements.back().differences.front(), values);
    EXPECT_LT((block.value(x) - exact).norm(), 1e-12 * exact.norm());
  }
  EXPECT_EQ(found, 2);
}

TEST(VertexGainsTest, OtherWaysLeaveTheInstanceAlone) {
  const std::string text = rotation(kStep);
  const tests::YamlProblem hull(text.substr(0, text.find("synthesis")));
  const Inequalities of(hull.instance);
  EXPECT_FALSE(of.box);
  EXPECT_EQ(of.functions.at(0).text(), "Y_0");
}

TEST(VertexGainsTest, Refusals) {
  const auto refusal = [](const std::string& text) {
    const tests::YamlProblem yaml(text);
    return tests::input_error([&] { compile(Inequalities(yaml.instance)); }).message();
  };
  EXPECT_NE(refusal(rotation("    set: {forall: \"k in {1, 2}\", that: \"He(S(k)) < 0\"}\n"))
                .find("'set' has 0"),
            std::string::npos);
  EXPECT_NE(refusal(rotation("    two: {forall: [\"a in [0, 1]\", \"b in [0, 1]\"], that: "
                             "\"He(S(a)) < b*I\"}\n"))
                .find("'two' has 2"),
            std::string::npos);
  EXPECT_NE(refusal(rotation("    one: {forall: \"a in [0, 1]\", that: \"He(S(a)) < I\"}\n"
                             "    two: {forall: \"b in [0, 1.5]\", that: \"He(S(b)) < I\"}\n"))
                .find("found [0, 1.5] and [0, 1]"),
            std::string::npos);
  for (const char* argument : {"0", "1 - a", "2*a"})
    EXPECT_NE(refusal(rotation("    one: {forall: \"a in [0, 1]\", that: \"He(S(a)) + He(Y(" +
                               std::string(argument) + ")*H) < I\"}\n"))
                  .find("functions of a alone"),
              std::string::npos)
        << argument;
  EXPECT_NE(refusal("problem: p\nmethod: {method: m, unknowns: {P: symmetric 2}, require: {a: P > "
                    "0}}\nsynthesis: {forall: vertex_gains}\n")
                .find("'m' has none"),
            std::string::npos);
}

}  // namespace
}  // namespace gainsmith::lmi
