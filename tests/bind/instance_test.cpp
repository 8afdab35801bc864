#include "model/instance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "bind/binding.h"
#include "bind/instance.h"
#include "bind/small_problem.h"
#include "expr/binding/compile.h"
#include "expr/text/parser.h"
#include "support/input_error.h"

namespace gainsmith::bind {
namespace {

using Shapes = std::vector<std::pair<std::string, expr::Shape>>;

template <class Item>
Shapes shapes_of(const std::vector<Item>& items) {
  Shapes shapes;
  for (const Item& item : items) shapes.emplace_back(item.name, item.shape);
  return shapes;
}

using Inputs = std::set<std::string>;

Inputs inputs_of(const expr::Program& program) {
  Inputs names;
  for (const expr::Input& input : program.inputs) names.insert(input.name);
  return names;
}

TEST(Instance, FindsDimensionsDataAndParameters) {
  const Small small;
  const model::Instance& instance = small.instance;
  EXPECT_EQ(small.design().dimensions, (model::Dimensions{{"n", 2}, {"m", 1}}));
  EXPECT_EQ(instance.values.at("A"), (numbers::Matrix{{1, 2}, {3, 4}}));
  EXPECT_EQ(instance.values.at("T1")(0, 0), 0.5);
  EXPECT_EQ(instance.values.at("T2")(0, 0), 1.0) << "a default may use the data before it";
  EXPECT_EQ(instance.values.at("Q"), (numbers::Matrix{{2, 0}, {0, 2}}));
  EXPECT_EQ(instance.values.at("delta")(0, 0), 0.5 / 10);
  EXPECT_EQ(instance.values.at("rate")(0, 0), 1);
  EXPECT_EQ(small.design().data.size(), small.problem->method->data.size());
  EXPECT_EQ(small.design().parameters.size(), 2U);
  EXPECT_EQ(instance.values.size(), small.design().data.size() + 2);
}

TEST(Instance, AnOverrideReplacesAScalarAndWhatFollowsFromIt) {
  const Small small;
  const model::Instance instance = bind(small.problem, {{"T1", 2.0}, {"rate", 7.0}});
  EXPECT_EQ(instance.values.at("T1")(0, 0), 2.0);
  EXPECT_EQ(instance.values.at("T2")(0, 0), 4.0) << "its default is 2*T1";
  EXPECT_EQ(instance.values.at("delta")(0, 0), 2.0 / 10) << "its default is T1/10";
  EXPECT_EQ(instance.values.at("rate")(0, 0), 7.0);
  EXPECT_EQ(instance.values.at("A"), small.instance.values.at("A"));
  EXPECT_EQ(instance.overrides, (model::Overrides{{"T1", 2.0}, {"rate", 7.0}}));
}

TEST(Instance, AnOverrideMayGiveADatumThatTheProblemLeavesOut) {
  const model::Problem problem = small_problem(changed(kSmallProblem, "  T1: 0.5\n", ""));
  const InputError missing = tests::input_error([&] { bind(problem); });
  const model::Instance instance = bind(problem, {{"T1", 0.25}});
  EXPECT_EQ(instance.values.at("T1")(0, 0), 0.25);
  const InputError again = tests::input_error([&] { evaluate(instance.design); });
  EXPECT_STREQ(again.what(), missing.what());
}

TEST(Instance, AFlatListIsAColumnWhereAColumnIsDeclared) {
  EXPECT_EQ(Small().instance.values.at("b"), (numbers::Matrix{{5}, {6}}));
  const Small upright(changed(kSmallProblem, "b: [5, 6]", "b: [[5], [6]]"));
  EXPECT_EQ(upright.instance.values.at("b"), (numbers::Matrix{{5}, {6}}));
}

TEST(Instance, KnowsTheShapesOfUnknownsStatesAndGains) {
  const Small small;
  EXPECT_EQ(unknown_matrices(small.design(), polynomials(small.design())),
            (std::vector<model::UnknownMatrix>{{"P", {2, 2}, model::Structure::symmetric},
                                               {"X", {2, 1}, model::Structure::full},
                                               {"g", {1, 1}, model::Structure::scalar}}));
  EXPECT_EQ(shapes_of(small.design().states),
            (Shapes{{"z", {2, 1}}, {"observer.zh", {2, 1}}, {"observer.th", {1, 1}}}));
  EXPECT_EQ(shapes_of(small.design().gains), (Shapes{{"K", {1, 2}}, {"A", {2, 2}}}));
}

TEST(Instance, AMatrixSymmetricToRoundingIsMadeExactlySo) {
  const Small small(
      changed(kSmallProblem, "  T1:", "  Q: [[1, 0.30000000000000004], [0.3, 1]]\n  T1:"));
  const numbers::Matrix& Q = small.instance.values.at("Q");
  EXPECT_EQ(Q(0, 1), Q(1, 0));
  EXPECT_NEAR(Q(0, 1), 0.3, 1e-15);
}

TEST(Instance, IdentityAndZeroTakeTheDeclaredSize) {
  const Small small(changed(kSmallProblem, "  T1:", "  Q: 0\n  D: -3*I\n  T1:"));
  EXPECT_EQ(small.instance.values.at("Q"), numbers::Matrix::Zero(2, 2));
  EXPECT_EQ(small.instance.values.at("D"), -3 * numbers::Matrix::Identity(2, 2));
}

/// What stands behind definitions and outputs is an input: data, unknowns, gains, states, the
/// timer.
TEST(Instance, ProgramsTakeWhatTheyUseAsInputs) {
  const Small small;
  const model::Design& design = small.design();
  ASSERT_EQ(design.inequalities.size(), 1U);
  EXPECT_EQ(inputs_of(design.inequalities[0].comparisons.at(0).difference),
            (Inputs{"P", "A", "Q", "g", "delta", "tau"}));
  EXPECT_EQ(inputs_of(design.objective->program), Inputs{"g"});
  EXPECT_EQ(inputs_of(design.gains[0].formula.program), (Inputs{"b", "P"}));
  const model::Dynamics& dynamics = *design.dynamics;
  ASSERT_EQ(dynamics.flow.size(), 2U);
  EXPECT_EQ(inputs_of(dynamics.flow[1].value.program), (Inputs{"K", "observer.zh"}));
  EXPECT_EQ(dynamics.variables[dynamics.flow[1].variable].name, "observer.th");
  EXPECT_EQ(inputs_of(design.claims[0].value.program), (Inputs{"P", "z", "observer.zh", "s"}));
  EXPECT_EQ(inputs_of(design.claims[1].flow_cost->program), (Inputs{"b", "z"}));
  EXPECT_EQ(inputs_of(design.campaign.horizon->program), Inputs{"T2"});
  EXPECT_EQ(inputs_of(design.expect->values[0].what.program), Inputs{"objective"});
  EXPECT_EQ(inputs_of(design.data[5].value->program), Inputs{"T1"}) << "T2: 2*T1";
}

TEST(Instance, EachPartMayUseWhatItsScopeHolds) {
  const Small small;
  const bind::Names& names = *small.design().names;
  const std::vector<std::pair<std::string, int>> first = {
      {"A", 0}, {"delta", 0},       {"P", 1}, {"g", 1},        {"K", 2},
      {"z", 2}, {"observer.th", 2}, {"s", 2}, {"objective", 3}};
  const expr::Scope* scopes[] = {&names.known, &names.design, &names.running};
  for (const auto& [name, from] : first)
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(scopes[k]->symbols.contains(name), k >= from) << name << " in scope " << k;
  for (const std::string name : {"A", "P", "K", "objective"})
    EXPECT_TRUE(names.results.symbols.contains(name)) << name;
  EXPECT_FALSE(names.results.symbols.contains("z")) << "of runs";
  EXPECT_TRUE(names.running.symbols.at("A").known) << "a gain that is a datum keeps its value";
  EXPECT_FALSE(names.design.symbols.at("P").known);
}

TEST(Instance, DefinitionsOutputsAndSignalsEvaluate) {
  const Small small;
  numbers::Values values = small.instance.values;
  values["z"] = numbers::Matrix{{1}, {2}};
  values["observer.zh"] = numbers::Matrix{{3}, {5}};
  const auto value = [&](const std::string& text) {
    const auto program =
        expr::compile(expr::parse({text, "t"}), small.design().names->running, expr::Shape{});
    return numbers::evaluate(program, values)(0, 0);
  };
  EXPECT_EQ(value("y"), 5 * 1 + 6 * 2);
  EXPECT_EQ(value("observer.e(2)"), 2 - 5);
  EXPECT_DOUBLE_EQ(value("f(2)"), std::exp(0.05 * 2));
  const auto& signals = small.design().dynamics->signals;
  EXPECT_EQ(numbers::evaluate(signals.back().value.program, values), (numbers::Matrix{{-2}, {-3}}));
}

}  // namespace
}  // namespace gainsmith::bind
