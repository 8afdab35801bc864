// Programs from programs: calls that are replaced, sums of terms, slack.
#include "expr/program/rewrite.h"

#include <gtest/gtest.h>

#include <map>
#include <stdexcept>
#include <string>

#include "expr/world.h"
#include "support/input_error.h"

namespace gainsmith::expr {
namespace {

using tests::input_error;

class Rewriting : public testing::Test {
 protected:
  Rewriting() {
    std::mt19937 random(3);
    for (const char* name : {"A", "P0", "P1"}) world.set(name, random_matrix(random, 2, 2));
    world.set("t", 0.4);
    world.scope.functions = {{"Y", {2, 2}}, {"f", {}}};
    bodies["Y"] = body("P0 + s*P1");
    bodies["f"] = body("s^2 - 1");
  }

  Body body(const std::string& text) const {
    Scope scope = world.scope;
    scope.symbols["s"] = {};
    return {"s", expr::compile(parse({text, "body"}), scope)};
  }
  Program compile(const std::string& text) const {
    return expr::compile(parse({text, "test"}), world.scope);
  }
  Program linked(const std::string& text) const {
    const Program program = compile(text);
    return link(program, [&](const std::string& function, const Instruction&) -> const Body& {
      return bodies.at(function);
    });
  }
  void expect_same(const std::string& called, const std::string& written_out) const {
    const Program program = linked(called);
    const Program expected = compile(written_out);
    EXPECT_TRUE(program.functions.empty());
    EXPECT_EQ(evaluate(program, world.values), evaluate(expected, world.values)) << called;
    EXPECT_EQ(program.code.size(), expected.code.size()) << called;
    EXPECT_EQ(program.shape(), expected.shape()) << called;
  }

  World world;
  std::map<std::string, Body> bodies;
};

TEST_F(Rewriting, ALinkedCallIsTheTextWrittenOut) {
  expect_same("A*Y(t)", "A*(P0 + t*P1)");
  expect_same("He(Y(2*t)) - Y(0)", "He(P0 + 2*t*P1) - (P0 + 0*P1)");
  expect_same("Y(t) + Y(t)*Y(1)", "(P0 + t*P1) + (P0 + t*P1)*(P0 + 1*P1)");
  expect_same("Y(f(t))", "P0 + (t^2 - 1)*P1");
  expect_same("A + f(trace(Y(t)))*I", "A + (trace(P0 + t*P1)^2 - 1)*I");
}

TEST_F(Rewriting, BodiesMayCall) {
  bodies["Y"] = body("P0 + f(s)*P1");
  expect_same("Y(3)", "P0 + (3^2 - 1)*P1");
}

TEST_F(Rewriting, APlaceStaysWhereItWasWritten) {
  bodies["f"] = body("  1/(s - s)");
  EXPECT_EQ(input_error([&] { evaluate(linked("A*f(t)"), world.values); }).place(),
            (Place{"body", 1, 3}));
}

TEST_F(Rewriting, CallsAreFoundWithTheirArguments) {
  const Program program = compile("Y(2*t + f(t))*A");
  const auto calls = calls_in(program);
  ASSERT_EQ(calls.size(), 2U);
  EXPECT_EQ(called_by(program, *calls[0]), "f");
  EXPECT_EQ(called_by(program, *calls[1]), "Y");
  EXPECT_EQ(evaluate(argument_of(program, *calls[0]), world.values)(0, 0), 0.4);
  const Program argument = argument_of(program, *calls[1]);
  EXPECT_EQ(calls_in(argument).size(), 1U);
  EXPECT_TRUE(argument.uses("t"));
  EXPECT_FALSE(argument.uses("A"));
}

TEST_F(Rewriting, ACallThatWasNotLinkedIsAFaultOfTheProgram) {
  EXPECT_THROW(evaluate(compile("Y(t)"), world.values), std::logic_error);
}

TEST_F(Rewriting, SumsOfTerms) {
  const Place place{"here", 2, 3};
  const Program sum =
      combination({Program{}, compile("t^2"), compile("3")}, {"A", "P0", "P1"}, {2, 2}, place);
  const Values& v = world.values;
  EXPECT_EQ(evaluate(sum, v), evaluate(compile("A + t^2*P0 + 3*P1"), v));
  EXPECT_EQ(sum.code.back().place(), place);
}

TEST_F(Rewriting, AComposedProgramIsItsText) {
  const Place place{"here", 2, 3};
  Composer compose(place);
  const int matrix =
      compose.apply(Op::scale, {compose.number("0.3"), compose.input("A", {2, 2})}, {2, 2});
  const int square = compose.program(expr::compile(parse({"t^2", "test"}), world.scope));
  const int result =
      compose.apply(Op::add, {matrix, compose.apply(Op::identity, {square}, {2, 2})}, {2, 2});
  const Program program = compose.take(result);
  EXPECT_EQ(evaluate(program, world.values), evaluate(compile("0.3*A + t^2*I"), world.values));
  EXPECT_EQ(program.code.back().place(), place);
  EXPECT_THROW(compose.apply(Op::add, {matrix, square}, {2, 2}), std::logic_error);
}

TEST_F(Rewriting, SlackIsAMultipleOfADiagonal) {
  const Program loose = with_diagonal(compile("A"), {"-2"}, "t");
  const Matrix expected = world.values["A"] - 0.8 * Matrix::Identity(2, 2);
  EXPECT_LT(relative_difference(evaluate(loose, world.values), expected), 1e-15);
  const Program rows = with_diagonal(compile("A"), {"-2", "3"}, "t");
  const Matrix looser = world.values["A"] + 0.4 * Matrix{{-2, 0}, {0, 3}};
  EXPECT_LT(relative_difference(evaluate(rows, world.values), looser), 1e-15);
}

TEST_F(Rewriting, CallsAreCheckedWhenBound) {
  const auto refused = [&](const std::string& text, int column, const std::string& part) {
    const InputError error = input_error([&] { compile(text); });
    EXPECT_EQ(error.place(), (Place{"test", 1, column})) << text << ": " << error.what();
    EXPECT_NE(error.message().find(part), std::string::npos) << text << ": " << error.what();
  };
  refused("A*Y", 3, "'Y' is a function: write Y(s)");
  refused("A*Y(1, 2)", 3, "'Y' takes 1 arguments, not 2");
  refused("Y(A)", 3, "expected 1 x 1");
  refused("[1, 2]*Y(t)*f(t) + A", 1, "cannot add");
  refused("orth(Y(t))", 6, "must not depend on 'Y'");
  refused("y(t)", 1, "did you mean 'Y'?");
}

}  // namespace
}  // namespace gainsmith::expr
