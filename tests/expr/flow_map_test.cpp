// flow_map(e, x, d): closed forms, the group of a flow, derivatives, what cannot be moved.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "expr/world.h"
#include "support/input_error.h"

namespace gainsmith::expr {
namespace {

using tests::input_error;

class FlowMaps : public testing::Test {
 protected:
  FlowMaps() {
    std::mt19937 random(11);
    world.set("A", random_matrix(random, 3, 3)).set("b", random_matrix(random, 3, 1));
    world.set("x", random_matrix(random, 3, 1)).set("z", random_matrix(random, 2, 1));
    world.set("c", 0.3).set("d", 0.8).set("t", 0.4);
    world.define("f(v)", "[v(2); -9.81*sin(v(1)) - c*v(2)]");
    world.define("F(v, s)", "flow_map(f(v), v, s)");
  }
  void expect(const std::string& text, const std::string& value, double error = 1e-12) const {
    EXPECT_LT(relative_difference(world(text), world(value)), error) << text;
  }
  std::string refusal(const std::string& text) const {
    return input_error([&] { world(text); }).message();
  }
  World world;
};

TEST_F(FlowMaps, OfAffineRatesAreExponentials) {
  for (const double d : {0.8, -0.8, 3.0, -3.0, 1e-9, 20.0}) {
    world.set("d", d);
    expect("flow_map(A*x, x, d)", "expm(A*d)*x");
    expect("[flow_map(A*x + b, x, d); 1]", "expm([A, b; zeros(1, 3), 0]*d)*[x; 1]");
    expect("flow_map(c, c, d)", "c*exp(d)");
    expect("flow_map(b, x, d)", "x + d*b");
    expect("flow_map(A*b, b, d)", "expm(A*d)*b");
  }
}

TEST_F(FlowMaps, OfMatricesKeepTheirShape) {
  world.define("P", "A*A'");
  expect("flow_map(b*ones(1, 3), A, d)", "A + d*b*ones(1, 3)");
  expect("flow_map(c*A, A, d)", "exp(c*d)*A");
  expect("flow_map(b*b', P, d)", "A*A' + d*b*b'");
}

TEST_F(FlowMaps, ForNoTimeNothingMoves) {
  EXPECT_EQ(world("flow_map(f(z), z, 0)"), world("z"));
  EXPECT_EQ(world("flow_map(z/(z(1) - z(1)), z, 0)"), world("z")) << "and e is not looked at";
  expect("jacobian(flow_map(f(z), z, 0), z)", "eye(2)", 1e-15);
  world.define("back(v)", "flow_map(f(z), z, v)").define("rate(v)", "jacobian(back(v), v)");
  expect("rate(0)", "f(z)", 1e-15);
}

TEST_F(FlowMaps, ComeBackAndGoOn) {
  std::mt19937 random(3);
  for (int k = 0; k < 10; ++k) {
    world.set("z", 2 * random_matrix(random, 2, 1));
    expect("F(F(z, d), -d)", "z");
    expect("F(F(z, 0.3), 0.5)", "F(z, d)");
    expect("F(F(z, 1.3), -0.5)", "F(z, d)");
  }
}

TEST_F(FlowMaps, MeetClosedForms) {
  expect("flow_map(c - c^2, c, d)", "c*exp(d)/(1 - c + c*exp(d))", 1e-14);
  expect("flow_map(c^2, c, 3.2)", "c/(1 - 3.2*c)", 1e-12);
  expect("flow_map(-c^3, c, 100)", "c/sqrt(1 + 200*c^2)", 1e-13);
  expect("flow_map([-2*z(1); z(1)^2], z, d)", "[z(1)*exp(-2*d); z(2) + z(1)^2*(1 - exp(-4*d))/4]",
         1e-14);
}

TEST_F(FlowMaps, CrossKinksAndJumps) {
  expect("flow_map(-abs(c - 1) - 1, c, 1)", "2 - (2 - c)*exp(1)", 1e-13);
  expect("flow_map(where(c < 0.5, 1, 2), c, d)", "0.5 + 2*(d - 0.2)", 1e-9);
  world.set("z", 0.25 * Matrix::Ones(2, 1));
  expect("flow_map([1; abs(z(1) - 1)], z, 2)", "[2.25; 0.25 + 0.75^2/2 + 1.25^2/2]", 2e-11);
}

TEST_F(FlowMaps, HaveTheDerivativesOfClosedForms) {
  expect("jacobian(flow_map(A*x + b, x, d), x)", "expm(A*d)");
  expect("jacobian(flow_map(A*x, x, d), d)", "A*expm(A*d)*x");
  expect("jacobian(flow_map(c - c^2, c, d), c)", "exp(d)/(1 - c + c*exp(d))^2");
  expect("jacobian(flow_map(b, x, d), b)", "d*eye(3)");
  expect("jacobian(expm(A*c)*x, c)", "jacobian(flow_map(A*x, x, c), c)");
}

TEST_F(FlowMaps, HaveTheDerivativesOfDifferenceQuotients) {
  std::mt19937 random(5);
  world.define("q(v)", "F(v, 0.7)").define("p(v)", "flow_map(v*f(z), z, d + v)");
  world.define("g(w)", "flow_map([z(2); -w*sin(z(1))], z, -d)");
  world.define("dp(v)", "jacobian(p(v), v)").define("dg(w)", "jacobian(g(w), w)");
  for (int k = 0; k < 5; ++k) {
    world.set("z", 2 * random_matrix(random, 2, 1));
    expect("jacobian(F(z, 0.7), z)",
           "[q(z + [1e-5; 0]) - q(z - [1e-5; 0]), q(z + [0; 1e-5]) - q(z - [0; 1e-5])]/2e-5", 1e-8);
    expect("dp(c)", "(p(c + 1e-5) - p(c - 1e-5))/2e-5", 1e-8);
    expect("dg(c)", "(g(c + 1e-5) - g(c - 1e-5))/2e-5", 1e-8);
    expect("jacobian(F(z, d), d)", "f(F(z, d))", 1e-12);
  }
}

TEST_F(FlowMaps, MoveTheTimeAlong) {
  world.scope.time = "t";
  expect("flow_map(cos(t), c, d)", "c + sin(t + d) - sin(t)", 1e-14);
  expect("flow_map(cos(t), c, -d)", "c + sin(t - d) - sin(t)", 1e-14);
  expect("flow_map(-c + t, c, d)", "t + d - 1 + (c - t + 1)*exp(-d)", 1e-14);
  expect("jacobian(flow_map(cos(t), c, d), t)", "cos(t + d) - cos(t)", 1e-13);
  expect("jacobian(flow_map(c*cos(t), c, d), d)", "c*cos(t + d)*exp(sin(t + d) - sin(t))", 1e-13);
  world.scope.time.clear();
  expect("flow_map(cos(t), c, d)", "c + d*cos(t)", 1e-15);
}

TEST_F(FlowMaps, NestAndStandInDefinitions) {
  world.define("inner(v)", "flow_map(-v, v, 0.5)").define("y", "2*z");
  expect("flow_map(inner(z), z, d)", "exp(d*exp(-0.5))*z");
  expect("flow_map(-y, y, d)", "2*exp(-d)*z");
  expect("jacobian(flow_map(inner(z), z, d), z)", "exp(d*exp(-0.5))*eye(2)");
  expect("flow_map(-x + b, x, d)", "b + exp(-d)*(x - b)");
}

TEST_F(FlowMaps, PassOverNoBranch) {
  world.set("z", Matrix::Zero(2, 1));
  // A tent of the area 1e-3, a band of the width 1e-4, and one that begins within another.
  expect("flow_map([1; max(0, 1 - abs(z(1) - 1.2345)/0.001)], z, 3)", "[3; 0.001]", 1e-9);
  expect("flow_map([1; where(z(1) > 1.26, where(z(1) < 1.2601, 1, 0), 0)], z, 3)", "[3; 0.0001]",
         1e-10);
  expect("flow_map([1; sign(z(1) - 1) - sign(z(1) - 1.0001)], z, 3)", "[3; 0.0002]", 1e-10);
  expect("flow_map([1; floor(z(1))], z, 3)", "[3; 3]", 1e-10);
  expect("flow_map([1; mod(z(1), 0.5)], z, 3)", "[3; 0.75]", 1e-10);
  expect("flow_map(-z.*abs(z), z, 1)", "0*z", 1e-15);
  world.scope.time = "t";
  expect("flow_map(where(t > 7, where(t < 7.0001, 1, 0), 0), c, 7)", "c + 0.0001", 1e-10);
}

TEST_F(FlowMaps, HaveNoDerivativeAcrossAJump) {
  // c comes to 1/2 after 0.2: c + d -> 0.5 + 2 (d - 0.2), whose derivative is 2 and not 1.
  EXPECT_EQ(refusal("jacobian(flow_map(where(c < 0.5, 1, 2), c, d), c)"),
            "jacobian: the flow_map has no derivative at this point");
  EXPECT_EQ(refusal("jacobian(flow_map(2 + sign(c - 0.5), c, d), c)"),
            "jacobian: the flow_map has no derivative at this point");
  expect("jacobian(flow_map(where(c < 5, 1, 2), c, d), c)", "1");
  // The jump comes when it comes.
  world.scope.time = "t";
  expect("jacobian(flow_map(where(t > 0.5, 2, 1)*c, c, 0.3), c)", "exp(0.5)", 1e-10);
  // Kinks have one.
  expect("jacobian(flow_map(-abs(c - 1) - 1, c, 1), c)", "exp(1)", 1e-12);
}

TEST_F(FlowMaps, SayWhereTheyEnd) {
  const std::string escaped = refusal("1 + flow_map(c^2, c, 10)");
  EXPECT_NE(escaped.find("flow_map: moved for the time 10 it comes to 3.33333"), std::string::npos)
      << escaped;
  EXPECT_NE(escaped.find("it leaves every bound there"), std::string::npos) << escaped;
  EXPECT_NE(refusal("flow_map(sqrt(c), c, -5)").find("comes to -1.095"), std::string::npos);
  EXPECT_NE(refusal("flow_map(-sqrt(c) - 1, c, 1)").find("sqrt of -"), std::string::npos)
      << refusal("flow_map(-sqrt(c) - 1, c, 1)");
  EXPECT_NE(refusal("flow_map(-1e9*(c - sin(t)), c, 10)").find("stiff"), std::string::npos);
  world.set("z", Matrix::Zero(2, 1));
  EXPECT_EQ(refusal("jacobian(flow_map(norm(z)*z, z, d), z)"),
            "jacobian: the norm has no derivative at this point");
}

TEST_F(FlowMaps, SayWhatCannotBeMoved) {
  EXPECT_NE(refusal("flow_map(z, 2*z, d)").find("flow_map(e, x, d) needs a name x"),
            std::string::npos);
  EXPECT_NE(refusal("flow_map(x, z, d)").find("2 x 1"), std::string::npos);
  EXPECT_NE(refusal("flow_map(z, z, z)").find("1 x 1"), std::string::npos);
  EXPECT_NE(refusal("flow_map(z, z)").find("flow_map"), std::string::npos);
  world.scope.without_past["c"] = "c is measured";
  EXPECT_EQ(refusal("F(z, d)"), "flow_map: c is measured");
  EXPECT_EQ(refusal("jacobian(F(z, d), z)"), "flow_map: c is measured");
  expect("flow_map(-c, c, d)", "c*exp(-d)");
  expect("flow_map(-z, z, c)", "exp(-c)*z");
}

TEST_F(FlowMaps, ErrorsStandAtTheCall) {
  EXPECT_EQ(input_error([&] { world("1 + flow_map(c^2, c, 10)"); }).place().column, 5);
}

}  // namespace
}  // namespace gainsmith::expr
