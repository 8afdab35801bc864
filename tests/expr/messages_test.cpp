// What a person reads when names, shapes or values do not fit.
#include <gtest/gtest.h>

#include <cctype>
#include <string>
#include <vector>

#include "expr/binding/functions.h"
#include "expr/world.h"
#include "support/input_error.h"

namespace gainsmith::expr {
namespace {

using tests::input_error;

class Messages : public testing::Test {
 protected:
  Messages() {
    world.set("A", Matrix::Identity(2, 2)).set("B", Matrix::Ones(2, 3)).set("delta", 0.1);
    world.set("zero", 0.0).set("singular", Matrix::Ones(2, 2)).set("big", 1e200);
    world.scope.symbols["P"] = {{2, 2}};
  }
  InputError of(const std::string& text) const {
    return input_error([&] { world(text); });
  }
  void expect(const std::string& text, int column, const std::vector<std::string>& parts) const {
    const InputError error = of(text);
    EXPECT_EQ(error.place(), (Place{"test", 1, column})) << text << ": " << error.what();
    for (const std::string& part : parts)
      EXPECT_NE(error.message().find(part), std::string::npos) << text << ": " << error.what();
  }
  World world;
};

TEST_F(Messages, UnknownNamesComeWithTheNearest) {
  expect("1 + dleta", 5, {"unknown name 'dleta'", "did you mean 'delta'?"});
  expect("2*epx(1)", 3, {"unknown function 'epx'", "did you mean 'exp'?"});
  expect("he(A)", 1, {"case counts", "did you mean 'He'?"});
  expect("qqqqqq", 1, {"known: ", "A, B"});
  expect("Q", 1, {"known: "});
  expect("exp", 1, {"'exp' is a function: write exp(x)"});
}

TEST_F(Messages, AnotherCaseIsNamed) {
  expect("1 + p", 5, {"unknown name 'p'; case counts; did you mean 'P'?"});
  expect("2*Delta", 3, {"unknown name 'Delta'; case counts; did you mean 'delta'?"});
}

/// What is advised exists: each name before a bracket is a function, or an argument.
TEST_F(Messages, FunctionsOfOtherLanguagesLeadToTheirNamesHere) {
  for (const std::string word : {"norm2",
                                 "eigs",
                                 "eigvals",
                                 "lqr",
                                 "dlqr",
                                 "kalman",
                                 "acker",
                                 "inverse",
                                 "transpose",
                                 "arctan",
                                 "arcsin",
                                 "arccos",
                                 "sqrtm",
                                 "logm",
                                 "max_eigenvalue",
                                 "vec",
                                 "reshape",
                                 "hstack",
                                 "vstack",
                                 "hcat",
                                 "block_diag",
                                 "solve",
                                 "dot",
                                 "outer",
                                 "cross",
                                 "matmul",
                                 "matrix_rank",
                                 "cholesky",
                                 "fix",
                                 "rem",
                                 "saturate",
                                 "clamp",
                                 "interp",
                                 "spline",
                                 "observability",
                                 "lyapunov",
                                 "solve_continuous_are",
                                 "icare",
                                 "idare",
                                 "zoh",
                                 "size",
                                 "length",
                                 "linspace",
                                 "mean",
                                 "prod",
                                 "pow",
                                 "log2",
                                 "ln",
                                 "asinh",
                                 "atanh",
                                 "real",
                                 "rand",
                                 "ode45",
                                 "gram",
                                 "spectral_radius",
                                 "sdpvar",
                                 "lmivar",
                                 "feasp",
                                 "mincx",
                                 "gevp",
                                 "quadprog",
                                 "fmincon",
                                 "quad_form"}) {
    const std::string message = of("1 + " + word + "(A)").message();
    EXPECT_EQ(message.find("unknown function '" + word + "': "), 0U) << message;
    EXPECT_EQ(message.find("did you mean"), std::string::npos) << message;
    for (std::size_t at = message.find(": "); (at = message.find('(', at)) != std::string::npos;
         ++at) {
      std::size_t begin = at;
      while (begin > 0 && (std::isalnum(static_cast<unsigned char>(message[begin - 1])) != 0 ||
                           message[begin - 1] == '_'))
        --begin;
      const std::string name = message.substr(begin, at - begin);
      EXPECT_TRUE(name.empty() || name == "M" || name == "v" || find_function(name) != nullptr)
          << name << " in: " << message;
    }
  }
}

TEST_F(Messages, WhatOtherLanguagesWriteComesWithWhatToWriteHere) {
  expect("A => 0", 3, {"'=>'", "did you mean >=?"});
  expect("A =< 0", 3, {"'=<'", "did you mean <=?"});
  expect("A.'", 2, {"write ' for the transpose"});
  expect("A\\B", 2, {"inv(A)*B"});
  expect("A |", 3, {"norm(M)"});
  expect("A\"", 2, {"quotation mark that begins"});
  expect("A\xC2\xA0+ 1", 2, {"non-breaking space"});
  expect("A % remark", 3, {"remark", "#"});
  expect(
      "2\xC3\x97"
      "3",
      2, {"write *"});
  expect("A\xC2\xB2", 2, {"write ^2"});
  expect("A \xE2\x89\xBB 0", 3, {"write >;"});
  expect("A \xE2\xAA\xAF 0", 3, {"write <=;"});
  expect("A^T*A", 3, {"'^T'", "write ' for the transpose"});
  expect("A.T*A", 2, {"write ' for the transpose"});
  expect("transpose(A)", 1, {"write A'"});
  expect("A[1, 2]", 2, {"an element is written A(1, 2)"});
}

TEST_F(Messages, ACommaThatIsMissingIsNamed) {
  expect("[1 2]", 4, {"',' ';' or ']'", "a comma is missing"});
  expect("[A B]", 4, {"a comma is missing"});
  expect("[(1) [2]]", 6, {"a comma is missing"});
  expect("1 2", 3, {"a comma is missing"});
  expect("2 A", 3, {"* in a product"});
  expect("A' A", 4, {"* in a product"});
}

TEST_F(Messages, ADecimalHasAPoint) {
  expect("0,005", 2, {"decimal", "0.005"});
  expect("1 + 0,5", 6, {"decimal", "0.5"});
  expect("1.000,5", 6, {"one point", "thousands"});
  EXPECT_EQ(of("1, 5").message().find("decimal"), std::string::npos);
}

TEST_F(Messages, NumbersHaveNoUnits) {
  expect("5ms", 2, {"no units", "for 5 ms write 5e-3", "5*ms"});
  expect("2.5kHz", 4, {"no units", "its inverse"});
  expect("100 Hz", 5, {"no units", "its inverse"});
  expect("2 min", 3, {"for 2 min write 2*60"});
  expect("1e2us", 4, {"no units", "1e2*us"});
  expect("2A", 2, {"2*A"});
  expect("0.2 s", 5, {"for 0.2 s write 0.2,"});
  expect("5e-3s", 5, {"for 5e-3 s write 5e-3,"});
  expect("5\xC2\xB5s", 2, {"5e-6"});
}

TEST_F(Messages, BothShapesAreShown) {
  expect("1 + A*B'", 5, {"multiply A (2 x 2) by B' (3 x 2)", "2 columns meet 3 rows"});
  expect("delta*(A + B)", 8, {"cannot add A (2 x 2) and B (2 x 3)"});
  expect("A - B", 1, {"cannot subtract A (2 x 2) and B (2 x 3)"});
  expect("B*B", 1, {"3 columns meet 2 rows", "element by element it is .*"});
  expect("A/A", 1, {"cannot divide by A (2 x 2)", "inv(...)", "./ for each element"});
  expect("B^2", 1, {"B (2 x 3)", "not square", ".^"});
  expect("A^0.5", 1, {"whole powers", ".^"});
  expect("A.*B", 1, {"the elementwise product of A (2 x 2) and B (2 x 3)", "equal"});
  expect("A./B", 1, {"the elementwise quotient of A (2 x 2) and B (2 x 3)"});
  expect("A.^B", 1, {"the elementwise power of A (2 x 2) and B (2 x 3)"});
  expect("I.*B", 1, {"I (a multiple of I) and B (2 x 3)"});
  expect("I.^2", 1, {"the size of the identity"});
  expect("A + 1", 1, {"cannot add A (2 x 2) and 1 (1 x 1)", "s*I"});
  expect("B(1, :) - 8", 1, {"cannot subtract B(1, :) (1 x 3) and 8 (1 x 1)"});
  expect("B + 1", 1, {"cannot add B (2 x 3) and 1 (1 x 1)"});
  expect("max(A)", 5, {"largest element of a vector, not of A (2 x 2)", "max(A, B)"});
  expect("min(B)", 5, {"smallest element of a vector"});
  expect("max(zeros(0, 1))", 5, {"max of an empty vector"});
  expect("skew(A)", 6, {"a vector of 3 elements, not A (2 x 2)"});
  expect("sat(A, B)", 1, {"cannot divide by B (2 x 3)", "only by a number"});
  expect("complement(B, 1)", 1, {"of B (2 x 3) there are 0 columns, not 1"});
  expect("complement(A(:, 1), delta)", 21, {"the number of columns must be a whole number"});
  expect("mod(A, B)", 8, {"B (2 x 3)", "expected 2 x 2"});
  expect("2^A", 1, {"whole powers"});
  expect("1 + trace(B)", 11, {"square", "B (2 x 3)"});
  expect("inv(B)", 5, {"square", "B (2 x 3)"});
  expect("He(B)", 4, {"square", "B (2 x 3)"});
  expect("expm(B)", 6, {"square", "B (2 x 3)"});
  expect("diag(B)", 6, {"vector or a square matrix", "B (2 x 3)"});
  expect("max(A, B)", 5, {"A (2 x 2)", "expected 2 x 3"});
  expect("where(A > B, 1, 2)", 7, {"cannot compare A (2 x 2) and B (2 x 3)"});
  expect("where(A > 0, B, 2)", 7, {"expected 2 x 3"});
  expect("clip(A, 0, B)", 1, {"clip(A, 0, B) (2 x 2)", "expected 2 x 3"});
  expect("obsv(A, B)", 1, {"2 columns", "B (2 x 3)"});
}

TEST_F(Messages, AJacobianIsByAName) {
  world.define("f(v)", "v'*v").define("twice(v)", "jacobian(jacobian(v'*v, v), v)");
  expect("jacobian(A*delta, 2*delta)", 19, {"needs a name x", "not '2*delta'"});
  expect("jacobian(A, I)", 13, {"the size of the identity"});
  expect("jacobian(A, pi)", 13, {"'pi' is a number that nothing varies"});
  expect("jacobian(A, f)", 13, {"'f' takes 1 arguments"});
  expect("jacobian(A, dleta)", 13, {"unknown name 'dleta'", "did you mean 'delta'?"});
  expect("jacobian(A)", 1, {"jacobian(e, x)", "found 1 arguments"});
  EXPECT_NE(of("twice(delta)").message().find("a jacobian of a jacobian"), std::string::npos);
}

TEST_F(Messages, AComparisonIsNoValue) {
  expect("1 + (A > 0)", 6, {"a comparison is allowed only on its own or in where"});
  expect("where(A, 1, 2)", 7, {"where needs a condition"});
  expect("where(A > 0 and 1, 1, 2)", 17, {"expected a condition"});
  expect("1 + (A > 0 and A < 1)", 6, {"'and', 'or' and 'not' join conditions"});
}

TEST_F(Messages, NumbersMustBeFinite) {
  for (const char* word : {"nan", "NaN", "NAN", "inf", "Inf", "INF", "infinity"})
    expect(std::string("1 + ") + word, 5, {"finite"});
  expect("1 + 1e400", 5, {"1e400", "beyond the range of double"});
}

TEST_F(Messages, OperationsWithoutAResultAreShownWhereTheyStand) {
  expect("1 + 1/zero", 5, {"division by zero"});
  expect("A + inv(singular)", 5, {"inv: the matrix is singular"});
  expect("singular^-1", 1, {"singular"});
  expect("1 + log(-delta)", 5, {"log of -0.1"});
  expect("log(zero)", 1, {"log of 0"});
  expect("sqrt(-delta)", 1, {"sqrt of -0.1"});
  expect("sqrt(-1e-17*delta)", 1,
         {"sqrt of -1e-18 (where that is rounding, write sqrt(max(..., 0)))"});
  expect("(-delta)^0.5", 1, {"power is not a finite number"});
  expect("big*big", 1, {"product is not a finite number"});
  expect("1 + exp(big)", 5, {"exp is not a finite number"});
  expect("expm(big*A)", 1, {"not a finite number"});
}

TEST_F(Messages, SizesMustBeWholeAndReasonable) {
  for (const char* text : {"eye(1.5)", "zeros(-1)", "ones(delta)", "zeros(100001)", "eye(2, 2.5)"})
    EXPECT_THROW(world(text), InputError) << text;
  expect("zeros(delta)", 7, {"whole number known beforehand"});
  expect("zeros(100000)", 1, {"too large"});
}

TEST_F(Messages, ARankMustBeKnownBeforehand) {
  expect("orth(P)", 6, {"must not depend on 'P'"});
  expect("null(A*P)", 6, {"must not depend on 'P'"});
  expect("orth(A, P(1, 1))", 9, {"the tolerance must not depend on 'P'"});
  expect("orth(A, -1)", 9, {"must not be negative"});
}

class Relations : public testing::Test {
 protected:
  Relations() {
    world.set("A", Matrix{{1, 2}, {3, 4}}).set("B", Matrix::Ones(2, 3)).set("s", 2).set("t", 7);
  }
  std::vector<CompiledRelation> relations(const std::string& text) const {
    return compile_relations(parse({text, "test"}), world.scope);
  }
  Matrix difference(const CompiledRelation& relation) const {
    return evaluate(relation.difference, world.values);
  }
  World world;
};

TEST_F(Relations, AreTheLargerSideMinusTheSmaller) {
  const Matrix A = world.values["A"];
  const Matrix I = Matrix::Identity(2, 2);
  EXPECT_EQ(difference(relations("A > 0")[0]), A);
  EXPECT_EQ(difference(relations("A < 0")[0]), -A);
  EXPECT_EQ(difference(relations("0 < A")[0]), A);
  EXPECT_EQ(difference(relations("A <= s*I")[0]), 2 * I - A);
  EXPECT_EQ(difference(relations("I >= A")[0]), I - A);
  EXPECT_EQ(difference(relations("s < t")[0])(0, 0), 5);
}

TEST_F(Relations, OfAChainStandInOrder) {
  const Matrix A = world.values["A"];
  const Matrix I = Matrix::Identity(2, 2);
  const auto chain = relations("I <= A < s*I");
  ASSERT_EQ(chain.size(), 2U);
  EXPECT_FALSE(chain[0].strict);
  EXPECT_TRUE(chain[1].strict);
  EXPECT_EQ(difference(chain[0]), A - I);
  EXPECT_EQ(difference(chain[1]), 2 * I - A);
  const auto falling = relations("t > s >= 1");
  EXPECT_EQ(difference(falling[0])(0, 0), 5);
  EXPECT_EQ(difference(falling[1])(0, 0), 1);
}

TEST_F(Relations, WhatCannotBeComparedIsRefused) {
  EXPECT_NE(input_error([&] { relations("A + A"); }).message().find("expected a comparison"),
            std::string::npos);
  EXPECT_NE(input_error([&] { relations("B > 0"); }).message().find("square ones, not 2 x 3"),
            std::string::npos);
  const InputError shapes = input_error([&] { relations("A > B"); });
  EXPECT_NE(shapes.message().find("compare A (2 x 2) and B (2 x 3)"), std::string::npos);
  EXPECT_NE(input_error([&] { relations("A > s"); }).message().find("s*I"), std::string::npos);
  EXPECT_NE(input_error([&] { relations("2*I > I"); }).message().find("eye(n)"), std::string::npos);
}

}  // namespace
}  // namespace gainsmith::expr
