// jacobian(e, x) in texts: what x may be, which definitions are followed, what the program holds.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include "expr/binding/derivative.h"
#include "expr/world.h"
#include "support/input_error.h"

namespace gainsmith::expr {
namespace {

using tests::input_error;

class Jacobians : public testing::Test {
 protected:
  Jacobians() {
    std::mt19937 random(7);
    world.set("A", random_matrix(random, 2, 2)).set("xh", random_matrix(random, 2, 1));
    world.set("P", random_matrix(random, 2, 2)).set("s", 0.6);
    world.define("f(x)", "[x(2); -9.81*sin(x(1)) - 0.1*x(2)]");
    world.define("J(v)", "jacobian(f(v), v)");
    world.define("z", "A*xh + s").define("energy", "z'*z");
  }
  Program compile(const std::string& text) const {
    return expr::compile(parse({text, "test"}), world.scope);
  }
  void expect(const std::string& text, const std::string& value) const {
    EXPECT_LT(relative_difference(world(text), world(value)), 1e-14) << text;
  }
  static const Instruction* jacobian_in(const Program& program) {
    const auto found = std::ranges::find(program.code, Op::jacobian, &Instruction::op);
    return found == program.code.end() ? nullptr : &*found;
  }
  World world;
};

TEST_F(Jacobians, OfASymbol) {
  expect("jacobian(f(xh), xh)", "[0, 1; -9.81*cos(xh(1)), -0.1]");
  expect("He(jacobian(f(xh), xh)*P)", "He([0, 1; -9.81*cos(xh(1)), -0.1]*P)");
}

TEST_F(Jacobians, OfAParameterAtAnyValue) {
  expect("J(xh)", "[0, 1; -9.81*cos(xh(1)), -0.1]");
  expect("J(2*A*xh)", "[0, 1; -9.81*cos(2*A(1, :)*xh), -0.1]");
  expect("J([pi; 0])", "[0, 1; 9.81, -0.1]");
}

TEST_F(Jacobians, OfAParameterThatAlsoStandsElsewhere) {
  world.define("g(v)", "jacobian(v.*xh, v)").define("h(v)", "jacobian(v + 2*xh, v)");
  expect("g(xh)", "diag(xh)");
  expect("h(2*xh)", "eye(2)");
  expect("jacobian(xh.*xh, xh)", "2*diag(xh)");
}

TEST_F(Jacobians, FollowDefinitionsThatHoldTheName) {
  expect("jacobian(z, xh)", "A");
  expect("jacobian(energy, xh)", "2*z'*A");
  expect("jacobian(energy, A)", "2*kron(xh', z')");
}

TEST_F(Jacobians, OfADefinition) {
  expect("jacobian(energy, z)", "2*z'");
  expect("jacobian(energy + s*z(1), z)", "2*z' + [s, 0]");
  expect("jacobian(energy, xh)", "2*z'*A");
  expect("energy", "z'*z");
}

TEST_F(Jacobians, OfAParameterThatHidesASymbol) {
  world.define("k(s)", "jacobian(s^2*xh, s)");
  expect("k(3)", "6*xh");
}

TEST_F(Jacobians, OfOneByAnotherThatStandsStill) {
  world.define("c(v)", "jacobian(jacobian(f(xh), xh)*v, v)");
  expect("c(xh)", "J(xh)");
  EXPECT_NE(input_error([&] { world("jacobian(jacobian(energy, xh), xh)"); })
                .message()
                .find("a jacobian of a jacobian"),
            std::string::npos);
}

TEST_F(Jacobians, RowsAndColumnsRunColumnByColumn) {
  expect("jacobian(P*A, P)", "kron(A', eye(2))");
  expect("jacobian(A*P, P)", "kron(eye(2), A)");
}

TEST_F(Jacobians, TheBodyHoldsWhatDependsOnTheName) {
  const Program program = compile("jacobian(expm(A)*xh, xh)");
  const Instruction* jacobian = jacobian_in(program);
  ASSERT_NE(jacobian, nullptr);
  EXPECT_EQ(jacobian->shape, (Shape{2, 2}));
  ASSERT_EQ(jacobian->operands.size(), 2U);
  EXPECT_EQ(program.code[static_cast<std::size_t>(jacobian->operands[0])].op, Op::input);
  EXPECT_EQ(program.code[static_cast<std::size_t>(jacobian->operands[1])].op,
            Op::matrix_exponential);
  EXPECT_EQ(jacobian->body->code.size(), 3U);
  EXPECT_EQ(jacobian->body->inputs.size(), 2U);
}

TEST_F(Jacobians, OfWhatDoesNotDependIsZero) {
  const Program program = compile("jacobian(A*P, xh)");
  EXPECT_EQ(jacobian_in(program), nullptr);
  EXPECT_EQ(world("jacobian(A*P, xh)"), Matrix::Zero(4, 2));
  EXPECT_TRUE(program.inputs.empty());
}

TEST_F(Jacobians, EqualOnesAreOneInstruction) {
  const Program program = compile("jacobian(f(xh), xh)*P*jacobian(f(xh), xh)' + J(xh)");
  EXPECT_EQ(std::ranges::count(program.code, Op::jacobian, &Instruction::op), 1);
  EXPECT_TRUE(is_same(program, compile("jacobian(f(xh), xh)*P*jacobian(f(xh), xh)' + J(xh)")));
  EXPECT_FALSE(is_same(compile("jacobian(sin(xh), xh)"), compile("jacobian(cos(xh), xh)")));
}

TEST_F(Jacobians, CallsOfGivenFunctionsHaveNone) {
  world.scope.functions["F"] = {2, 2};
  world.define("k(t)", "jacobian(F(t)*xh, t)");
  EXPECT_NE(input_error([&] { compile("k(s)"); }).message().find("'F(t)' is a call"),
            std::string::npos);
  EXPECT_NE(jacobian_in(compile("jacobian(F(s)*xh, xh)")), nullptr);
}

TEST_F(Jacobians, BasesOfWhatVariesAreNotKnownBeforehand) {
  world.define("k(M)", "jacobian(orth(M), M)");
  EXPECT_NE(input_error([&] { compile("k(A)"); }).message().find("must not depend on 'M of"),
            std::string::npos);
}

/// with_derivatives(): no jacobian is left, and the value is the same.
TEST_F(Jacobians, AreFormulasWhereThereAreRules) {
  std::mt19937 random(11);
  world.set("w", random_matrix(random, 2, 1) + Matrix::Constant(2, 1, 2));
  world.set("B", random_matrix(random, 2, 2) + 3 * Matrix::Identity(2, 2));
  for (const std::string text : {"f(xh)",
                                 "P*f(xh)",
                                 "xh'*P*xh",
                                 "P(2, :)*xh",
                                 "[xh, 2*P*xh]'",
                                 "s*xh + P*xh/3",
                                 "P/(1 + xh'*xh)",
                                 "xh/xh(1)",
                                 "xh./(w + xh)",
                                 "2./(w + xh)",
                                 "xh.^3",
                                 "xh.^0 + xh.^1",
                                 "xh(1)^2*xh(2)",
                                 "(w + xh).^1.5",
                                 "inv(B + diag(xh))*f(xh)",
                                 "inv(2 + xh(2))",
                                 "exp(xh) + log(w + xh)",
                                 "sqrt(w + xh).*sin(xh) - cos(3*xh)",
                                 "tanh(xh)",
                                 "2.^xh",
                                 "(w + xh.*xh).^(s + xh)",
                                 "atan2(xh, w)",
                                 "atan2(w, xh)",
                                 "atan2(xh(1), xh(2))",
                                 "trace(diag(xh)*P)",
                                 "diag(xh*xh')",
                                 "-xh'",
                                 "xh(2)*eye(2)",
                                 "sum(xh)*ones(2, 1)",
                                 "[xh(1), 0; 1, xh(2)]*[xh(2); 3]",
                                 "tan(xh(1))",
                                 "abs(xh)",
                                 "max(xh, s)",
                                 "min(s*xh, xh.*xh)",
                                 "clip(xh, -0.1, 0.2)",
                                 "0.1*abs(xh).*xh",
                                 "-xh(2)*0.3*abs(xh(2))*sin(xh(1))"}) {
    const Program program = compile("jacobian(" + text + ", xh)");
    ASSERT_NE(jacobian_in(program), nullptr) << text;
    const Program formulas = with_derivatives(program);
    EXPECT_EQ(jacobian_in(formulas), nullptr) << text;
    EXPECT_LT(
        relative_difference(evaluate(formulas, world.values), evaluate(program, world.values)),
        1e-14)
        << text;
  }
  const Program of_matrix = compile("He(jacobian(inv(B)*xh, B)*kron(xh, eye(2)))");
  EXPECT_EQ(jacobian_in(with_derivatives(of_matrix)), nullptr);
  EXPECT_LT(relative_difference(evaluate(with_derivatives(of_matrix), world.values),
                                evaluate(of_matrix, world.values)),
            1e-14);
}

TEST_F(Jacobians, OfADragThatIsSmoothHaveNoJump) {
  for (const std::string text : {"abs(xh).*xh", "-0.1*abs(xh(1))*xh(1)", "xh(2)*0.1*abs(xh(2))*s",
                                 "2*xh(2)*s*abs(xh(2))/3"}) {
    const Program formulas = with_derivatives(compile("jacobian(" + text + ", xh)"));
    EXPECT_TRUE(std::ranges::none_of(formulas.code, [](const Instruction& one) {
      return one.op == Op::where;
    })) << text;
  }
}

TEST_F(Jacobians, StayWhereThereAreNone) {
  for (const std::string text :
       {"where(xh > s, xh, s)", "expm(s*xh*xh')", "norm(xh)", "floor(xh)"}) {
    const Program formulas = with_derivatives(compile("2*jacobian(sin(" + text + "), xh)"));
    EXPECT_NE(jacobian_in(formulas), nullptr) << text;
  }
  // What stands still needs none.
  const Program still = with_derivatives(compile("jacobian(abs(P)*sin(xh), xh)"));
  EXPECT_EQ(jacobian_in(still), nullptr);
}

}  // namespace
}  // namespace gainsmith::expr
