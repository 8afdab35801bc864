// Parts of programs that others stand for: replaced, recognised, turned around.
#include "expr/binding/substitute.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "expr/world.h"

namespace gainsmith::expr {
namespace {

class Substitution : public testing::Test {
 protected:
  Substitution() {
    std::mt19937 random(5);
    for (const char* name : {"A", "P", "Y", "L", "Q"}) world.set(name, random_matrix(random, 2, 2));
    world.set("C", random_matrix(random, 1, 2));
    world.set("x", random_matrix(random, 2, 1));
    world.set("w", 0.3);
    world.set("t", 0.4);
    world.scope.functions = {{"Z", {2, 2}}};
  }

  Program compile(const std::string& text) const {
    return expr::compile(parse({text, "test"}), world.scope);
  }
  numbers::Matrix value(const Program& program) const { return evaluate(program, world.values); }
  void expect_near(const Program& found, const std::string& expected) const {
    const numbers::Matrix difference = value(found) - value(compile(expected));
    EXPECT_LE(difference.cwiseAbs().maxCoeff(), 1e-12) << expected;
  }

  World world;
};

TEST_F(Substitution, InputsAndFunctionsBecomePrograms) {
  Replacements given;
  given.inputs.emplace("Y", compile("P*L"));
  expect_near(substitute(compile("A*Y - Y'*Q"), given), "A*(P*L) - (P*L)'*Q");
  Replacements function;
  function.functions.emplace("Z", Body{"t", compile("P + t*Q")});
  expect_near(substitute(compile("Z(2*w)*A"), function), "(P + 2*w*Q)*A");
}

TEST_F(Substitution, OtherCallsStay) {
  Replacements given;
  given.inputs.emplace("Y", compile("P*L"));
  const Program program = substitute(compile("Z(t) + Y"), given);
  ASSERT_EQ(program.functions.size(), 1U);
  EXPECT_EQ(program.functions[0].name, "Z");
}

TEST_F(Substitution, WhatStandsBesideItsInverseGoes) {
  Replacements given;
  given.inputs.emplace("Y", compile("P*L"));
  const Program program = substitute(compile("C*inv(P)*Y"), given);
  EXPECT_FALSE(program.uses("P"));
  expect_near(program, "C*L");
  Replacements all;
  all.inputs.emplace("Y", compile("P"));
  expect_near(substitute(compile("inv(P)*Y"), all), "eye(2)");
}

TEST_F(Substitution, PartsAreRead) {
  const Program program =
      with_inputs(compile("x + A*(C*x + w - C*A*x)*eye(2)*[1; 1]"), {{"y", compile("C*x + w")}});
  EXPECT_TRUE(program.uses("y"));
  EXPECT_FALSE(program.uses("w"));
  EXPECT_TRUE(program.uses("x"));
}

TEST_F(Substitution, TheLargestPartIsRead) {
  const Program program =
      with_inputs(compile("A*x*(C*x + w)"), {{"z", compile("C*x")}, {"y", compile("C*x + w")}});
  EXPECT_TRUE(program.uses("y"));
  EXPECT_FALSE(program.uses("z"));
}

/// The value at which the formula has the given one.
TEST_F(Substitution, FormulasAreTurnedAround) {
  for (const std::string formula : {"inv(P)*Y", "Y*inv(P)", "-inv(P)*Y*Q", "inv(P)*Y - A*inv(Q)*L",
                                    "A - Y", "(w*Y)'", "Y/w", "P*A + inv(Y*P)", "Y"}) {
    World at = world;
    at.set("G", value(compile(formula)));
    const auto found = isolated(compile(formula), "Y", "", "G");
    ASSERT_TRUE(found) << formula;
    const numbers::Matrix difference = evaluate(*found, at.values) - world.values.at("Y");
    EXPECT_LE(difference.cwiseAbs().maxCoeff(), 1e-11) << formula;
  }
}

TEST_F(Substitution, WhatCannotBeUndoneIsLeft) {
  for (const std::string formula : {"A*P", "Y*P*Y", "C*Y", "exp(Y)", "Y(:, 1)", "Y*x"})
    EXPECT_FALSE(isolated(compile(formula), "Y", "", "G")) << formula;
}

TEST_F(Substitution, FunctionsAreTurnedAroundWhereTheyAreCalledWithTheVariable) {
  EXPECT_TRUE(isolated(compile("inv(P)*Z(t)"), "Z", "t", "G"));
  EXPECT_FALSE(isolated(compile("inv(P)*Z(2*t)"), "Z", "t", "G"));
  EXPECT_FALSE(isolated(compile("inv(P)*Z(w)"), "Z", "t", "G"));
}

}  // namespace
}  // namespace gainsmith::expr
