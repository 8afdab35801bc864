#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <random>

#include "expr/world.h"
#include "support/input_error.h"
#include "support/linear_algebra.h"

namespace gainsmith::expr {
namespace {

using tests::product;

class Operators : public testing::TestWithParam<int> {
 protected:
  Operators() {
    std::mt19937 random(static_cast<unsigned>(GetParam()));
    A = random_matrix(random, 3, 3);
    B = random_matrix(random, 3, 2);
    C = random_matrix(random, 2, 3);
    x = std::uniform_real_distribution<double>(0.5, 2)(random);
    world.set("A", A).set("B", B).set("C", C).set("x", x);
  }
  void expect(const std::string& text, const Matrix& value) const {
    EXPECT_LT(relative_difference(world(text), value), 1e-13) << text;
  }
  void expect(const std::string& text, double value) const {
    expect(text, Matrix::Constant(1, 1, value));
  }
  World world;
  Matrix A, B, C;
  double x = 0;
};

TEST_P(Operators, SumsAndDifferences) {
  expect("A + A'", A + A.transpose());
  expect("B - C'", B - C.transpose());
  expect("-B", -B);
  expect("A - A - A", -A);
  expect("B + 0", B);
  expect("0 - B", -B);
}

TEST_P(Operators, ProductsAndQuotients) {
  expect("A*B", product({A, B}));
  expect("B*C*A", product({B, C, A}));
  expect("x*B", x * B);
  expect("B*x", x * B);
  expect("B/x", B / x);
  expect("A*B/2*C", product({A, B, C}) / 2);
  expect("1/x/x", 1 / (x * x));
  expect("-A*B", product({-A, B}));
}

TEST_P(Operators, Transposes) {
  expect("B'", B.transpose());
  expect("(A*B)'", product({B.transpose(), A.transpose()}));
  expect("x'", x);
  expect("B''", B);
}

TEST_P(Operators, PowersBindAsInMatlab) {
  const Matrix square = product({A, A});
  expect("A^2", square);
  expect("A'^2", square.transpose());
  expect("A^2'", square.transpose());
  expect("-A^2", -square);
  expect("A^0", Matrix::Identity(3, 3));
  expect("A^1", A);
  expect("A^7", product({square, square, square, A}));
  const Matrix inverse = tests::inverse(A + 3 * Matrix::Identity(3, 3));
  expect("(A + 3*I)^-1", inverse);
  expect("(A + 3*I)^-2", product({inverse, inverse}));
  expect("2^-1", 0.5);
  expect("-x^2", -x * x);
  expect("x^-2", 1 / (x * x));
  expect("x^0.5", std::sqrt(x));
  expect("x^x", std::pow(x, x));
  expect("2^3^2", 64);
  expect("2^-1*x", x / 2);
  expect("x^(1 + 2)", x * x * x);
  expect("x^(1 - 3)", 1 / (x * x));
}

TEST_P(Operators, ElementByElement) {
  expect("A.*A'", A.cwiseProduct(A.transpose()));
  expect("2.*B", 2 * B);
  expect("B.*x", x * B);
  expect("B./C'", B.cwiseQuotient(C.transpose()));
  expect("2./B", (B / 2).cwiseInverse());
  expect("B./x", B / x);
  expect("x./x", 1);
  expect("B.^3", B.cwiseProduct(B).cwiseProduct(B));
  expect("B.^0", Matrix::Ones(3, 2));
  expect("B.^1", B);
  expect("B.^-2", B.cwiseProduct(B).cwiseInverse());
  expect("abs(B).^0.5", B.cwiseAbs().cwiseSqrt());
  expect("x.^B", (std::log(x) * B).array().exp());
  expect("abs(B).^B", (B.array() * B.array().abs().log()).exp());
  expect("x.^2", x * x);
  expect("x.^-0.5", 1 / std::sqrt(x));
  expect("-B.^2", -B.cwiseProduct(B));
  expect("A*B.*B", product({A, B}).cwiseProduct(B));
  expect("I.*A", Matrix(A.diagonal().asDiagonal()));
  expect("A - 2.*I", A - 2 * Matrix::Identity(3, 3));
  expect("0.*B", Matrix::Zero(3, 2));
}

TEST_P(Operators, ANumberWithAColumnCountsForEachElement) {
  const Matrix ones = Matrix::Ones(3, 1);
  expect("A(:, 1) - 8", A.col(0) - 8 * ones);
  expect("x + B(:, 2)", B.col(1) + x * ones);
  expect("1 - A(:, 1)", ones - A.col(0));
  expect("max(A*A(:, 1) - 0.5, 0).^2",
         (product({A, A.col(0)}) - 0.5 * ones).cwiseMax(0).array().square());
  expect("where(A(:, 1) > 0.2, 1, A(:, 2))", (A.col(0).array() > 0.2).select(ones, A.col(1)));
}

INSTANTIATE_TEST_SUITE_P(Seeds, Operators, testing::Values(1, 2, 3));

TEST(Literals, AreKeptAsWrittenUntilANumberTypeRoundsThem) {
  for (const std::string text : {"0.1", "1e-4", "0.10", "12345678901234567890.5"}) {
    const Program program = compile(parse({text, "f"}), {});
    ASSERT_EQ(program.code.size(), 1U);
    EXPECT_EQ(program.code[0].op, Op::constant);
    EXPECT_EQ(program.code[0].text, text);
  }
  EXPECT_EQ(World()("0.1")(0, 0), 0.1);
  EXPECT_EQ(World()("pi")(0, 0), std::acos(-1.0));
}

TEST(Literals, DimensionNamesAreNumbers) {
  World world;
  world.scope.dimensions = {{"n", 3}};
  EXPECT_EQ(world("n + 1")(0, 0), 4);
  EXPECT_EQ(world("2^n")(0, 0), 8);
  EXPECT_EQ(world("zeros(n, 2*n - 1)").cols(), 5);
}

TEST(Powers, HugeExponentsAreComputedNotCountedUp) {
  EXPECT_NEAR(World()("1.0000001^1000000")(0, 0), std::pow(1.0000001, 1000000), 1e-9);
  EXPECT_EQ(World()("1^2147483647")(0, 0), 1);
  EXPECT_EQ(World()("1^9999999999")(0, 0), 1);
}

TEST(Powers, AnExponentThatOverflowsWholeNumbersIsStillANumber) {
  EXPECT_EQ(World()("1^(2147483647 + 1)")(0, 0), 1);
  EXPECT_EQ(World()("1^(-2147483647 - 2)")(0, 0), 1);
  EXPECT_EQ(World()("1^(65536*65536)")(0, 0), 1);
  EXPECT_EQ(World()("1^(-2147483647 - 1)")(0, 0), 1);
}

}  // namespace
}  // namespace gainsmith::expr
