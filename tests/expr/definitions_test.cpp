#include <gtest/gtest.h>

#include <random>
#include <string>

#include "expr/world.h"
#include "support/input_error.h"

namespace gainsmith::expr {
namespace {

using tests::input_error;

double scalar(const World& world, const std::string& text) { return world(text)(0, 0); }

TEST(Definitions, MayUseEachOtherInAnyOrder) {
  World world;
  world.set("x", 3).define("b", "a + 1").define("a", "2*x");
  EXPECT_EQ(scalar(world, "a*b"), 42);
}

TEST(Definitions, TakeParameters) {
  World world;
  world.set("x", 3).define("f(a, b)", "a - x*b").define("g(t)", "f(t, t)");
  EXPECT_EQ(scalar(world, "f(10, 2)"), 4);
  EXPECT_EQ(scalar(world, "g(2)"), -4);
  EXPECT_EQ(scalar(world, "f(f(1, 2), f(3, 4))"), (1 - 6) - 3 * (3 - 12));
}

TEST(Definitions, ParametersTakeMatricesAndMultiplesOfI) {
  World world;
  std::mt19937 random(1);
  const Matrix A = random_matrix(random, 2, 2);
  world.set("A", A).define("f(M, N)", "M + N");
  EXPECT_EQ(world("f(A, 2*I)"), A + 2 * Matrix::Identity(2, 2));
  EXPECT_EQ(world("f(A, A')"), A + A.transpose());
}

TEST(Definitions, AParameterHidesOtherThingsOfItsNameOnlyInside) {
  World world;
  world.set("x", 3).define("f(x)", "10*x").define("y", "f(5) + x");
  EXPECT_EQ(scalar(world, "f(2) + x"), 23);
  EXPECT_EQ(scalar(world, "y"), 53);
}

TEST(Definitions, DoNotSeeTheParametersOfTheirCaller) {
  World world;
  world.define("inner", "secret + 1").define("outer(secret)", "inner");
  EXPECT_NE(input_error([&] { world("outer(1)"); }).message().find("unknown name 'secret'"),
            std::string::npos);
}

TEST(Definitions, CyclesAreNamed) {
  World world;
  world.define("a", "b + 1").define("b", "2*a").define("f(x)", "f(x - 1)").define("c", "c");
  EXPECT_EQ(input_error([&] { world("a"); }).message(), "'a' is defined by itself");
  EXPECT_EQ(input_error([&] { world("f(3)"); }).message(), "'f' is defined by itself");
  EXPECT_EQ(input_error([&] { world("c"); }).message(), "'c' is defined by itself");
}

TEST(Definitions, AWrongNumberOfArgumentsIsRefused) {
  World world;
  world.define("f(a, b)", "a + b");
  EXPECT_NE(input_error([&] { world("f(1)"); }).message().find("takes 2 arguments, not 1"),
            std::string::npos);
  EXPECT_NE(input_error([&] { world("f"); }).message().find("takes 2 arguments, not 0"),
            std::string::npos);
}

TEST(Definitions, AMistakeInsideIsShownInsideTheDefinition) {
  World world;
  world.define("f(a)", "a + unknwon").set("unknown", 1);
  const InputError error = input_error([&] { world("1 + f(2)"); });
  EXPECT_EQ(error.place(), (Place{"let", 1, 5}));
  EXPECT_NE(error.message().find("did you mean 'unknown'?"), std::string::npos) << error.what();
}

TEST(Definitions, EqualPartsAreComputedOnce) {
  World world;
  world.set("x", 3).define("f(t)", "exp(t)*x");
  const Program program = compile(parse({"f(x + 1) + f(x + 1)*f(1 + x)", "t"}), world.scope);
  int exponentials = 0;
  for (const Instruction& instruction : program.code) exponentials += instruction.op == Op::exp;
  EXPECT_EQ(exponentials, 2);  // of x + 1 and of 1 + x
}

TEST(Definitions, AProgramListsOnlyTheInputsThatItUses) {
  World world;
  world.set("x", 3).set("y", 4).set("z", 5).define("f(t)", "z + 0*t");
  const Program program = compile(parse({"x + 1", "t"}), world.scope);
  ASSERT_EQ(program.inputs.size(), 1U);
  EXPECT_TRUE(program.uses("x"));
  EXPECT_FALSE(program.uses("y"));
  EXPECT_EQ(program.shape(), Shape{});
}

TEST(Definitions, TowersOfThemEndInAMessageNotInAnOverflowOrAnEndlessLoop) {
  World wide;
  World tall;
  wide.define("f0(x)", "x");
  tall.define("g0", "1");
  for (int i = 1; i <= 60; ++i) {
    const std::string before = "f" + std::to_string(i - 1);
    wide.define("f" + std::to_string(i) + "(x)", before + "(x) + " + before + "(x + 1)");
  }
  for (int i = 1; i <= 20000; ++i)
    tall.define("g" + std::to_string(i), "1 + g" + std::to_string(i - 1));
  EXPECT_NE(input_error([&] { wide("f60(1)"); }).message().find("too many"), std::string::npos);
  EXPECT_NE(input_error([&] { tall("g20000"); }).message().find("too deeply"), std::string::npos);
}

TEST(Definitions, NestedCallsAreBoundOnce) {
  World world;
  std::string text = "x";
  for (int i = 0; i < 44; ++i) text = "He(inv(" + text + "))";
  world.set("x", Matrix::Identity(2, 2));
  EXPECT_EQ(world(text), Matrix::Identity(2, 2));  // inv(2 I) = I/2, twice that is I
}

}  // namespace
}  // namespace gainsmith::expr
