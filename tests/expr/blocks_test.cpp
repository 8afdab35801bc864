#include <gtest/gtest.h>

#include <random>

#include "expr/world.h"
#include "support/input_error.h"

namespace gainsmith::expr {
namespace {

using tests::input_error;

class Blocks : public testing::Test {
 protected:
  Blocks() {
    std::mt19937 random(1);
    P = random_matrix(random, 2, 2);
    B = random_matrix(random, 2, 3);
    R = random_matrix(random, 3, 3);
    world.set("P", P).set("B", B).set("R", R).set("s", 2.5);
  }
  /// [a, b; c, d] by hand.
  static Matrix block(const Matrix& a, const Matrix& b, const Matrix& c, const Matrix& d) {
    Matrix result(a.rows() + c.rows(), a.cols() + b.cols());
    result.topLeftCorner(a.rows(), a.cols()) = a;
    result.topRightCorner(b.rows(), b.cols()) = b;
    result.bottomLeftCorner(c.rows(), c.cols()) = c;
    result.bottomRightCorner(d.rows(), d.cols()) = d;
    return result;
  }
  InputError refused(const std::string& text) const {
    return input_error([&] { world(text); });
  }
  World world;
  Matrix P, B, R;
};

TEST_F(Blocks, NumbersMakeATable) {
  const Matrix table{{1, 2}, {3, -4.5}};
  EXPECT_EQ(world("[1, 2; 3, -4.5]"), table);
  EXPECT_EQ(world("[0, 1; 0, 0]"), (Matrix{{0, 1}, {0, 0}}));
  EXPECT_EQ(world("[0, 0]"), Matrix::Zero(1, 2));
  EXPECT_EQ(world("[s; 0]"), (Matrix{{2.5}, {0}}));
  EXPECT_EQ(world("[5]")(0, 0), 5);
}

TEST_F(Blocks, MatricesAreLaidOutRowByRow) {
  EXPECT_EQ(world("[P, B; B', R]"), block(P, B, B.transpose(), R));
  EXPECT_EQ(world("[B', R]").cols(), 5);
  EXPECT_EQ(world("[[P, B]; [B', R]]"), block(P, B, B.transpose(), R));
  EXPECT_EQ(world("[P]"), P);
}

TEST_F(Blocks, RowsMayBeCutInOtherPlaces) {
  EXPECT_EQ(world("[zeros(1, 3); 2*eye(2), zeros(2, 1)]"),
            (Matrix{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}));
  EXPECT_EQ(world("[P, B; zeros(1, 4), 1; eye(5)]"), world("[[P, B]; [zeros(1, 4), 1]; eye(5)]"));
  EXPECT_NE(refused("[P, B; zeros(1, 4)]").message().find("does not fit"), std::string::npos);
  EXPECT_NE(refused("[1, 2; 3]").message().find("does not fit"), std::string::npos);
}

TEST_F(Blocks, AStarIsTheTransposeOfTheMirroredEntry) {
  EXPECT_EQ(world("[P, B; *, R]"), block(P, B, B.transpose(), R));
  EXPECT_EQ(world("[P, *; B', R]"), block(P, B, B.transpose(), R));
  EXPECT_EQ(world("[P, 2*B; *, -s*I]"),
            block(P, 2 * B, 2 * B.transpose(), -2.5 * Matrix::Identity(3, 3)));
  const Matrix three = world("[P, B, 0; *, R, R; *, *, I]");
  ASSERT_EQ(three.rows(), 8);
  EXPECT_EQ(three.block(2, 0, 3, 2), B.transpose());
  EXPECT_EQ(three.block(5, 0, 3, 2), Matrix::Zero(3, 2));
  EXPECT_EQ(three.block(5, 2, 3, 3), R.transpose());
  EXPECT_EQ(three.block(5, 5, 3, 3), Matrix::Identity(3, 3));
}

TEST_F(Blocks, IdentityAndZeroTakeTheSizeOfTheirRowAndColumn) {
  EXPECT_EQ(world("[P, B; 0, I]"), block(P, B, Matrix::Zero(3, 2), Matrix::Identity(3, 3)));
  EXPECT_EQ(world("[0, B; B', 0]"),
            block(Matrix::Zero(2, 2), B, B.transpose(), Matrix::Zero(3, 3)));
}

TEST_F(Blocks, AMirroredBlockIsCutAlikeBothWays) {
  // The width of the second column follows from B; its height from being mirrored.
  EXPECT_EQ(world("[P, B; *, 0]"), block(P, B, B.transpose(), Matrix::Zero(3, 3)));
}

TEST_F(Blocks, ABlockWhoseMirroredPartsDoNotFitIsRefused) {
  // Rows of 2 and 1, columns of 3 and 1: the transpose of a 2 x 1 does not fill a 1 x 3 place.
  const InputError error = refused("[ones(2, 3), ones(2, 1); *, 1]");
  EXPECT_NE(error.message().find("2 x 3"), std::string::npos) << error.what();
}

TEST_F(Blocks, SizesThatClashAreShownAtTheEntry) {
  const InputError row = refused("[P, R]");
  EXPECT_EQ(row.place().column, 5);
  EXPECT_NE(row.message().find("R (3 x 3)"), std::string::npos) << row.what();
  EXPECT_NE(row.message().find("size 2"), std::string::npos) << row.what();
  const InputError column = refused("[P;\n R]");
  EXPECT_EQ(column.place().line, 2);
  EXPECT_EQ(column.place().column, 2);
  EXPECT_NE(refused("[P, 1]").message().find("1 (1 x 1)"), std::string::npos);
  EXPECT_NE(refused("[B, I; B, B]").message().find("multiple of I"), std::string::npos);
}

TEST_F(Blocks, SizesThatCannotBeToldAreRefused) {
  for (const char* text : {"[I, 0]", "[I, 0; 0, R]", "[P; 0]", "[I, I]", "[0, *; 0, 0]"})
    EXPECT_NE(refused(text).message().find("cannot be told"), std::string::npos)
        << text << ": " << refused(text).what();
}

TEST_F(Blocks, AStarNeedsAnEntryToMirrorAndASquareArrangement) {
  EXPECT_NE(refused("[*, B; B', R]").message().find("not given"), std::string::npos);
  EXPECT_NE(refused("[P, *; *, R]").message().find("not given"), std::string::npos);
  EXPECT_NE(refused("[P, *]").message().find("as many rows as columns"), std::string::npos);
  EXPECT_NE(refused("[*]").message().find("not given"), std::string::npos);
}

}  // namespace
}  // namespace gainsmith::expr
