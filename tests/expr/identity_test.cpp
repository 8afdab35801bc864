// Things that take their size from where they stand: I and 0.
#include <gtest/gtest.h>

#include <random>

#include "expr/world.h"
#include "support/input_error.h"

namespace gainsmith::expr {
namespace {

using tests::input_error;

Matrix eye(int n) { return Matrix::Identity(n, n); }

class Identity : public testing::Test {
 protected:
  Identity() {
    std::mt19937 random(1);
    A = random_matrix(random, 3, 3);
    B = random_matrix(random, 3, 2);
    world.set("A", A).set("B", B).set("s", 2.5);
  }
  World world;
  Matrix A, B;
};

TEST_F(Identity, TakesItsSizeFromTheOtherOperand) {
  EXPECT_EQ(world("A + I"), A + eye(3));
  EXPECT_EQ(world("I - A"), eye(3) - A);
  EXPECT_EQ(world("A - s*I"), A - 2.5 * eye(3));
  EXPECT_EQ(world("I*s + A"), A + 2.5 * eye(3));
  EXPECT_EQ(world("A + I/s"), A + eye(3) / 2.5);
  EXPECT_EQ(world("I*B"), B);
  EXPECT_EQ(world("2*I*B"), 2 * B);
  EXPECT_EQ(world("B*(3*I)"), 3 * B);
}

TEST_F(Identity, MultiplesOfItStayMultiples) {
  EXPECT_EQ(world("A + (s*I + 2*I)"), A + 4.5 * eye(3));
  EXPECT_EQ(world("A + (3*I - I)*I"), A + 2 * eye(3));
  EXPECT_EQ(world("A + (2*I)'"), A + 2 * eye(3));
  EXPECT_EQ(world("A + (2*I)^3"), A + 8 * eye(3));
  EXPECT_EQ(world("A + inv(2*I)"), A + 0.5 * eye(3));
  EXPECT_EQ(world("A + (2*I)^-1"), A + 0.5 * eye(3));
  EXPECT_EQ(world("A + He(I)"), A + 2 * eye(3));
  EXPECT_EQ(world("A + -I"), A - eye(3));
}

TEST_F(Identity, ZeroBesideItIsAZeroOfItsSize) {
  EXPECT_EQ(world("A + (0 + I)"), A + eye(3));
  EXPECT_EQ(world("A + (0 - I)"), A - eye(3));
  EXPECT_EQ(world("A + (I - 0)"), A + eye(3));
}

TEST_F(Identity, TakesTheExpectedShape) {
  EXPECT_EQ(world("2*I", Shape{2, 2}), 2 * eye(2));
  EXPECT_EQ(world("I", Shape{1, 1}), eye(1));
  EXPECT_EQ(world("0", Shape{2, 3}), Matrix::Zero(2, 3));
  EXPECT_EQ(world("0.0e5", Shape{2, 3}), Matrix::Zero(2, 3));
}

TEST_F(Identity, WithoutASizeOrWithARectangularOneIsRefused) {
  for (const char* text : {"I", "2*I", "trace(I)", "norm(I)", "expm(I)", "sin(I)", "diag(I)",
                           "blkdiag(I, A)", "max(I, A)", "I(1, 1)", "2/I", "s^I"}) {
    const InputError error = input_error([&] { world(text); });
    EXPECT_NE(error.message().find("eye(n)"), std::string::npos) << text << ": " << error.what();
  }
  for (const char* text : {"B + I", "I - B"}) {
    const InputError error = input_error([&] { world(text); });
    EXPECT_NE(error.message().find("3 x 2"), std::string::npos) << text << ": " << error.what();
  }
  EXPECT_NE(input_error([&] {
              world("I", Shape{2, 3});
            })
                .message()
                .find("2 x 3"),
            std::string::npos);
}

TEST_F(Identity, OnlyAZeroStretches) {
  EXPECT_NE(input_error([&] {
              world("1", Shape{2, 2});
            })
                .message()
                .find("expected 2 x 2"),
            std::string::npos);
  EXPECT_NE(input_error([&] { world("A + 1"); }).message().find("s*I"), std::string::npos);
}

}  // namespace
}  // namespace gainsmith::expr
