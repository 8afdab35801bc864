// The projections as functions of the language.
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "expr/number_type.h"
#include "expr/world.h"
#include "support/input_error.h"

namespace gainsmith::expr {
namespace {

using tests::input_error;

class Projections : public testing::Test {
 protected:
  Projections() {
    world.set("x", Matrix{{3}, {-4}}).set("P", Matrix{{2, 1}, {1, 3}}).set("C", Matrix{{1, 2}});
    world.set("box", Matrix{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}).set("wide", Matrix::Ones(2, 3));
  }
  void expect(const std::string& text, int column, const std::string& part) const {
    const InputError error = input_error([&] { world(text); });
    EXPECT_EQ(error.place(), (Place{"test", 1, column})) << text << ": " << error.what();
    EXPECT_NE(error.message().find(part), std::string::npos) << text << ": " << error.what();
  }
  World world;
};

TEST_F(Projections, OntoEquationsIsTheFormulaOfTheRedesign) {
  const Matrix found = world("project_affine(x, P, C, 2)");
  EXPECT_LT(relative_difference(found, world("x - inv(P)*C'*inv(C*inv(P)*C')*(C*x - 2)")), 1e-14);
  EXPECT_LT(relative_difference(found, world("project_polytope(x, P, [C; -C], [2; -2])")), 1e-14);
}

TEST_F(Projections, OntoABoxOfTheMetricIIsTheClip) {
  EXPECT_EQ(world("project_polytope(x, I, box, ones(4, 1))"), world("clip(x, -1, 1)"));
  EXPECT_EQ(world("project_polytope(x, 2*I, I, 0)"), world("min(x, 0)"));
  EXPECT_EQ(world("project_polytope(x, P, box, 8*ones(4, 1))"), world("x"));
}

TEST_F(Projections, OntoABallShortens) {
  EXPECT_EQ(world("project_ellipsoid(x, I, 0, I, 6.25)"), world("x/2"));
  EXPECT_EQ(world("project_ellipsoid(x, P, 0, I, 25)"), world("x"));
  EXPECT_EQ(world("project_ellipsoid(x, P, [1; 1], I, 0)"), world("[1; 1]"));
}

TEST_F(Projections, ShapesFollowFromX) {
  expect("1 + project_polytope(wide, I, I, 0)(1)", 22, "needs a column x, not wide (2 x 3)");
  expect("project_polytope(x, wide, box, ones(4, 1))", 21, "wide (2 x 3) has the wrong shape");
  expect("project_polytope(x, 2, box, ones(4, 1))", 21, "expected 2 x 2");
  expect("project_polytope(x, P, wide, x)", 24, "A with 2 columns, as many as x has rows");
  expect("project_polytope(x, P, box, x)", 29, "expected 4 x 1");
  expect("project_affine(x, P, C, x)", 25, "expected 1 x 1");
  expect("project_ellipsoid(x, P, C, I, 1)", 25, "expected 2 x 1");
  expect("project_ellipsoid(x, P, 0, C, 1)", 28, "expected 2 x 2");
  expect("project_ellipsoid(x, P, 0, I, x)", 31, "expected 1 x 1");
  expect("project_affine(I, P, C, 1)", 16, "size of the identity");
  expect("project_affine(x, P, C)", 1, "is written project_affine(x, P, A, b)");
}

TEST_F(Projections, WithoutAResultAreShownWhereTheyStand) {
  expect("x + project_polytope(x, P, [1, 0; -1, 0], [0; -1])", 5,
         "project_polytope: the polytope is empty");
  expect("project_polytope(x, -P, box, ones(4, 1))", 1,
         "project_polytope: P is not positive definite");
  expect("project_ellipsoid(x, C'*C, 0, I, 1)", 1, "project_ellipsoid: P is not positive definite");
  expect("project_ellipsoid(x, P, 0, -P, 1)", 1,
         "project_ellipsoid: Q is not positive semidefinite");
  expect("project_ellipsoid(x, P, 0, I, -1)", 1, "project_ellipsoid: the ellipsoid is empty");
  expect("project_affine(x, P, [1, 0; 1, 0], [0; 1])", 1,
         "project_affine: the affine set is empty");
}

TEST_F(Projections, OfWhatIsNoNumberAreRefused) {
  world.set("nowhere", Matrix::Constant(2, 1, std::numeric_limits<double>::quiet_NaN()));
  expect("project_polytope(nowhere, P, box, ones(4, 1))", 1, "is not a finite number");
  expect("project_ellipsoid(x, P, nowhere, I, 1)", 1, "is not a finite number");
  expect("project_affine(nowhere, P, C, 1)", 1, "is not a finite number");
}

}  // namespace
}  // namespace gainsmith::expr
