#include "forall/monomials.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "expr/program/evaluate.h"
#include "forall/random_atom.h"
#include "forall/variables.h"

namespace gainsmith::forall {
namespace {

using testing::random_atom;

/// Two intervals and a polytope with three vertices: two weights.
Domain three_variables() {
  return {testing::interval("s", -1, 1), testing::interval("t", 0, 2),
          testing::polytope("A", {testing::number(1), testing::number(2), testing::number(4)})};
}

/// Values of the variables: s, t and the weights of the polytope.
struct Values {
  double s = 0;
  double t = 0;
  double weights[3] = {0, 0, 0};
};

double evaluate(const Monomial& monomial, const Values& at) {
  double value = 1;
  for (const Factor& factor : monomial)
    value *= factor.weight > 0 ? at.weights[factor.weight]
                               : evaluate(factor.atom, factor.variable == 0 ? at.s : at.t);
  return value;
}

double evaluate(const Combination& combination, const MonomialTable& table, const Values& at) {
  double sum = 0;
  for (const auto& [coefficient, index] : combination)
    sum += coefficient * evaluate(table[index], at);
  return sum;
}

TEST(MonomialsTest, TheConstantComesFirst) {
  MonomialTable table(three_variables());
  ASSERT_EQ(table.size(), 1);
  EXPECT_TRUE(table[0].empty());
  EXPECT_EQ(table.index(0, Atom{}), 0);
  EXPECT_EQ(table.index(Monomial{}), 0);
  EXPECT_EQ(table.size(), 1);
}

TEST(MonomialsTest, AMonomialStandsInTheTableOnce) {
  MonomialTable table(three_variables());
  const Atom wave{0, 0, 2, true};
  const int first = table.index(0, wave);
  EXPECT_NE(table.index(1, wave), first);
  EXPECT_NE(table.index_of_weight(2, 1), table.index_of_weight(2, 2));
  EXPECT_EQ(table.index(0, wave), first);
  EXPECT_EQ(table.size(), 5);
}

TEST(MonomialsTest, VariablesAreFoundByTheirNames) {
  const MonomialTable table(three_variables());
  EXPECT_EQ(table.find_variable("t"), 1);
  EXPECT_EQ(table.find_variable("A"), 2);
  EXPECT_EQ(table.find_variable("tau"), -1);
}

/// Products of monomials in two intervals and a weight, again multiplied by others, at random
/// points of the domain.
TEST(MonomialsTest, ProductsHaveTheProductOfTheValues) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 200; ++trial) {
    MonomialTable table(three_variables());
    const auto random_monomial = [&](bool with_weight) {
      int index = table.index(0, random_atom(generator));
      index = table.product(index, table.index(1, random_atom(generator))).front().second;
      if (!with_weight) return index;
      return table.product(index, table.index_of_weight(2, 1 + trial % 2)).front().second;
    };
    const int a = random_monomial(true);
    const int b = random_monomial(false);
    const Combination ab = table.product(a, b);
    const Combination ba = table.product(b, a);
    for (int point = 0; point < 3; ++point) {
      Values at{2 * unit(generator) - 1, 2 * unit(generator), {0, unit(generator), 0}};
      at.weights[2] = (1 - at.weights[1]) * unit(generator);
      const double expected = evaluate(table[a], at) * evaluate(table[b], at);
      const double tolerance = 1e-11 * (1 + std::abs(expected));
      EXPECT_NEAR(evaluate(ab, table, at), expected, tolerance);
      EXPECT_NEAR(evaluate(ba, table, at), expected, tolerance);
    }
  }
}

TEST(MonomialsTest, FactorsStandInTheOrderOfTheVariables) {
  MonomialTable table(three_variables());
  const int s = table.index(0, {1, 0, 0, false});
  const int t = table.index(1, {1, 0, 0, false});
  const Combination ts = table.product(t, s);
  ASSERT_EQ(ts.size(), 1U);
  ASSERT_EQ(table[ts[0].second].size(), 2U);
  EXPECT_EQ(table[ts[0].second][0].variable, 0);
  EXPECT_EQ(table.product(s, t), ts);
}

TEST(MonomialsTest, FunctionsThatCancelLeaveTheConstant) {
  MonomialTable table(three_variables());
  const Combination one =
      table.product(table.index(0, {0, 1.5, 0, false}), table.index(0, {0, -1.5, 0, false}));
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one[0], (std::pair<double, int>{1.0, 0}));
}

TEST(MonomialsTest, AProductOfTwoElementsOfAPolytopeIsNotAffine) {
  MonomialTable table(three_variables());
  const int weight = table.index_of_weight(2, 1);
  try {
    table.product(weight, table.index_of_weight(2, 2));
    FAIL() << "expected an EvaluationError";
  } catch (const expr::EvaluationError& error) {
    EXPECT_NE(std::string(error.what()).find("not affine in A"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace gainsmith::forall
