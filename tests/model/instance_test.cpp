#include "model/instance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "expr/compile.h"
#include "expr/parser.h"
#include "model/small_problem.h"

namespace gainsmith::model {
namespace {

using Shapes = std::vector<std::pair<std::string, expr::Shape>>;

TEST(Instance, FindsDimensionsDataAndParameters) {
  const Small small;
  const Instance& instance = small.instance;
  EXPECT_EQ(instance.dimensions, (Dimensions{{"n", 2}, {"m", 1}}));
  EXPECT_EQ(instance.data.at("A"), (numbers::Matrix{{1, 2}, {3, 4}}));
  EXPECT_EQ(instance.data.at("T1")(0, 0), 0.5);
  EXPECT_EQ(instance.data.at("T2")(0, 0), 1.0) << "a default may use the data before it";
  EXPECT_EQ(instance.data.at("Q"), (numbers::Matrix{{2, 0}, {0, 2}}));
  EXPECT_EQ(instance.parameters.at("delta")(0, 0), 0.5 / 10);
  EXPECT_EQ(instance.parameters.at("rate")(0, 0), 1);
  EXPECT_EQ(instance.known_values().size(), instance.data.size() + 2);
}

TEST(Instance, AnOverrideReplacesAScalarAndWhatFollowsFromIt) {
  const Small small;
  const Instance instance = make_instance(*small.problem, {{"T1", 2.0}, {"rate", 7.0}});
  EXPECT_EQ(instance.data.at("T1")(0, 0), 2.0);
  EXPECT_EQ(instance.data.at("T2")(0, 0), 4.0) << "its default is 2*T1";
  EXPECT_EQ(instance.parameters.at("delta")(0, 0), 2.0 / 10) << "its default is T1/10";
  EXPECT_EQ(instance.parameters.at("rate")(0, 0), 7.0);
  EXPECT_EQ(instance.data.at("A"), small.instance.data.at("A"));
  EXPECT_EQ(instance.overrides, (Overrides{{"T1", 2.0}, {"rate", 7.0}}));
}

TEST(Instance, AnOverrideMayGiveADatumThatTheProblemLeavesOut) {
  const io::MethodLibrary library{[](const std::string&) { return kSmallMethod; }, {"small"}};
  const Problem problem =
      io::parse_problem(changed(kSmallProblem, "  T1: 0.5\n", ""), "p.yaml", library);
  EXPECT_THROW(make_instance(problem), InputError);
  EXPECT_EQ(make_instance(problem, {{"T1", 0.25}}).data.at("T1")(0, 0), 0.25);
}

TEST(Instance, AFlatListIsAColumnWhereAColumnIsDeclared) {
  EXPECT_EQ(Small().instance.data.at("b"), (numbers::Matrix{{5}, {6}}));
  const Small upright(changed(kSmallProblem, "b: [5, 6]", "b: [[5], [6]]"));
  EXPECT_EQ(upright.instance.data.at("b"), (numbers::Matrix{{5}, {6}}));
}

TEST(Instance, KnowsTheShapesOfUnknownsStatesAndGains) {
  const Small small;
  EXPECT_EQ(small.instance.unknowns,
            (std::vector<UnknownMatrix>{{"P", {2, 2}, Structure::symmetric},
                                        {"X", {2, 1}, Structure::full},
                                        {"g", {1, 1}, Structure::scalar}}));
  EXPECT_EQ(small.instance.states, (Shapes{{"z", {2, 1}}, {"zh", {2, 1}}, {"th", {1, 1}}}));
  EXPECT_EQ(gain_shapes(small.instance), (Shapes{{"K", {1, 2}}, {"A", {2, 2}}}));
}

TEST(Instance, AMatrixSymmetricToRoundingIsMadeExactlySo) {
  const Small small(
      changed(kSmallProblem, "  T1:", "  Q: [[1, 0.30000000000000004], [0.3, 1]]\n  T1:"));
  const numbers::Matrix& Q = small.instance.data.at("Q");
  EXPECT_EQ(Q(0, 1), Q(1, 0));
  EXPECT_NEAR(Q(0, 1), 0.3, 1e-15);
}

TEST(Instance, IdentityAndZeroTakeTheDeclaredSize) {
  const Small small(changed(kSmallProblem, "  T1:", "  Q: 0\n  D: -3*I\n  T1:"));
  EXPECT_EQ(small.instance.data.at("Q"), numbers::Matrix::Zero(2, 2));
  EXPECT_EQ(small.instance.data.at("D"), -3 * numbers::Matrix::Identity(2, 2));
}

TEST(Instance, ItsScopesHoldWhatEachPartMayUse) {
  const Small small;
  const auto design = small.instance.design_scope();
  EXPECT_TRUE(design.symbols.contains("P"));
  EXPECT_FALSE(design.symbols.at("P").value);
  EXPECT_TRUE(design.symbols.at("A").value);
  EXPECT_FALSE(design.symbols.contains("z"));
  const auto simulation = small.instance.simulation_scope();
  for (const char* name : {"P", "K", "z", "zh", "th", "s"})
    EXPECT_TRUE(simulation.symbols.contains(name)) << name;
  EXPECT_TRUE(simulation.symbols.at("A").value) << "a gain that is a datum keeps its value";
}

TEST(Instance, DefinitionsOutputsAndSignalsEvaluate) {
  const Small small;
  numbers::Values values = small.instance.known_values();
  values["z"] = numbers::Matrix{{1}, {2}};
  values["zh"] = numbers::Matrix{{3}, {5}};
  const auto scope = small.instance.simulation_scope();
  const auto value = [&](const std::string& text) {
    return scalar_value(expr::parse({text, "t"}), scope, values);
  };
  EXPECT_EQ(value("y"), 5 * 1 + 6 * 2);
  EXPECT_EQ(value("e(2)"), 2 - 5);
  EXPECT_DOUBLE_EQ(value("f(2)"), std::exp(0.05 * 2));
}

}  // namespace
}  // namespace gainsmith::model
