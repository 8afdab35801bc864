// Data that are functions, and inequalities for all columns of a box.
#include <gtest/gtest.h>

#include <string>

#include "support/input_error.h"
#include "support/yaml_problem.h"

namespace gainsmith::bind {
namespace {

using tests::input_error;
using tests::YamlProblem;

/// The method stands inline: with the name of its problem that is line 2 to 10.
const std::string kWithFunctions = R"(problem: p
method:
  method: m
  data:
    low: n
    f: {shape: n, of: {x: n, u: scalar}}
    h: {shape: p, of: {x: n}, default: 2*x}
    R: symmetric p
  unknowns: {P: symmetric n, Y: n x p}
  require: {decay: {forall: "x in [low, 1]", that: "He(P*jacobian(f(x, 3), x) - Y*jacobian(h(x), x)) < -R(1, 1)*I"}, positive: P > I}
data:
)";

std::string message(const std::string& data) {
  return input_error([&] { YamlProblem{kWithFunctions + data}; }).what();
}

void expect_message(const std::string& data, const std::string& part) {
  EXPECT_NE(message(data).find(part), std::string::npos) << message(data);
}

TEST(FunctionData, AreCalledAndTellDimensions) {
  const YamlProblem problem(kWithFunctions +
                            "  low: [-1, -2]\n  f(z, v): \"[z(2)*v*a; -z(1)^3]\"\n" +
                            "  h(x): x(1)^2\n  R: 4\nlet: {a: 5}\n");
  const model::Design& design = *problem.instance.design;
  EXPECT_EQ(design.dimensions.at("p"), 1);
  ASSERT_EQ(design.inequalities.front().domain.size(), 2U);
  EXPECT_EQ(design.inequalities.front().domain[1].name, "x_2");
  // At x = (2, 3) with P = I and Y = 0: He of the jacobian [0, 15; -12, 0], and R(1, 1) = 4.
  numbers::Values values = problem.instance.values;
  values["P"] = numbers::Matrix::Identity(2, 2);
  values["Y"] = numbers::Matrix::Zero(2, 1);
  values["x_1"] = numbers::Matrix::Constant(1, 1, 2);
  values["x_2"] = numbers::Matrix::Constant(1, 1, 3);
  const numbers::Matrix found =
      numbers::evaluate(design.inequalities.front().comparisons.front().difference, values);
  numbers::Matrix expected(2, 2);
  expected << -4, -3, -3, -4;
  EXPECT_TRUE(found.isApprox(expected) || found.isApprox(-expected)) << found;
}

TEST(FunctionData, HaveDefaults) {
  const YamlProblem problem(kWithFunctions + "  low: [-1, -2, 0]\n  f(x, u): u*x\n  R: I\n");
  EXPECT_EQ(problem.instance.design->dimensions.at("p"), 3);
}

TEST(FunctionData, ArgumentsAtTheEndMayBeLeftOut) {
  const std::string low = kWithFunctions + "  low: [-1, -2, 0]\n  R: I\n";
  const YamlProblem problem(low + "  f(v): 2*v\n");
  EXPECT_EQ(problem.instance.design->dimensions.at("n"), 3);
  // A name that is left out is none in the text.
  expect_message("  low: [-1, -2]\n  R: I\n  f(v): u*v\n", "unknown name 'u'");
}

TEST(FunctionData, WhatDoesNotFitIsSaid) {
  const std::string low = "  low: [-1, -2]\n  R: I\n";
  expect_message(low,
                 "the datum f(x, u) (n; x: n; u: scalar) of the method m is missing under 'data'");
  expect_message(low + "  f: 2\n",
                 "test.yaml:14:3: the datum f(x, u) (n; x: n; u: scalar) is a function");
  expect_message(low + "  f(x, u, v): x\n", "test.yaml:14:3: f has 2 arguments: f(x, u)");
  expect_message(low + "  f(x, u): \"[x; 1]\"\n",
                 "test.yaml:14:13: [x; 1] (3 x 1) has the wrong shape: expected 2 x 1");
  expect_message(low + "  f(x, u): A*x\n", "unknown name 'A'");
  expect_message(low + "  g(x): x\n  f(x, u): x\n", "the method m has no datum 'g'");
  expect_message("  low(x): x\n  f(x, u): x\n", "the datum low is declared n; found a function");
  expect_message(low + "  f(x, u): x\nlet: {Y: 2}\n",
                 "'Y' already has a meaning: it is an unknown of the method m");
  expect_message(low + "  f(x, u): x\nlet: {f(x): x}\n",
                 "'f' already has a meaning: it is a datum");
}

TEST(Box, EndsAreNumbersOrColumnsOfOneLength) {
  const auto ends = [](const std::string& text) {
    return "problem: p\nmethod:\n  method: m\n  unknowns: {g: scalar}\n  require: {a: {forall: \"x "
           "in " +
           text + "\", that: \"g > sum(x)\"}}\n";
  };
  const auto elements = [&](const std::string& text) {
    return YamlProblem(ends(text)).instance.design->inequalities.front().domain.size();
  };
  EXPECT_EQ(elements("[-1, [1; 2; 3]]"), 3U);
  EXPECT_EQ(elements("[-[1; 2], [1; 2]]"), 2U);
  EXPECT_EQ(elements("[zeros(0, 1), zeros(0, 1)]"), 0U);
  for (const std::string text : {"[[1; 2], [1; 2; 3]]", "[[1, 2], [3, 4]]", "[0, eye(2)]"}) {
    const std::string found = input_error([&] { YamlProblem{ends(text)}; }).what();
    EXPECT_NE(found.find("the ends of x are numbers, or columns of one length"), std::string::npos)
        << found;
  }
}

}  // namespace
}  // namespace gainsmith::bind
