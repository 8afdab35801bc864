#include "lmi/compile.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "support/input_error.h"
#include "support/yaml_problem.h"

namespace gainsmith::lmi {
namespace {

std::string requiring(const std::string& require, const std::string& more = "") {
  return "problem: p\nmethod:\n  method: m\n  data: {A: n x n, T: scalar}\n  unknowns: {P: "
         "symmetric n, Y: n x n}\n" +
         more + "  require:\n" + require + "data: {A: [[0, 1], [-2, -3]], T: 2}\n";
}

TEST(CompileTest, AnIntervalBecomesTheVerticesOfItsAtoms) {
  const tests::YamlProblem yaml(
      requiring("    flow: {forall: \"tau in [0, T]\", that: \"He(P*A) + exp(0.5*tau)*P < 0\"}\n"));
  const Lmi lmi = compile(Inequalities(yaml.instance));
  ASSERT_EQ(lmi.blocks.size(), 2U);
  EXPECT_EQ(lmi.blocks[0].point, "tau = 0");
  EXPECT_EQ(lmi.blocks[1].point, "tau = 2");
  EXPECT_TRUE(lmi.blocks[0].strict);
  const std::vector<double> x = {2, 1, 3, 0, 0, 0, 0};
  numbers::Matrix P(2, 2);
  P << 2, 1, 1, 3;
  const numbers::Matrix& A = yaml.instance.values.at("A");
  const numbers::Matrix expected = -(P * A + (P * A).transpose() + std::exp(1.0) * P);
  EXPECT_LT((lmi.blocks[1].value(x) - expected).norm(), 1e-14);
}

TEST(CompileTest, WhatDoubleCannotHoldIsRefusedAtItsPlace) {
  const auto refusal = [](const std::string& require) {
    const tests::YamlProblem yaml("problem: p\nmethod:\n  method: m\n  unknowns: {x: scalar}\n" +
                                  require);
    return tests::input_error([&] { compile(Inequalities(yaml.instance)); });
  };
  const InputError cost = refusal("  require: {a: x > 1}\n  minimize: 1e200*(1e200*x)\n");
  EXPECT_EQ(cost.place().line, 6) << cost.what();
  EXPECT_NE(cost.message().find("objective"), std::string::npos) << cost.what();
  for (const char* large :
       {"x > 1e308", "1e-308*x > 1e308", "1e301*x > 1", "[x, 1e308; 1e308, x] > 0"}) {
    const InputError error = refusal("  require:\n    a: \"" + std::string(large) + "\"\n");
    EXPECT_EQ(error.place().line, 6) << error.what();
    EXPECT_NE(error.message().find("too large for double"), std::string::npos) << error.what();
  }
}

/// "(Y_0 + (t)*Y_1 + (t)^2*Y_2)", for degree 2.
std::string polynomial(const std::string& name, const std::string& t, int degree) {
  std::string sum = "(" + name + "_0";
  for (int k = 1; k <= degree; ++k)
    sum += " + (" + t + ")" + (k > 1 ? "^" + std::to_string(k) : "") + "*" + name + "_" +
           std::to_string(k);
  return sum + ")";
}

/// Two functions of degrees that may be 0, called at the variable, at a number and at other
/// arguments: the blocks are those of the polynomials written out with coefficients as unknowns.
TEST(CompileTest, CallsAreTheirPolynomials) {
  const auto blocks = [](const std::string& unknowns, const std::string& that,
                         const std::string& way) {
    const tests::YamlProblem yaml(
        "problem: p\nmethod:\n  method: m\n  data: {A: n x n}\n  unknowns: {P: symmetric n, " +
        unknowns + "}\n  require:\n    flow: {forall: \"tau in [0.2, 1.7]\", that: \"" + that +
        "\"}\ndata: {A: [[0, 1], [-2, -3]]}\nsynthesis: {forall: " + way + "}\n");
    return compile(Inequalities(yaml.instance)).blocks;
  };
  const auto that = [](const auto& Y, const auto& Z) {
    return "He(P*A + exp(tau)*" + Y("tau") + " - A*" + Y("0") + ") + tau*" + Z("2*tau - 1") +
           " + " + Z("0.3") + " < 3*I";
  };
  std::mt19937 generator(5);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 8; ++trial) {
    const int dy = trial % 4;
    const int dz = trial / 4 + trial % 2;
    std::string written = "Y_0: n x n";
    for (int k = 1; k <= dy; ++k) written += ", Y_" + std::to_string(k) + ": n x n";
    for (int k = 0; k <= dz; ++k) written += ", Z_" + std::to_string(k) + ": symmetric n";
    for (const char* way : {"hull", "exchange", "auto"}) {
      const auto called =
          blocks("Y: {shape: n x n, of: s, degree: " + std::to_string(dy) +
                     "}, Z: {shape: symmetric n, of: tau, degree: " + std::to_string(dz) + "}",
                 that([](const std::string& t) { return "Y(" + t + ")"; },
                      [](const std::string& t) { return "Z(" + t + ")"; }),
                 way);
      const auto expected =
          blocks(written,
                 that([&](const std::string& t) { return polynomial("Y", t, dy); },
                      [&](const std::string& t) { return polynomial("Z", t, dz); }),
                 way);
      ASSERT_EQ(called.size(), expected.size()) << way;
      std::vector<double> x(static_cast<std::size_t>(3 + 4 * (dy + 1) + 3 * (dz + 1)));
      for (double& value : x) value = normal(generator);
      for (std::size_t k = 0; k < called.size(); ++k) {
        EXPECT_EQ(called[k].point, expected[k].point);
        EXPECT_TRUE(called[k].value(x).isApprox(expected[k].value(x), 1e-13)) << way << dy << dz;
      }
    }
  }
}

TEST(CompileTest, AnUnknownFunctionIsItsPolynomial) {
  const auto blocks = [](const std::string& unknowns, const std::string& y) {
    const tests::YamlProblem yaml(
        "problem: p\nmethod:\n  method: m\n  data: {A: n x n}\n  unknowns: {P: symmetric n, " +
        unknowns + "}\n  require:\n    flow: {forall: \"tau in [0, 2]\", that: \"He(P*A + " + y +
        "*exp(tau)) < 0\"}\ndata: {A: [[0, 1], [-2, -3]]}\n"
        "synthesis: {forall: hull}\n");
    return compile(Inequalities(yaml.instance)).blocks;
  };
  const auto called = blocks("Y: {shape: n x n, of: tau, degree: 2}", "Y(tau)");
  const auto written = blocks("Y_0: n x n, Y_1: n x n, Y_2: n x n", "(Y_0 + tau*Y_1 + tau^2*Y_2)");
  ASSERT_EQ(called.size(), 8U);
  ASSERT_EQ(written.size(), called.size());
  const std::vector<double> x = {1, -2, 3, 0.5, 1, 2, -3, 4, 5, -6, 7, 8, 9, -1, 3};
  for (std::size_t k = 0; k < called.size(); ++k) {
    EXPECT_EQ(called[k].point, written[k].point);
    EXPECT_TRUE(called[k].value(x).isApprox(written[k].value(x), 1e-14));
  }
}

TEST(CompileTest, TwoAtomsMakeFourVertices) {
  const tests::YamlProblem yaml(
      requiring("    wave: {forall: \"tau in [0, T]\", that: \"sin(2*tau)*P + "
                "cos(2*tau)*He(P*A) <= 5*I\"}\n") +
      "synthesis: {forall: hull}\n");
  const Lmi lmi = compile(Inequalities(yaml.instance));
  ASSERT_EQ(lmi.blocks.size(), 4U);
  std::set<std::string> points;
  for (const Block& block : lmi.blocks) points.insert(block.point);
  EXPECT_EQ(points.size(), 4U);
  EXPECT_EQ(points.count("cos(2*tau) = 1, sin(2*tau) = 1"), 1U);
}

TEST(CompileTest, SlicesCutTheInterval) {
  const tests::YamlProblem yaml(
      requiring("    wave: {forall: \"tau in [0, T]\", that: \"sin(2*tau)*P + "
                "cos(2*tau)*He(P*A) <= 5*I\"}\n") +
      "synthesis: {forall: {way: hull, slices: 3}}\n");
  EXPECT_EQ(compile(Inequalities(yaml.instance)).blocks.size(), 12U);
}

TEST(CompileTest, FunctionsOfDifferentVariablesAreExactAtTheirVertices) {
  const tests::YamlProblem yaml(requiring(
      "    box: {forall: [\"tau in [0, T]\", \"k in [1, 3]\"], that: \"k*exp(tau)*P + k*Y*A + "
      "(k*Y*A)' > 0\"}\n"));
  forall::Plan plan = forall::make_plan(*yaml.instance.design);
  const Lmi lmi = compile(Inequalities(yaml.instance), plan);
  ASSERT_EQ(lmi.blocks.size(), 4U);
  EXPECT_EQ(lmi.blocks[3].point, "tau = 2, k = 3");
  EXPECT_EQ(plan.inequalities[0].way, model::Way::hull);
  EXPECT_TRUE(plan.inequalities[0].exact);
}

TEST(CompileTest, APolytopeHasItsVertices) {
  const tests::YamlProblem yaml(requiring(
      "    stable: {forall: \"B in conv{A, 2*A, [0, 1; 1, 0]}\", that: \"He(P*B) < 0\"}\n"));
  const Lmi lmi = compile(Inequalities(yaml.instance));
  ASSERT_EQ(lmi.blocks.size(), 3U);
  EXPECT_EQ(lmi.blocks[1].point, "B = 2*A");
  EXPECT_TRUE(lmi.blocks[1]
                  .value({1, 0, 1, 0, 0, 0, 0})
                  .isApprox(2 * lmi.blocks[0].value({1, 0, 1, 0, 0, 0, 0}), 1e-14));
}

TEST(CompileTest, SeveralFunctionsMakeAnExchange) {
  const tests::YamlProblem yaml(requiring(
      "    wave: {forall: \"tau in [0, T]\", that: \"sin(2*tau)*P + cos(2*tau)*He(P*A) <= "
      "5*I\"}\n"));
  forall::Plan plan = forall::make_plan(*yaml.instance.design);
  const Lmi lmi = compile(Inequalities(yaml.instance), plan);
  EXPECT_EQ(plan.inequalities[0].way, model::Way::exchange);
  ASSERT_EQ(lmi.blocks.size(), 3U);
  EXPECT_EQ(lmi.blocks[2].point, "tau = 1");
}

TEST(CompileTest, FiniteSetsAndChains) {
  const tests::YamlProblem yaml(
      requiring("    chain: {forall: \"s in {1, 2, T + 1}\", that: \"I <= P <= s*I\"}\n"));
  const Lmi lmi = compile(Inequalities(yaml.instance));
  ASSERT_EQ(lmi.blocks.size(), 6U);
  EXPECT_EQ(lmi.blocks[0].name, "chain.1");
  EXPECT_EQ(lmi.blocks[5].name, "chain.2");
  EXPECT_EQ(lmi.blocks[5].point, "s = 3");
  EXPECT_DOUBLE_EQ(lmi.blocks[5].constant_size, 3);
  EXPECT_FALSE(lmi.blocks[5].strict);
}

TEST(CompileTest, AFiniteSetTakesAnyFunction) {
  const tests::YamlProblem yaml(requiring(
      "    sampled: {forall: \"tau in {0.5, 1}\", that: \"expm(A*tau)'*P*expm(A*tau) < P\"}\n"));
  EXPECT_EQ(compile(Inequalities(yaml.instance)).blocks.size(), 2U);
}

TEST(CompileTest, ObjectivesKeepTheirConstant) {
  const tests::YamlProblem yaml(
      requiring("    positive: P > I\n  minimize: 2*trace(P) - 3 + Y(2,1)\n"));
  const Lmi lmi = compile(Inequalities(yaml.instance));
  ASSERT_TRUE(lmi.has_objective);
  EXPECT_EQ(lmi.objective_constant, -3);
  EXPECT_EQ(lmi.objective, (std::vector<double>{2, 0, 2, 0, 1, 0, 0}));
}

TEST(CompileTest, HomogeneousMeansNoConstantTerm) {
  const tests::YamlProblem cone(requiring("    positive: P > 0\n    stable: He(P*A) < 0\n"));
  EXPECT_TRUE(is_homogeneous(compile(Inequalities(cone.instance)).blocks));
  const tests::YamlProblem affine(requiring("    positive: P > I\n"));
  EXPECT_FALSE(is_homogeneous(compile(Inequalities(affine.instance)).blocks));
}

TEST(CompileTest, WhatIsNotSymmetricIsRefused) {
  const tests::YamlProblem yaml(requiring("    wrong: P*A < 0\n"));
  const InputError error = tests::input_error([&] { compile(Inequalities(yaml.instance)); });
  EXPECT_EQ(error.place().line, 7);
  EXPECT_NE(error.message().find("not symmetric"), std::string::npos);
}

TEST(CompileTest, AnUnknownThatMustBeSymmetricIsRefusedWhereItIsDeclared) {
  for (const char* require :
       {"    it: Y > 0\n", "    it: A'*Y + Y*A < 0\n", "    it: \"[P, A; *, Y] > 0\"\n",
        "    it: {forall: \"tau in [0, T]\", that: \"P + tau*Y > 0\"}\n"}) {
    const tests::YamlProblem yaml(requiring(require));
    const InputError error = tests::input_error([&] { compile(Inequalities(yaml.instance)); });
    EXPECT_EQ(error.place().line, 5) << require;
    EXPECT_EQ(error.place().column, 30) << require;
    EXPECT_NE(error.message().find("the unknown Y is n x n, and the inequality 'it' is symmetric "
                                   "only where it is; declare Y: symmetric n"),
              std::string::npos)
        << error.message();
  }
}

/// Wherever the equation stands; what it does not make symmetric is refused.
TEST(CompileTest, EquationsMakeInequalitiesSymmetric) {
  for (const char* require : {"    sym: A'*Y == Y'*A\n    it: A'*Y > 0\n",
                              "    it: A'*Y > 0\n    sym: 3*Y'*A - 3*A'*Y == 0\n"}) {
    const tests::YamlProblem yaml(requiring(require));
    const Inequalities inequalities(yaml.instance);
    std::vector<double> x(static_cast<std::size_t>(inequalities.unknowns.size()));
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = 1 + static_cast<double>(i * i);
    const numbers::Matrix M =
        yaml.instance.values.at("A").transpose() * inequalities.unknowns.values(x).at("Y");
    for (const Block& block : compile(inequalities).blocks)
      if (block.name == "it") {
        EXPECT_EQ(block.value(x), (M + M.transpose()) / 2) << require;
      }
  }
  for (const char* require :
       {"    sym: A*Y == Y'*A'\n    it: A'*Y > 0\n", "    sym: A'*Y <= Y'*A\n    it: A'*Y > 0\n"}) {
    const tests::YamlProblem yaml(requiring(require));
    const InputError error = tests::input_error([&] { compile(Inequalities(yaml.instance)); });
    EXPECT_NE(error.message().find("not symmetric"), std::string::npos) << error.message();
  }
}

/// Y*A is not symmetric for a symmetric Y either.
TEST(CompileTest, NoUnknownIsAtFaultWhereSymmetryDoesNotHelp) {
  for (const char* require : {"    it: Y*A < 0\n", "    it: Y + P*A < 0\n"}) {
    const tests::YamlProblem yaml(requiring(require));
    const InputError error = tests::input_error([&] { compile(Inequalities(yaml.instance)); });
    EXPECT_EQ(error.place().line, 7) << require;
    EXPECT_NE(error.message().find("not symmetric"), std::string::npos) << error.message();
  }
}

TEST(CompileTest, DataTooLargeForDoubleAreRefused) {
  const tests::YamlProblem yaml(
      "problem: p\nmethod:\n  method: m\n  data: {A: n x n}\n  unknowns: {P: symmetric n}\n"
      "  require: {p: P > I, l: He(P*A) < 0}\ndata: {A: \"-1e308*eye(2)\"}\n");
  const InputError error = tests::input_error([&] { compile(Inequalities(yaml.instance)); });
  EXPECT_NE(error.message().find("'l' has a coefficient that is not finite"), std::string::npos)
      << error.what();
  EXPECT_EQ(error.place().line, 6);
}

TEST(CompileTest, WhatHasNoRowsIsRefused) {
  const tests::YamlProblem yaml(requiring("    empty: P(1:0, 1:0) > 0\n"));
  const InputError error = tests::input_error([&] { compile(Inequalities(yaml.instance)); });
  EXPECT_EQ(error.place().line, 7);
  EXPECT_NE(error.message().find("'empty' has no rows"), std::string::npos) << error.message();
}

TEST(CompileTest, AnEmptyIntervalIsRefused) {
  const tests::YamlProblem yaml(
      requiring("    flow: {forall: \"tau in [T, 1]\", that: \"exp(tau)*P > 0\"}\n"));
  EXPECT_NE(
      tests::input_error([&] { compile(Inequalities(yaml.instance)); }).message().find("empty"),
      std::string::npos);
}

}  // namespace
}  // namespace gainsmith::lmi
