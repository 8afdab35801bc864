#include "expr/binding/functions.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <random>

#include "expr/world.h"
#include "support/input_error.h"
#include "support/linear_algebra.h"

namespace gainsmith::expr {
namespace {

using tests::input_error;
using tests::product;

class Functions : public testing::TestWithParam<int> {
 protected:
  Functions() {
    std::mt19937 random(static_cast<unsigned>(GetParam()));
    A = random_matrix(random, 4, 4);
    B = random_matrix(random, 4, 2);
    C = random_matrix(random, 2, 4);
    D = random_matrix(random, 4, 2);
    v = random_matrix(random, 4, 1);
    world.set("A", A).set("B", B).set("C", C).set("D", D).set("v", v).set("x", 0.3).set("y", -0.7);
  }
  void expect(const std::string& text, const Matrix& value, double tolerance = 1e-13) const {
    EXPECT_LT(relative_difference(world(text), value), tolerance) << text;
  }
  void expect(const std::string& text, double value) const {
    expect(text, Matrix::Constant(1, 1, value));
  }
  Matrix map(const Matrix& m, double (*f)(double)) const { return m.unaryExpr(f); }
  World world;
  Matrix A, B, C, D, v;
};

TEST_P(Functions, ElementByElement) {
  const Matrix positive = B.cwiseAbs() + Matrix::Constant(4, 2, 0.1);
  world.set("Q", positive);
  expect("exp(B)", map(B, [](double t) { return std::exp(t); }));
  expect("log(Q)", map(positive, [](double t) { return std::log(t); }));
  expect("sqrt(Q)", map(positive, [](double t) { return std::sqrt(t); }));
  expect("sin(B)", map(B, [](double t) { return std::sin(t); }));
  expect("cos(B)", map(B, [](double t) { return std::cos(t); }));
  expect("tanh(B)", map(B, [](double t) { return std::tanh(t); }));
  expect("abs(B)", map(B, [](double t) { return std::fabs(t); }));
  expect("sign(B)", map(B, [](double t) { return t > 0 ? 1.0 : t < 0 ? -1.0 : 0.0; }));
  EXPECT_EQ(world("sign([-2, 0, 3])"), (Matrix{{-1, 0, 1}}));
}

TEST_P(Functions, FloorModAndAngles) {
  expect("floor(5*B)", map(5 * B, [](double t) { return std::floor(t); }));
  expect("mod(5*v, x)", (5 * v).unaryExpr([](double t) { return t - 0.3 * std::floor(t / 0.3); }),
         1e-12);
  expect("mod(x, -v.^2)",
         -v.unaryExpr([](double t) { return -0.3 + t * t * std::ceil(0.3 / (t * t)); }), 1e-12);
  expect("atan2(B, D)", B.binaryExpr(D, [](double y, double x) { return std::atan2(y, x); }));
  expect("atan2(v, 1)", map(v, [](double t) { return std::atan(t); }));
  expect("[cos(atan2(x, y)); sin(atan2(x, y))]*norm([x, y])", Matrix{{-0.7}, {0.3}});
}

TEST(FunctionsOfNumbers, AtTheirEdges) {
  const World world;
  const auto value = [&](const std::string& text) { return world(text)(0, 0); };
  EXPECT_EQ(value("floor(-0.5)"), -1);
  EXPECT_EQ(value("floor(2)"), 2);
  EXPECT_EQ(value("mod(6, 3)"), 0);
  EXPECT_EQ(value("mod(-6, 3)"), 0);
  EXPECT_EQ(value("mod(-1, 3)"), 2);
  EXPECT_EQ(value("mod(1, -3)"), -2);
  EXPECT_LT(value("mod(-1e-20, 1)"), 1);
  EXPECT_GE(value("mod(-1e-20, 1)"), 0);
  EXPECT_LT(value("mod(1e300, 0.1)"), 0.1);
  EXPECT_EQ(value("atan2(0, -1)"), std::acos(-1.0));
  EXPECT_EQ(value("atan2(-0, -1)"), std::acos(-1.0));
  EXPECT_EQ(value("atan2(0, 0)"), 0);
  EXPECT_NE(input_error([&] { value("mod(1, 0)"); }).message().find("division by zero"),
            std::string::npos);
  EXPECT_NE(input_error([&] { value("2 - [1; 2]./[1; 0]"); }).message().find("division by zero"),
            std::string::npos);
}

TEST_P(Functions, ElementsOfVectors) {
  expect("max(v)", v.maxCoeff());
  expect("min(v)", v.minCoeff());
  expect("max(v')", v.maxCoeff());
  expect("max(abs([v; x; y]))", std::max(0.7, v.cwiseAbs().maxCoeff()));
  expect("min(x)", 0.3);
}

TEST_P(Functions, CrossProductsAndSaturation) {
  const Eigen::Vector3d a = v.topRows(3);
  const Eigen::Vector3d b = A.col(1).topRows(3);
  expect("skew(v(1:3))*A(1:3, 2)", Matrix(a.cross(b)));
  expect("skew(v(1:3)')", world("-skew(v(1:3))'"));
  expect("sat(v, 2)", v / std::max(1.0, v.norm() / 2));
  expect("sat(v/10, 2)", v / 10);
  expect("norm(sat(100*B, x))", 0.3);
}

TEST_P(Functions, ComplementsAreThoseOfTheHouseholderFactorisation) {
  const Matrix Q = Eigen::HouseholderQR<Matrix>(B).householderQ();
  expect("complement(B, 2)", Q.rightCols(2));
  expect("complement(B, 1)", Q.rightCols(1));
  expect("complement(v, 3)'*v", Matrix::Zero(3, 1));
  expect("complement(zeros(3, 1), 2)", Matrix::Identity(3, 3).rightCols(2));
  expect("complement(zeros(2, 0), 2)", Matrix::Identity(2, 2));
  EXPECT_EQ(world("complement(B, 0)").cols(), 0);
}

TEST_P(Functions, MinMaxClipAndWhere) {
  expect("min(B, D)", B.cwiseMin(D));
  expect("max(B, D, -B)", B.cwiseMax(D).cwiseMax(-B));
  expect("min(x, B)", B.cwiseMin(0.3));
  expect("max(B, 0)", B.cwiseMax(0.0));
  expect("min(x, y, 2)", -0.7);
  expect("clip(B, y, x)", B.cwiseMax(-0.7).cwiseMin(0.3));
  expect("clip(B, -abs(D), abs(D))", B.cwiseMax(-D.cwiseAbs()).cwiseMin(D.cwiseAbs()));
  expect("where(B > D, B, D)", B.cwiseMax(D));
  expect("where(B < D, B, D)", B.cwiseMin(D));
  expect("where(B > 0, 1, -1)", map(B, [](double t) { return t > 0 ? 1.0 : -1.0; }));
  expect("where(x > y, B, D)", B);
  expect("where(x < y, B, D)", D);
}

TEST(Where, TheRelationDecidesAtEquality) {
  const World world;
  EXPECT_EQ(world("where(1 > 1, 5, 6)")(0, 0), 6);
  EXPECT_EQ(world("where(1 >= 1, 5, 6)")(0, 0), 5);
  EXPECT_EQ(world("where(1 < 1, 5, 6)")(0, 0), 6);
  EXPECT_EQ(world("where(1 <= 1, 5, 6)")(0, 0), 5);
}

/// What is written out decides when the text is read; what rounding could decide does not.
TEST(Where, OnNumbersIsDecidedAtOnce) {
  World world;
  world.set("x", 2.0);
  const auto branches = [&](const std::string& text) {
    const Program program = compile(parse({text, "test"}), world.scope);
    return std::ranges::count_if(program.code,
                                 [](const Instruction& one) { return one.op == Op::where; });
  };
  EXPECT_EQ(branches("where(x > 1, 5, 6)"), 1);
  EXPECT_EQ(branches("sum(k in 1..3, where(k < 2 and x > 1, 1, 0))"), 1);
  EXPECT_EQ(world("sum(k in 1..3, where(k < 2 and x > 1, 1, 0))")(0, 0), 1);
  EXPECT_EQ(branches("where(1/2 < 0.6, x, 0)"), 0);
  EXPECT_EQ(branches("where(0.1 + 0.2 > 0.3, x, 0)"), 1);
  EXPECT_EQ(branches("where(49*(1/49) >= 1, x, 0)"), 1);
  EXPECT_EQ(world("where(1 > 2, x, [1; 2])")(1, 0), 2);
  EXPECT_EQ(world("where(1 < 2, x, [1; 2])")(1, 0), 2);
}

TEST_P(Functions, OfMatrices) {
  expect("He(A)", A + A.transpose());
  expect("He(x)", 0.6);
  expect("trace(A)", A.trace());
  expect("trace(B*C)", product({B, C}).trace());
  expect("norm(v)", v.norm());
  expect("norm(v')", v.norm());
  expect("norm(A)", tests::singular_values(A)(0));
  expect("norm(B*0.5)", 0.5 * tests::singular_values(B)(0));
  expect("diag(v)", Matrix(Eigen::VectorXd(v).asDiagonal()));
  expect("diag(v')", Matrix(Eigen::VectorXd(v).asDiagonal()));
  expect("diag(A)", A.diagonal());
  expect("diag(x)", 0.3);
}

TEST_P(Functions, Inverses) {
  expect("inv(A)*A", Matrix::Identity(4, 4), 1e-10);
  expect("inv(x)", 1 / 0.3);
  // The four conditions of Penrose.
  for (const auto& [name, M] :
       {std::pair<std::string, Matrix>{"B", B}, {"C", C}, {"B*C", product({B, C})}}) {
    const Matrix inverse = world("pinv(" + name + ")");
    const Matrix left = product({M, inverse}), right = product({inverse, M});
    EXPECT_LT(relative_difference(product({M, inverse, M}), M), 1e-10) << name;
    EXPECT_LT(relative_difference(product({inverse, M, inverse}), inverse), 1e-10) << name;
    EXPECT_LT(relative_difference(left.transpose(), left), 1e-10) << name;
    EXPECT_LT(relative_difference(right.transpose(), right), 1e-10) << name;
  }
  expect("pinv(zeros(2, 3))", Matrix::Zero(3, 2));
}

TEST_P(Functions, TheMatrixExponentialIsItsSeries) {
  Matrix term = Matrix::Identity(4, 4);
  Matrix sum = term;
  for (int k = 1; k < 60; ++k) {
    term = product({term, A}) / k;
    sum += term;
  }
  expect("expm(A)", sum, 1e-12);
  expect("expm(x)", std::exp(0.3));
}

TEST_P(Functions, MadeOfSizes) {
  world.scope.dimensions = {{"n", 4}, {"p", 2}};
  EXPECT_EQ(world("eye(n)"), Matrix::Identity(4, 4));
  EXPECT_EQ(world("zeros(n, p)"), Matrix::Zero(4, 2));
  EXPECT_EQ(world("zeros(p)"), Matrix::Zero(2, 2));
  EXPECT_EQ(world("ones(p + 1, 1)"), Matrix::Ones(3, 1));
  EXPECT_EQ(world("ones(n - p)"), Matrix::Ones(2, 2));
}

TEST_P(Functions, BlockDiagonal) {
  Matrix expected = Matrix::Zero(9, 7);
  expected.block(0, 0, 4, 2) = B;
  expected.block(4, 2, 4, 4) = A;
  expected(8, 6) = 0.3;
  expect("blkdiag(B, A, x)", expected);
  expect("blkdiag(A)", A);
}

TEST_P(Functions, BasesAreOrthonormalAndHaveTheRank) {
  const Matrix low = product({B, C});  // 4 x 4 of rank 2
  world.set("M", low);
  const Matrix range = world("orth(M)");
  const Matrix kernel = world("null(M)");
  ASSERT_EQ(range.cols(), 2);
  ASSERT_EQ(kernel.cols(), 2);
  EXPECT_LT((product({range.transpose(), range}) - Matrix::Identity(2, 2)).norm(), 1e-13);
  EXPECT_LT((product({kernel.transpose(), kernel}) - Matrix::Identity(2, 2)).norm(), 1e-13);
  EXPECT_LT((low - product({range, range.transpose(), low})).norm(), 1e-12);
  EXPECT_LT(product({low, kernel}).norm(), 1e-12);
  EXPECT_EQ(world("null(A)").cols(), 0);
  EXPECT_EQ(world("orth(C)").cols(), 2);
  EXPECT_EQ(world("null(C)").cols(), 2);
}

TEST(Rank, CountsSingularValuesAboveTheToleranceTimesTheLargest) {
  World world;
  world.set("M", Eigen::Vector3d(2, 2e-3, 2e-9).asDiagonal().toDenseMatrix());
  EXPECT_EQ(world("orth(M)").cols(), 3);
  EXPECT_EQ(world("orth(M, 1e-6)").cols(), 2);
  EXPECT_EQ(world("null(M, 1e-6)").cols(), 1);
  EXPECT_EQ(world("orth(M, 0.5)").cols(), 1);
  EXPECT_EQ(world("orth(zeros(2, 3))").cols(), 0);
  EXPECT_EQ(world("null(zeros(2, 3))").cols(), 3);
}

TEST_P(Functions, Observability) {
  Matrix expected(8, 4);
  Matrix row = C;
  for (int k = 0; k < 4; ++k) {
    expected.middleRows(2 * k, 2) = row;
    row = product({row, A});
  }
  expect("obsv(A, C)", expected);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Functions, testing::Values(1, 2, 3));

TEST(EmptyMatrices, AreHandledByEveryFunction) {
  const World world;
  EXPECT_EQ(world("norm(zeros(0, 3))")(0, 0), 0);
  EXPECT_EQ(world("norm(zeros(2, 0))")(0, 0), 0);
  EXPECT_EQ(world("norm(null(eye(2)))")(0, 0), 0);
  EXPECT_EQ(world("trace(zeros(0))")(0, 0), 0);
  EXPECT_EQ(world("inv(zeros(0))").size(), 0);
  EXPECT_EQ(world("expm(zeros(0))").size(), 0);
  EXPECT_EQ(world("zeros(0)^2").size(), 0);
  EXPECT_EQ(world("pinv(zeros(0, 3))").rows(), 3);
  EXPECT_EQ(world("orth(zeros(2, 0))").rows(), 2);
  EXPECT_EQ(world("orth(zeros(0, 2))").cols(), 0);
  EXPECT_EQ(world("null(zeros(0, 2))").cols(), 2);
  EXPECT_EQ(world("zeros(2, 0)*zeros(0, 3)"), Matrix::Zero(2, 3));
  EXPECT_EQ(world("[eye(2), zeros(2, 0)]"), Matrix::Identity(2, 2));
  EXPECT_EQ(world("diag(zeros(0, 1))").size(), 0);
  EXPECT_EQ(world("log(zeros(0, 2))").size(), 0);
  EXPECT_EQ(world("max(zeros(0, 2), 1)").size(), 0);
}

TEST(Table, EveryFunctionIsFoundAndExplained) {
  EXPECT_GE(functions().size(), 29U);
  for (const Function& function : functions()) {
    EXPECT_EQ(find_function(function.name), &function);
    EXPECT_TRUE(is_reserved(function.name));
    EXPECT_TRUE(function.usage.starts_with(std::string(function.name) + "(")) << function.usage;
    EXPECT_FALSE(function.meaning.empty()) << function.name;
  }
  EXPECT_EQ(find_function("he"), nullptr);
  EXPECT_TRUE(is_reserved("I"));
  EXPECT_TRUE(is_reserved("pi"));
  EXPECT_FALSE(is_reserved("P1"));
}

TEST(Table, AWrongNumberOfArgumentsShowsTheUsage) {
  const World world;
  for (const Function& function : functions()) {
    std::string call = std::string(function.name) + "(";
    for (int i = 0; i + 1 < function.fewest; ++i) call += i > 0 ? ", 1" : "1";
    const InputError error = input_error([&] { world(call + ")"); });
    EXPECT_NE(error.message().find(function.usage), std::string::npos) << error.what();
    if (function.most < 0) continue;
    call = std::string(function.name) + "(1";
    for (int i = 0; i < function.most; ++i) call += ", 1";
    EXPECT_NE(input_error([&] { world(call + ")"); }).message().find(function.usage),
              std::string::npos);
  }
}

}  // namespace
}  // namespace gainsmith::expr
