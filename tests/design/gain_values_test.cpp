// Which kind of gain a formula gives, and its numbers.
#include "design/gain_values.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <string>

#include "support/linear_algebra.h"
#include "support/yaml_problem.h"

namespace gainsmith::design {
namespace {

using Kind = model::GainFunction::Kind;

const numbers::Matrix kP{{2, 0}, {0, 4}};
const numbers::Matrix kFirst{{2}, {4}};
const numbers::Matrix kSecond{{6}, {-8}};

lmi::Inequalities problem(const std::string& gain, int degree) {
  const tests::YamlProblem yaml(
      "problem: p\nmethod:\n  method: m\n  data: {C: p x n}\n  unknowns: {P: symmetric n, "
      "Y: {shape: n x p, of: tau, degree: " +
      std::to_string(degree) + "}}\n  require: {positive: P > 0}\n  gains: {" + gain +
      "}\ndata: {C: [[1, 2]]}\n");
  return lmi::Inequalities(yaml.instance);
}

model::Gains gains_of(const lmi::Inequalities& inequalities) {
  numbers::Values values = inequalities.instance.values;
  values["P"] = kP;
  values["Y_0"] = kFirst;
  values["Y_1"] = kSecond;
  model::Gains gains;
  add_gain_values(inequalities, values, gains);
  return gains;
}

TEST(GainValues, APolynomialIsStoredByItsCoefficients) {
  const auto gains = gains_of(problem("L(s): inv(P)*(Y(2*s)*s + C'*s^3)", 1));
  ASSERT_EQ(gains.gain_functions.size(), 1U);
  const model::GainFunction& gain = gains.gain_functions.front();
  EXPECT_EQ(gain.kind, Kind::polynomial);
  EXPECT_EQ(gain.variable, "s");
  EXPECT_EQ(gain.formula, "inv(P)*(Y(2*s)*s + C'*s^3)");
  ASSERT_EQ(gain.coefficients.size(), 4U);
  const numbers::Matrix inverse = tests::inverse(kP);
  EXPECT_TRUE(gain.coefficients[0].isZero(0));
  EXPECT_TRUE(gain.coefficients[1].isApprox(tests::product({inverse, kFirst}), 1e-15));
  EXPECT_TRUE(gain.coefficients[2].isApprox(tests::product({2 * inverse, kSecond}), 1e-15));
  EXPECT_TRUE(
      gain.coefficients[3].isApprox(tests::product({inverse, numbers::Matrix{{1}, {2}}}), 1e-15));
}

TEST(GainValues, WhatTurnsOutConstantIsAMatrix) {
  for (const std::string formula : {"L(tau): inv(P)*Y(tau)", "L(s): inv(P)*(Y(s) + s*C' - C'*s)"}) {
    const auto gains = gains_of(problem(formula, 0));
    EXPECT_TRUE(gains.gain_functions.empty()) << formula;
    ASSERT_EQ(gains.gains.size(), 1U) << formula;
    EXPECT_TRUE(
        gains.gains[0].second.isApprox(tests::product({tests::inverse(kP), kFirst}), 1e-15));
  }
  const auto zero = gains_of(problem("L(s): s*C' - C'*s", 0));
  ASSERT_EQ(zero.gains.size(), 1U);
  EXPECT_EQ(zero.gains[0].second, numbers::Matrix::Zero(2, 1));
}

TEST(GainValues, AnythingElseIsAFormula) {
  for (const std::string formula : {"exp(-tau)*Y(tau)", "inv(P + tau*I)*Y(tau)", "sqrt(tau)*C'"}) {
    const auto gains = gains_of(problem("L(tau): " + formula, 1));
    ASSERT_EQ(gains.gain_functions.size(), 1U) << formula;
    EXPECT_EQ(gains.gain_functions[0].kind, Kind::formula);
    EXPECT_EQ(gains.gain_functions[0].formula, formula);
    EXPECT_TRUE(gains.gain_functions[0].coefficients.empty());
  }
}

TEST(GainValues, OneMatrixAVertexIsAKindOfItsOwn) {
  lmi::Inequalities inequalities = problem("L(tau): inv(P)*Y(tau)", 1);
  const auto box = forall::box_of({{0, 0, 1, false}}, "tau", 0, 1.5, {});
  inequalities.functions[0].basis = forall::weights(box, "tau", {});
  inequalities.bodies = model::Bodies(inequalities.functions);
  const auto gains = gains_of(inequalities);
  ASSERT_EQ(gains.gain_functions.size(), 1U);
  EXPECT_EQ(gains.gain_functions[0].kind, Kind::vertices);
}

TEST(GainValues, WithoutAPointOnlyWhatFollowsFromDataIsKnown) {
  const auto inequalities = problem("L(tau): inv(P)*Y(tau), M(tau): C*tau, N: 2*C", 1);
  model::Gains gains;
  add_gain_values(inequalities, inequalities.instance.values, gains);
  ASSERT_EQ(gains.gain_functions.size(), 1U);
  EXPECT_EQ(gains.gain_functions[0].name, "M");
  ASSERT_EQ(gains.gains.size(), 1U);
  EXPECT_EQ(gains.gains[0].first, "N");
}

TEST(GainValues, AreRoundedOnce) {
  const auto yaml = tests::YamlProblem(
      "problem: p\nmethod:\n  method: m\n  unknowns: {X: scalar, Y: scalar}\n"
      "  require: {positive: X > 0}\n  gains: {K: inv(X - inv(Y))}\n");
  numbers::Values values = yaml.instance.values;
  const double x = 0.333333333333;
  values["X"] = numbers::Matrix{{x}};
  values["Y"] = numbers::Matrix{{3}};
  model::Gains gains;
  add_gain_values(lmi::Inequalities(yaml.instance), values, gains);
  const double exact = 3 / std::fma(3, x, -1);
  EXPECT_NEAR(gains.gains.at(0).second(0, 0) / exact, 1, 4e-16);
  EXPECT_GT(std::abs(1 / (x - 1.0 / 3) / exact - 1), 1e-6) << "in double";
}

TEST(Report, HoldsWhatHasAValue) {
  const auto yaml = tests::YamlProblem(
      "problem: p\nmethod:\n  method: m\n  data: {C: p x n}\n  unknowns: {P: symmetric n}\n"
      "  require: {positive: P > 0}\n  gains: {G(t): t*C}\n"
      "  report: {sizes: svd(3*C), floor: trace(P), half: G(1/2)}\ndata: {C: [[3, 4]]}\n");
  model::Gains gains;
  add_gain_values(lmi::Inequalities(yaml.instance), yaml.instance.values, gains);
  add_report(yaml.instance, gains);
  ASSERT_EQ(gains.report.size(), 2U);
  EXPECT_EQ(gains.report[0].first, "sizes");
  EXPECT_NEAR(gains.report[0].second(0, 0), 15, 1e-14);
  EXPECT_EQ(gains.report[1].first, "half");
  EXPECT_EQ(gains.report[1].second, (numbers::Matrix{{1.5, 2}}));
}

}  // namespace
}  // namespace gainsmith::design
