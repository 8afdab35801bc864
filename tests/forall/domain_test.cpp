#include "forall/domain.h"

#include <gtest/gtest.h>

#include "forall/variables.h"
#include "support/input_error.h"
#include "support/yaml_problem.h"

namespace gainsmith::forall {
namespace {

using Over = model::Over;

tests::YamlProblem problem_with(const std::string& forall, const std::string& that = "P > 0") {
  return tests::YamlProblem(
      "problem: p\nmethod:\n  method: m\n  data: {A: n x n, T: scalar}\n"
      "  unknowns: {P: symmetric n}\n  require:\n    all:\n      forall: " +
      forall + "\n      that: \"" + that + "\"\ndata: {A: [[0, 1], [-2, -3]], T: 2}\n");
}

Domain domain_with(const std::string& forall) {
  const tests::YamlProblem yaml = problem_with(forall);
  return domain_of(yaml.instance.design->inequalities.front(), yaml.instance.values);
}

TEST(DomainTest, EndsAndElementsAreExpressionsInTheData) {
  const Domain domain =
      domain_with("[\"tau in [T/4, exp(T)]\", \"k in {T, 2*T + 1}\", \"B in conv{A, A'}\"]");
  ASSERT_EQ(domain.size(), 3U);
  EXPECT_TRUE(domain[0].is_interval());
  EXPECT_EQ(domain[0].low, 0.5);
  EXPECT_EQ(domain[0].high, std::exp(2.0));
  EXPECT_EQ(domain[1].over, Over::set);
  EXPECT_EQ(domain[1].elements.at(1)(0, 0), 5);
  EXPECT_EQ(domain[1].labels, (std::vector<std::string>{"k = 2", "k = 5"}));
  EXPECT_EQ(domain[2].over, Over::polytope);
  EXPECT_EQ(domain[2].shape, (expr::Shape{2, 2}));
  EXPECT_EQ(domain[2].elements.at(1)(0, 1), -2);
  EXPECT_EQ(domain[2].labels, (std::vector<std::string>{"B = A", "B = A'"}));
}

TEST(DomainTest, AnIntervalMayBeOnePointButNotEmpty) {
  EXPECT_EQ(domain_with("tau in [T, 2]")[0].high, 2);
  const InputError error = tests::input_error([] { domain_with("tau in [T, 1.5]"); });
  EXPECT_EQ(error.place().line, 8);
  EXPECT_NE(error.message().find("[2, 1.5] is empty"), std::string::npos) << error.message();
}

TEST(DomainTest, EndsAndElementsAreFinite) {
  for (const char* forall : {"tau in [0, exp(1000*T)]", "k in {1, 1/(T - 2)}"}) {
    const InputError error = tests::input_error([&] { domain_with(forall); });
    EXPECT_EQ(error.place().line, 8) << error.what();
  }
}

TEST(DomainTest, ElementsHaveOneShape) {
  const InputError error = tests::input_error([] { domain_with("\"B in conv{A, A(1, :)}\""); });
  EXPECT_EQ(error.place().line, 8);
  EXPECT_NE(error.message().find("found 2 x 2 and 1 x 2"), std::string::npos) << error.message();
}

TEST(DomainTest, AnInequalityKnowsItsVariablesAndTheirShapes) {
  const tests::YamlProblem yaml =
      problem_with("[\"tau in [0, T]\", \"B in conv{A, A'}\"]", "He(tau*B*P) > 0");
  const expr::Program& program =
      yaml.instance.design->inequalities.front().comparisons.at(0).difference;
  EXPECT_EQ(program.shape(), (expr::Shape{2, 2}));
  const std::vector<std::pair<std::string, expr::Shape>> expected = {{"tau", {1, 1}},
                                                                     {"B", {2, 2}}};
  for (const auto& [name, shape] : expected) {
    ASSERT_TRUE(program.uses(name)) << name;
    EXPECT_EQ(program.inputs[static_cast<std::size_t>(program.input(name))].shape, shape);
  }
}

TEST(DomainTest, CombinationsTakeEveryElementOfTheOneKind) {
  const Domain domain = {testing::set("k", {testing::number(1), testing::number(2)}),
                         testing::interval("tau", 0, 1),
                         testing::polytope("A", {testing::number(5), testing::number(6)}),
                         testing::set("l", {testing::number(7), testing::number(8)})};
  const auto sets = combinations(domain, Over::set);
  ASSERT_EQ(sets.size(), 4U);
  EXPECT_EQ(sets[0].label, "k = 1, l = 1");
  EXPECT_EQ(sets[1].label, "k = 1, l = 2");
  EXPECT_EQ(sets[3].label, "k = 2, l = 2");
  EXPECT_EQ(sets[1].values.at("k")(0, 0), 1);
  EXPECT_EQ(sets[1].values.at("l")(0, 0), 8);
  EXPECT_EQ(sets[1].values.size(), 2U);
  EXPECT_EQ(combinations(domain, Over::polytope).size(), 2U);
  const auto none = combinations({testing::interval("tau", 0, 1)}, Over::set);
  ASSERT_EQ(none.size(), 1U);
  EXPECT_TRUE(none[0].values.empty());
  EXPECT_EQ(none[0].label, "");
}

TEST(DomainTest, IntervalsKeepTheirOrder) {
  const Domain domain = {testing::interval("b", 0, 1), testing::set("k", {testing::number(1)}),
                         testing::interval("a", 2, 3)};
  const auto axes = intervals(domain);
  ASSERT_EQ(axes.size(), 2U);
  EXPECT_EQ(axes[0], &domain[0]);
  EXPECT_EQ(axes[1], &domain[2]);
}

TEST(DomainTest, APointWithOneMoreVariable) {
  const Point first = extended({}, "tau", 0.7);
  EXPECT_EQ(first.label, "tau = 0.7");
  const Point second = extended(first, "B", numbers::Matrix::Identity(2, 2), "B = I");
  EXPECT_EQ(second.label, "tau = 0.7, B = I");
  EXPECT_EQ(first.values.size(), 1U);
  EXPECT_EQ(extended(second, "tau", 0.9).values.at("tau")(0, 0), 0.9);
}

TEST(DomainTest, AFreeVariableHasItsNameOnly) {
  EXPECT_TRUE(free_variable("").empty());
  const Domain domain = free_variable("s");
  ASSERT_EQ(domain.size(), 1U);
  EXPECT_EQ(domain[0].name, "s");
  EXPECT_TRUE(domain[0].is_interval());
}

}  // namespace
}  // namespace gainsmith::forall
