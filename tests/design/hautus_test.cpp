#include "design/hautus.h"

#include <gtest/gtest.h>

#include <regex>

#include "support/yaml_problem.h"

namespace gainsmith::design {
namespace {

std::string text_for(const std::string& A, const std::string& C) {
  const tests::YamlProblem yaml(
      "problem: p\nmethod:\n  method: m\n  data: {A: n x n, C: p x n}\n"
      "  unknowns: {P: symmetric n}\n  require: {positive: P > I}\n  gains: {L: P}\n"
      "  plant: {state: {x: n}, flow: {x: A*x}}\ndata: {A: " +
      A + ", C: " + C + "}\nno campaign: static\n");
  return hidden_mode_text(yaml.instance);
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string eigenvalue_in(const std::string& text) {
  std::smatch found;
  std::regex_search(text, found, std::regex("eigenvalue (.*) in the direction"));
  return found.empty() ? "" : found[1].str();
}

TEST(Hautus, EigenvaluesAreNamedWithTheDigitsThatAreKnown) {
  const std::string C = "[[0, 0, 1]]";
  const auto rotation = [](const std::string& rate, const std::string& speed) {
    return "[[" + rate + ", " + speed + ", 0], [-" + speed + ", " + rate + ", 0], [0, 0, -1]]";
  };
  EXPECT_EQ(eigenvalue_in(text_for(rotation("0.25", "3"), C)), "0.25 +- 3i");
  // The norm of A is 1; eigenvalues are known to 1e-12 of it.
  EXPECT_EQ(eigenvalue_in(text_for(rotation("2e-10", "1"), C)), "2e-10 +- 1i");
  EXPECT_EQ(eigenvalue_in(text_for(rotation("2.3456e-10", "1"), C)), "2.35e-10 +- 1i");
  EXPECT_EQ(eigenvalue_in(text_for(rotation("3e-13", "1"), C)), "0 (to 1e-12) +- 1i");
  EXPECT_EQ(eigenvalue_in(text_for(rotation("0", "1"), C)), "0 +- 1i");
  EXPECT_EQ(eigenvalue_in(text_for("[[2e-10, 0, 0], [0, -1, 0], [0, 0, -1]]", C)), "2e-10");
}

/// x = diag(2^23, 2^-20) z of an observable plant, and of one whose second mode is hidden.
TEST(Hautus, NothingDependsOnTheUnitsOfTheStates) {
  EXPECT_EQ(text_for("[[2.8, -1.08002495835528235252410888671875e-13], [15832967439974.4, -3.7]]",
                     "[[6710886.4, 4.76837158203125e-7]]"),
            "");
  const std::string hidden = text_for("[[-1, 0], [1099511627776, 2]]", "[[6710886.4, 0]]");
  EXPECT_TRUE(has(hidden, "eigenvalue 2 in the direction [0; 1]")) << hidden;
}

TEST(Hautus, AHiddenModeThatShrinksIsNoReasonInDiscreteTime) {
  const auto text = [](const std::string& hidden) {
    const tests::YamlProblem yaml("problem: p\nmethod: discrete-observer\ndata: {A: [[" + hidden +
                                  ", 0], [0, 2]], C: [[0, 1]]}\nno campaign: static\n");
    return hidden_mode_text(yaml.instance);
  };
  EXPECT_EQ(text("0.5"), "");
  EXPECT_TRUE(has(text("-1.5"), "eigenvalue -1.5 in the direction [1; 0]")) << text("-1.5");
}

/// A design of the method on two masses and a spring, of which B and C are given.
std::string text_of_masses(const std::string& method, const std::string& data) {
  const tests::YamlProblem yaml(
      "problem: p\nmethod: " + method +
      "\ndata: {A: \"[0, 0, 1, 0; 0, 0, 0, 1; -2, 2, 0, 0; 4, -4, 0, 0]\", " + data +
      "}\nno campaign: static\n");
  return hidden_mode_text(yaml.instance);
}

TEST(Hautus, WhatAnInputDoesNotReachIsNamedWhereGainsUseIt) {
  const std::string lqr = text_of_masses("lqr", "B: \"[0; 0; 2; -4]\"");
  EXPECT_TRUE(has(lqr, "the input does not reach a mode")) << lqr;
  EXPECT_TRUE(has(lqr, "eigenvalue 0 in the combination [0; 0; 1; 0.5]")) << lqr;
  EXPECT_EQ(text_of_masses("lqr", "B: \"[0; 0; 1; 0]\""), "");
  const std::string rest = ", B1: \"[0; 0; 0; 1]\", C1: \"[0, 1, 0, 0]\"";
  EXPECT_TRUE(has(text_of_masses("hinf-state-feedback", "B2: \"zeros(4, 1)\"" + rest),
                  "[A - lambda*I, B2] loses rank"));
  // The input of an analysis may reach what it likes.
  EXPECT_TRUE(has(text_of_masses("h2-norm", "B: \"zeros(4, 1)\", C: \"eye(4)\""),
                  "a mode of the plant does not decay: eigenvalue 0"));
  EXPECT_TRUE(
      has(text_of_masses("output-feedback", "B2: \"[0; 0; 1; 0]\", C2: \"[1, -1, 0, 0]\"" + rest),
          "in the direction [1; 1; 0; 0], where [A - lambda*I; C2]"));
}

TEST(Hautus, OfAnAnalysisThePlantsOwnModesAreJudged) {
  const auto text_of = [](const std::string& method, const std::string& A) {
    const tests::YamlProblem yaml("problem: p\nmethod: " + method + "\ndata: {A: " + A +
                                  ", B: [[0], [1]], C: [[1, 0]]}\n");
    return hidden_mode_text(yaml.instance);
  };
  for (const char* method : {"hinf-norm", "h2-norm", "passivity"}) {
    EXPECT_TRUE(has(text_of(method, "[[0.5, 1], [0, -1]]"), "eigenvalue 0.5 of A")) << method;
    EXPECT_EQ(text_of(method, "[[-0.5, 2], [-2, -0.1]]"), "") << method;
  }
  for (const char* method : {"discrete-hinf-norm", "discrete-h2-norm", "discrete-passivity"}) {
    EXPECT_TRUE(has(text_of(method, "[[0.5, 1], [0, -1]]"), "eigenvalue -1 of A")) << method;
    EXPECT_EQ(text_of(method, "[[0.5, 1], [0, -0.9]]"), "") << method;
  }
}

TEST(Hautus, NothingIsSaidWithoutAPlantOrWhereAllIsSeen) {
  EXPECT_EQ(text_for("[[1, 1], [0, 2]]", "[[1, 0]]"), "");
  const tests::YamlProblem yaml(
      "problem: p\nmethod:\n  method: m\n  data: {A: n x n, C: p x n}\n"
      "  unknowns: {P: symmetric n}\n  require: {positive: P > I}\n"
      "data: {A: [[1, 0], [0, -2]], C: [[0, 1]]}\nno campaign: static\n");
  EXPECT_EQ(hidden_mode_text(yaml.instance), "");
}

}  // namespace
}  // namespace gainsmith::design
