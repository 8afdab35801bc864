// What expressions see of a gain file: the file's matrices and texts.
#include "model/stated.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "bind/binding.h"
#include "bind/instance.h"
#include "bind/small_problem.h"
#include "bind/stated.h"
#include "expr/binding/compile.h"
#include "expr/text/parser.h"
#include "support/input_error.h"

namespace gainsmith::bind {
namespace {

using Kind = model::GainFunction::Kind;
using tests::input_error;

/// The small method with an unknown function and a gain that is one.
const std::string kWithGainFunction =
    changed(changed(kSmallMethod, "X: n x m", "X: {shape: n x m, of: tau, degree: 1}"),
            "gains: {K: b'*P, A: A}", "gains: {K: b'*P, A: A, G(t): inv(P)*X(t)}");

const numbers::Matrix kFirst{{1}, {2}};
const numbers::Matrix kSecond{{5}, {-7}};

model::Gains file() {
  model::Gains gains;
  gains.file = "g.json";
  gains.gains = {{"K", numbers::Matrix{{9, 8}}}};
  gains.unknowns = {{"P", 2 * numbers::Matrix::Identity(2, 2)}, {"X_0", kFirst}, {"X_1", kSecond}};
  gains.functions = {{"X(tau)", "X_0 + X_1*tau", {}}};
  return gains;
}

numbers::Matrix value(const model::Gains& gains, const std::string& text) {
  const Small small(kSmallProblem, kWithGainFunction);
  const expr::Program program =
      expr::compile(expr::parse({text, "test"}), small.design().names->running);
  return state(small.instance, gains).value(program).value();
}

std::string refusal(const model::Gains& gains) {
  const InputError error = input_error([&] { value(gains, "1"); });
  EXPECT_EQ(error.place().file, "g.json");
  return error.message();
}

TEST(Stated, AGainIsTheMatrixOfTheFile) {
  EXPECT_EQ(value(file(), "K"), (numbers::Matrix{{9, 8}}));
}

TEST(Stated, ABasisOfTheFileTakesTheProblemsPlaceAndDataFollowIt) {
  const std::string method = changed(kWithGainFunction, "  T1: scalar",
                                     "  N: {shape: n x k, default: \"null([3, 4])\"}\n  W: {shape: "
                                     "n x k, default: \"2*N\"}\n  T1: scalar");
  const Small small(kSmallProblem, method);
  const auto value_of = [&](const model::Gains& gains, const std::string& name) {
    return state(small.instance, gains).values.at(name);
  };
  EXPECT_TRUE(value_of(file(), "W").isApprox(numbers::Matrix{{1.6}, {-1.2}}, 1e-14));
  model::Gains gains = file();
  gains.bases = {{"N", numbers::Matrix{{-0.8}, {0.6}}}};
  EXPECT_EQ(value_of(gains, "N"), (numbers::Matrix{{-0.8}, {0.6}}));
  EXPECT_EQ(value_of(gains, "W"), (numbers::Matrix{{-1.6}, {1.2}}));
  EXPECT_EQ(value_of(gains, "A"), small.instance.values.at("A"));
  for (const auto& [name, matrix] :
       {std::pair{"W", numbers::Matrix{{1}, {1}}}, {"none", numbers::Matrix{{1}, {1}}}}) {
    gains.bases = {{name, matrix}};
    EXPECT_NE(input_error([&] { state(small.instance, gains); }).message().find(name),
              std::string::npos);
  }
  gains.bases = {{"N", numbers::Matrix{{1, 1}}}};
  EXPECT_NE(input_error([&] { state(small.instance, gains); }).message().find("1 x 2"),
            std::string::npos);
}

TEST(Stated, AFormulaIsEvaluatedOverTheFilesTexts) {
  model::Gains gains = file();
  gains.gain_functions = {{"G", "t", Kind::formula, "inv(P)*X(t)", {}}};
  EXPECT_TRUE(value(gains, "G(3)").isApprox((kFirst + 3 * kSecond) / 2, 1e-15));
  gains.functions = {{"X(tau)", "exp(-tau)*X_0 + (1 - exp(-tau))*X_1", {}}};
  const double w = std::exp(-3.0);
  EXPECT_TRUE(value(gains, "G(3)").isApprox((w * kFirst + (1 - w) * kSecond) / 2, 1e-15));
  gains.gain_functions[0].formula = "-X(2*t)";
  gains.functions = {{"X(tau)", "X_0 + X_1*tau", {}}};
  EXPECT_TRUE(value(gains, "G(3)").isApprox(-(kFirst + 6 * kSecond), 1e-15));
}

TEST(Stated, APolynomialIsItsCoefficients) {
  model::Gains gains = file();
  gains.gain_functions = {{"G", "t", Kind::polynomial, "anything", {kSecond, kFirst, kFirst}}};
  EXPECT_TRUE(value(gains, "G(2)").isApprox(kSecond + 6 * kFirst, 1e-15));
}

TEST(Stated, AConstantMayBeCalled) {
  model::Gains gains = file();
  gains.gains.emplace_back("G", kSecond);
  EXPECT_EQ(value(gains, "G(0.7)"), kSecond);
}

TEST(Stated, MoreCoefficientsThanTheDegreeAskFor) {
  model::Gains gains = file();
  gains.unknowns.emplace_back("X_2", kFirst);
  gains.functions = {{"X(tau)", "X_0*tau + X_1*(1 - tau) + X_2", {}}};
  const Small small(kSmallProblem, kWithGainFunction);
  EXPECT_EQ(state(small.instance, gains).unknowns,
            (std::vector<model::UnknownMatrix>{{"P", {2, 2}, model::Structure::symmetric},
                                               {"X_0", {2, 1}},
                                               {"X_1", {2, 1}},
                                               {"X_2", {2, 1}},
                                               {"g", {1, 1}, model::Structure::scalar}}));
  EXPECT_TRUE(value(gains, "X(0.5)").isApprox(1.5 * kFirst + 0.5 * kSecond, 1e-15));
}

/// The file's formula may use all coefficients of the file, and the data as they are now.
TEST(Stated, AFormulaUsesTheCoefficientsAndDataOfTheFile) {
  model::Gains gains = file();
  gains.unknowns.emplace_back("X_2", kFirst);
  gains.functions = {{"X(tau)", "X_0*tau + X_1*(1 - tau) + X_2", {}}};
  gains.gain_functions = {{"G", "t", Kind::formula, "X_2*t", {}}};
  EXPECT_TRUE(value(gains, "G(3)").isApprox(3 * kFirst, 1e-15));

  const Small small(kSmallProblem, kWithGainFunction);
  gains.gain_functions[0].formula = "orth([T1 - 0.5; 0; 0; 0])*0 + X(t)";
  EXPECT_NE(tests::input_error([&] { state(small.instance, gains); }).message().find("4 x 0"),
            std::string::npos);
  gains.gain_functions[0].formula = "[trace(orth(T1 - 0.5)*orth(T1 - 0.5)'); 0]";
  const auto program = expr::compile(expr::parse({"G(1)", "test"}), small.design().names->running);
  EXPECT_EQ(state(small.instance, gains).value(program).value()(0, 0), 0);
  const model::Instance later = evaluate(small.instance.design, {{"T1", 0.75}});
  EXPECT_EQ(later.design, small.instance.design);
  EXPECT_DOUBLE_EQ(state(later, gains).value(program).value()(0, 0), 1);
}

TEST(Stated, WhatDoesNotFitIsRefused) {
  model::Gains gains = file();
  gains.functions = {{"Y(tau)", "X_0", {}}};
  EXPECT_NE(refusal(gains).find("defines Y(tau), which is no unknown function"), std::string::npos);
  gains = file();
  gains.functions = {{"X(tau)", "X_0 + X_3", {}}};
  EXPECT_NE(refusal(gains).find("unknown name 'X_3'"), std::string::npos);
  gains.functions = {{"X(tau)", "X_0'", {}}};
  EXPECT_NE(refusal(gains).find("X(tau) is 2 x 1, but 'X_0'' is 1 x 2"), std::string::npos);
  gains.functions = {{"X(tau)", "X_0 +", {}}};
  EXPECT_NE(refusal(gains).find("expected"), std::string::npos);
  gains = file();
  gains.unknowns.erase(gains.unknowns.begin() + 1);
  EXPECT_NE(refusal(gains).find("lacks the coefficients X_0"), std::string::npos);
  gains = file();
  gains.unknowns[1].second = numbers::Matrix::Zero(3, 1);
  EXPECT_NE(refusal(gains).find("X_0 in the gain file is 3 x 1, expected 2 x 1"),
            std::string::npos);
  gains = file();
  gains.gain_functions = {{"G", "t", Kind::polynomial, "", {numbers::Matrix::Zero(1, 2)}}};
  EXPECT_NE(refusal(gains).find("G_0 in the gain file is 1 x 2"), std::string::npos);
  gains.gain_functions = {{"G", "t", Kind::polynomial, "", {}}};
  EXPECT_NE(refusal(gains).find("no coefficients"), std::string::npos);
  gains.gain_functions = {{"G", "t", Kind::formula, "b'", {}}};
  EXPECT_NE(refusal(gains).find("G in the gain file is 1 x 2, expected 2 x 1"), std::string::npos);
  gains.gain_functions = {{"G", "s", Kind::formula, "inv(P)*X(u)", {}}};
  EXPECT_NE(refusal(gains).find("unknown name 'u'"), std::string::npos);
}

TEST(Stated, WithoutAPointNothingOfItHasAValue) {
  model::Gains gains;
  gains.functions = {{"X(tau)", "X_0 + X_1*tau", {}}};
  const Small small(kSmallProblem, kWithGainFunction);
  const model::Stated stated = state(small.instance, gains);
  EXPECT_FALSE(stated.values.contains("X_0"));
  EXPECT_TRUE(stated.bodies.contains("G"));
  EXPECT_TRUE(stated.bodies.contains("X"));
  const auto program = expr::compile(expr::parse({"G(1)", "test"}), small.design().names->running);
  EXPECT_FALSE(stated.value(program));
}

}  // namespace
}  // namespace gainsmith::bind
