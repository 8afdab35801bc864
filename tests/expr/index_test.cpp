#include <gtest/gtest.h>

#include <random>

#include "expr/world.h"
#include "support/input_error.h"

namespace gainsmith::expr {
namespace {

using tests::input_error;

class Index : public testing::Test {
 protected:
  Index() {
    std::mt19937 random(1);
    A = random_matrix(random, 3, 4);
    v = random_matrix(random, 3, 1);
    world.set("A", A).set("v", v).set("r", v.transpose()).set("s", 2).set("k", 2);
    world.scope.dimensions = {{"n", 3}};
    world.define("twice(x)", "2*x").define("D", "2*A");
  }
  World world;
  Matrix A, v;
};

TEST_F(Index, CountsFromOne) {
  EXPECT_EQ(world("A(2, 3)")(0, 0), A(1, 2));
  EXPECT_EQ(world("v(1)")(0, 0), v(0));
  EXPECT_EQ(world("r(3)")(0, 0), v(2));
  EXPECT_EQ(world("s(1)")(0, 0), 2);
  EXPECT_EQ(world("s(1, 1)")(0, 0), 2);
}

TEST_F(Index, RangesHoldBothEnds) {
  EXPECT_EQ(world("A(1:2, 2:4)"), A.block(0, 1, 2, 3));
  EXPECT_EQ(world("A(:, 2)"), A.col(1));
  EXPECT_EQ(world("A(3, :)"), A.row(2));
  EXPECT_EQ(world("A(:, :)"), A);
  EXPECT_EQ(world("v(2:3)"), v.bottomRows(2));
  EXPECT_EQ(world("r(1:2)"), v.topRows(2).transpose());
  EXPECT_EQ(world("v(:)"), v);
  EXPECT_EQ(world("A(n - 1:n, 1)"), A.block(1, 0, 2, 1));
  EXPECT_EQ(world("v(n)")(0, 0), v(2));
}

TEST_F(Index, EndIsTheLastOne) {
  EXPECT_EQ(world("A(end, :)"), A.row(2));
  EXPECT_EQ(world("A(1:2, 2:end)"), A.block(0, 1, 2, 3));
  EXPECT_EQ(world("v(end-1:end)"), v.bottomRows(2));
  EXPECT_EQ(world("A(end, end)(end)")(0, 0), A(2, 3));
  EXPECT_EQ(world("(2*A)'(end, 1)")(0, 0), 2 * A(0, 3));
  EXPECT_EQ(world("A(:, end+1:end)"), Matrix(3, 0));
  const auto message = [&](const char* text) {
    return input_error([&] { world(text); }).message();
  };
  EXPECT_NE(message("1 + end").find("'end' is only for an index"), std::string::npos);
  EXPECT_NE(message("A(1, end + 1)").find("outside 1:4"), std::string::npos);
  EXPECT_NE(message("twice(end)").find("'end' is only for an index"), std::string::npos);
}

TEST_F(Index, WorksOnAnyExpression) {
  EXPECT_EQ(world("(2*A)(1, 1)")(0, 0), 2 * A(0, 0));
  EXPECT_EQ(world("A'(4, 3)")(0, 0), A(2, 3));
  EXPECT_EQ(world("D(2, 2)")(0, 0), 2 * A(1, 1));
  EXPECT_EQ(world("twice(A)(2, 2)")(0, 0), 2 * A(1, 1));
  EXPECT_EQ(world("A(:, 2)(3)")(0, 0), A(2, 1));
}

TEST_F(Index, OutsideIsRefusedWithTheRange) {
  for (const char* text :
       {"A(4, 1)", "A(0, 1)", "A(-1, 1)", "A(2:4, 1)", "A(3:1, 1)", "A(5:4, 1)", "v(4)"}) {
    const InputError error = input_error([&] { world(text); });
    EXPECT_NE(error.message().find("outside 1:3"), std::string::npos) << text << error.what();
    EXPECT_EQ(error.place().column, 3) << text;
  }
  EXPECT_NE(input_error([&] { world("A(1, 5)"); }).message().find("outside 1:4"),
            std::string::npos);
}

TEST_F(Index, ARangeMayBeEmpty) {
  EXPECT_EQ(world("A(:, 5:4)").rows(), 3);
  EXPECT_EQ(world("A(:, 1:0)").cols(), 0);
  EXPECT_EQ(world("A(2:1, :)").rows(), 0);
  EXPECT_EQ(world("v(n + 1:n)").size(), 0);
}

TEST_F(Index, MustBeAWholeNumberKnownBeforehand) {
  for (const char* text : {"v(k)", "v(1.5)", "v(1:k)", "v(1e0)", "v(1/1)", "v(2147483647 + 1)"}) {
    const InputError error = input_error([&] { world(text); });
    EXPECT_NE(error.message().find("whole number known beforehand"), std::string::npos)
        << text << ": " << error.what();
  }
}

TEST_F(Index, AMatrixTakesTwo) {
  for (const char* text : {"A(1)", "A(1, 1, 1)", "A()", "A(:)"})
    EXPECT_NE(input_error([&] { world(text); }).message().find("3 x 4 matrix takes two indices"),
              std::string::npos)
        << text;
}

TEST_F(Index, ADefinitionHidesADimensionOfItsName) {
  world.scope.dimensions["m"] = 2;
  world.define("m", "3");
  EXPECT_EQ(world("m")(0, 0), 3);
  EXPECT_EQ(world("2^m")(0, 0), 8) << "as a factor m is the definition, so also as an exponent";
}

TEST_F(Index, ARangeStandsOnlyInAnIndex) {
  EXPECT_NE(input_error([&] { world("exp(1:2)"); }).message().find("only in an index"),
            std::string::npos);
}

}  // namespace
}  // namespace gainsmith::expr
