// The projections as functions of the language.
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <string>

#include "expr/program/number_type.h"
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

class ConvexProjections : public Projections {
 protected:
  /// The derivative by a name, against differences.
  void expect_derivative(const std::string& text, const std::string& name) {
    const Matrix slope = world("jacobian(" + text + ", " + name + ")");
    const Matrix at = world.values.find(name)->second;
    for (Eigen::Index j = 0; j < at.size(); ++j) {
      constexpr double kStep = 1e-5;
      const auto moved = [&](double by) {
        Matrix there = at;
        there(j) += by;
        return World(world).set(name, there)(text);
      };
      const Matrix difference = (moved(kStep) - moved(-kStep)) / (2 * kStep);
      EXPECT_LT(relative_difference(slope.col(j), difference.reshaped()), 1e-8)
          << text << " by " << name;
    }
  }
};

TEST_F(ConvexProjections, AreTheProjectionsOfTheirOwn) {
  EXPECT_EQ(world("project_convex(x, P, [box*x - 1])"),
            world("project_polytope(x, P, box, ones(4, 1))"));
  EXPECT_LT(relative_difference(world("project_convex(x, P, (x - 1)'*P^2*(x - 1) - 2)"),
                                world("project_ellipsoid(x, P, [1; 1], P^2, 2)")),
            1e-15);
  EXPECT_LT(relative_difference(world("project_convex(x, P, [C*x - 2; 2 - C*x])"),
                                world("project_affine(x, P, C, 2)")),
            1e-15);
  EXPECT_EQ(world("project_convex(x, I, norm(x) - 2.5)"), world("x/2"));
  EXPECT_EQ(world("project_convex(x, P, x'*x - 25)"), world("x"));
}

TEST_F(ConvexProjections, TakeAnExpressionOfAnyName) {
  world.define("f(v)", "[v'*v - 4; -C*v]").define("onto(v)", "project_convex(v, P, f(v))");
  world.define("y", "2*x");
  const Matrix z = world("onto(y)");
  EXPECT_EQ(z, world("onto(2*x)"));
  EXPECT_EQ(z, world("project_convex(y, P, f(y))"));
  EXPECT_LT(z.norm(), 2 + 1e-15);
}

/// Dykstra's algorithm: projections onto two sets in turn, each with a correction.
TEST_F(ConvexProjections, AreTheLimitOfProjectionsInTurn) {
  std::mt19937 random(3);
  for (int k = 0; k < 20; ++k) {
    const Matrix G = random_matrix(random, 3, 3), x = 4 * random_matrix(random, 3, 1);
    world.set("x", x).set("P", G.transpose() * G + 0.2 * Matrix::Identity(3, 3));
    world.set("a", random_matrix(random, 1, 3));
    Matrix z = x, u = Matrix::Zero(3, 1), v = u;
    for (double moved = 1; moved > 1e-13;) {
      const Matrix p = World(world).set("z", z + u)("project_ellipsoid(z, P, 0, I, 1)");
      u += z - p;
      const Matrix q = World(world).set("z", p + v)("project_polytope(z, P, a, 0.1)");
      v += p - q;
      moved = (z - q).norm() + (p - q).norm();
      z = q;
    }
    EXPECT_LT(relative_difference(world("project_convex(x, P, [x'*x - 1; a*x - 0.1])"), z), 1e-10);
  }
}

TEST_F(ConvexProjections, AreNearestAmongThePointsOfTheSet) {
  std::mt19937 random(4);
  world.define("c(v)", "[log(sum(exp(M*v))) - 2; exp(v(1)) + v(2)^4 - 3; norm(v - 1) - 2]");
  int outside = 0;
  for (int k = 0; k < 50; ++k) {
    const Matrix x = 4 * random_matrix(random, 2, 1), G = random_matrix(random, 2, 2);
    world.set("x", x).set("P", G.transpose() * G + 0.1 * Matrix::Identity(2, 2));
    world.set("M", random_matrix(random, 3, 2));
    const Matrix P = world("P"), z = world("project_convex(x, P, c(x))");
    EXPECT_LE(World(world).set("z", z)("c(z)").maxCoeff(), 1e-14);
    outside += z != x;
    for (int i = 0; i < 100; ++i) {
      const Matrix w = z + 2 * random_matrix(random, 2, 1);
      if (World(world).set("w", w)("c(w)").maxCoeff() > 0) continue;
      EXPECT_LE((x - z).col(0).dot((P * (w - z)).col(0)), 1e-13);
    }
  }
  EXPECT_GT(outside, 25);
}

/// Tangents of -log reach points below 0.
TEST_F(ConvexProjections, GoRoundPointsWithoutAValue) {
  world.set("x", Matrix{{0.001}, {5}});
  const Matrix z = world("project_convex(x, I, [-log(x(1)) - log(3 - x(2)/2); x(1) - 0.5])");
  EXPECT_EQ(z(0), 0.5);
  EXPECT_NEAR(z(1), 2, 1e-15);
}

TEST_F(ConvexProjections, HaveADerivative) {
  world.set("r", 2).set("m", Matrix{{0.5}, {-0.25}});
  // Within the set, on a curve, and at a corner.
  const std::string curve = "project_convex(x, P, [(x - m)'*P*(x - m) - r^2; C*x - 10])";
  const std::string corner = "project_convex(x, P, [norm(x - m) - r; -C*x - 1; exp(x(1)) - 50])";
  const std::string within = "project_convex(x, P, x'*x - 100*r)";
  for (const std::string& text : {curve, corner, within})
    for (const std::string name : {"x", "P", "m", "r", "C"})
      if (text != within || name == "x" || name == "r") expect_derivative(text, name);
  EXPECT_EQ(world("jacobian(" + within + ", x)"), Matrix::Identity(2, 2));
}

TEST_F(ConvexProjections, ShapesFollowFromX) {
  expect("1 + project_convex(wide, I, wide(1, 1))(1)", 20, "needs a column x, not wide (2 x 3)");
  expect("project_convex(x, wide, x)", 19, "wide (2 x 3) has the wrong shape");
  expect("project_convex(x, P, x')", 22, "needs a column c, an element for each function");
  expect("project_convex(2*x, P, x)", 16, "project_convex(x, P, c) needs a name x");
  expect("project_convex(x, P)", 1, "is written project_convex(x, P, c)");
}

TEST_F(ConvexProjections, WithoutAResultAreShownWhereTheyStand) {
  expect("1 + project_convex(x, P, [x'*x - 1; 2 - x(1)])(1)", 5,
         "project_convex: the set is empty, or c is not convex");
  expect("project_convex(x, -P, x'*x - 1)", 1, "project_convex: P is not positive definite");
  expect("project_convex(x, P, [C*x - 9; 50 - x'*x])", 1, "project_convex: c(2) is not convex");
  expect("project_convex(x, P, sin(x(1)) + 0.1)", 1, "is not convex");
  expect("project_convex(x, P, exp(x(1)))", 1, "no nearest point is found");
  expect("project_convex(x, P, max(C*x + 9, 0)^2)", 1, "must be below 0 somewhere");
  expect("project_convex(x, P, log(x(2)) + 9)", 1, "log of -4, at [3; -4]");
  expect("project_convex(x, P, norm(x - [3; -4]) + 1)", 1, "norm has no derivative, at [3; -4]");
  world.set("nowhere", Matrix::Constant(2, 1, std::numeric_limits<double>::quiet_NaN()));
  expect("project_convex(nowhere, P, nowhere)", 1, "is not a finite number");
  expect("project_convex(x, P, nowhere + x)", 1, "is not a finite number");
}

}  // namespace
}  // namespace gainsmith::expr
