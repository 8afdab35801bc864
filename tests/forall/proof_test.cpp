#include "forall/proof.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <random>
#include <string>

#include "forall/variables.h"
#include "numbers/dense/definite.h"
#include "numbers/dense/dense.h"
#include "support/linear_algebra.h"

namespace gainsmith::forall {
namespace {

using numbers::Enclosed;
using numbers::Matrix;
using Status = DomainProof::Status;
using testing::interval;
using testing::number;

template <class S = double>
DomainProof prove(const std::string& text, const Domain& domain, const numbers::Values& known = {},
                  bool strict = true, const ProofOptions& options = {}) {
  numbers::EnclosedValues<S> enclosed;
  for (const auto& [name, value] : known)
    enclosed[name] = numbers::exactly<S>(value.template cast<S>());
  return prove_on_domain<S>(testing::program(text, domain, known), domain, enclosed, strict, {},
                            options);
}

/// The smallest eigenvalue of the text at a point, in double.
double value_at(const std::string& text, const Domain& domain, const Point& point,
                numbers::Values known = {}) {
  const auto program = testing::program(text, domain, known);
  for (const auto& [name, value] : point.values) known[name] = value;
  return numbers::smallest_eigenvalue(numbers::evaluate(program, known));
}

void expect_fails(const std::string& text, const Domain& domain, const numbers::Values& known = {},
                  bool strict = true) {
  const DomainProof proof = prove(text, domain, known, strict);
  ASSERT_EQ(proof.status, Status::fails) << text << ": " << proof.where << " " << proof.reason;
  EXPECT_LE(value_at(text, domain, *proof.point, known), 1e-15) << text;
}

void expect_holds(const std::string& text, const Domain& domain, const numbers::Values& known = {},
                  bool strict = true) {
  const DomainProof proof = prove(text, domain, known, strict);
  EXPECT_EQ(proof.status, Status::holds) << text << ": " << proof.where << " " << proof.reason;
}

const Domain kUnit = {interval("t", 0, 1)};

/// Narrow and steep: what lies between the points of any grid.
TEST(ProofTest, SpikesBumpsAndCuspsAreFound) {
  expect_fails("0.4 - max(0, 1 - 1e5*abs(t - 0.3001))", kUnit);
  expect_fails("0.4 - exp(-1e8*(t - 0.3001)^2)", kUnit);
  expect_fails("0.94 - (1 - where(t > 0.3, 3, 1)*abs(t - 0.3)^0.1)", kUnit);
  expect_fails("0.999985 - (1 - where(t > 0.3, 1, 3)*sqrt(abs(t - 0.3)))", kUnit);
  expect_fails("1 - (1 + 2e-7*(exp(-1e6*t) - exp(-2e6*t)))", kUnit, {}, false);
}

TEST(ProofTest, SpikesBumpsAndCuspsThatHold) {
  expect_holds("1.0001 - max(0, 1 - 1e5*abs(t - 0.3001))", kUnit);
  expect_holds("1.0001 - exp(-1e8*(t - 0.3001)^2)", kUnit);
  expect_holds("1.0001 - (1 - where(t > 0.3, 3, 1)*abs(t - 0.3)^0.1)", kUnit);
  expect_holds("1.000001 - (1 - where(t > 0.3, 1, 3)*sqrt(abs(t - 0.3)))", kUnit);
  expect_holds("1.00001 - (1 + 2e-7*(exp(-1e6*t) - exp(-2e6*t)))", kUnit);
}

/// The variable stands in the jacobian's place, or beside it, or both; where its slope is known few
/// pieces do.
TEST(ProofTest, Jacobians) {
  const numbers::Values known = {{"x0", number(0.5)}};
  expect_fails("jacobian(x0*(t - 0.3)^2, x0) - 0.01", kUnit, known);
  expect_fails("jacobian((t - 0.3)^3 + 0.01*t, t) - 0.02", kUnit);
  expect_holds("jacobian(x0*(t - 0.3)^2, x0) + 0.01", kUnit, known);
  const Domain box = {interval("t", -1, 1), interval("u", -1, 1)};
  expect_fails("jacobian(t^3*u^2 + 0.001*t, t) - 0.002", box);
  for (const std::string text :
       {"jacobian(sin(t)*cos(u) + t^3*u^2, t) + 1e-2", "jacobian(t^3/(2 + cos(t*u)), t) + 1e-2",
        "jacobian(sin(t) + 30*u, t) - 0.5"}) {
    const DomainProof proof = prove(text, box);
    EXPECT_EQ(proof.status, Status::holds) << text << ": " << proof.where << " " << proof.reason;
    EXPECT_LE(proof.pieces, 1000U) << text;
  }
}

/// Kinks and jumps of the slope, beside variables that have neither: few pieces do.
TEST(ProofTest, KinksInOneVariableOfSeveral) {
  const Domain box = {interval("t", -1, 1.3), interval("u", -1, 1), interval("v", -1, 1)};
  for (const std::string text :
       {"jacobian(abs(t)*t, t) + cos(u)*cos(v) - 0.29",
        "[3 - abs(t), sin(u); sin(u), 2 + v*abs(t)/2]",
        "[3 + jacobian(clip(t, -0.4, 0.5), t), 2*sin(u); 2*sin(u), 2 - sin(u)*v*v/2]",
        "1.9 + sin(u)*jacobian(abs(t), t) + cos(v)*jacobian(max(t, 0.2), t)"}) {
    const DomainProof proof = prove(text, box);
    EXPECT_EQ(proof.status, Status::holds) << text << ": " << proof.where << " " << proof.reason;
    EXPECT_LE(proof.pieces, 2000U) << text;
  }
  expect_fails("jacobian(abs(t)*t, t) + cos(u)*cos(v) - 0.3", box);
  expect_fails("1.8 + sin(u)*jacobian(abs(t), t) + cos(v)*jacobian(max(t, 0.2), t) - 1", box);
  // The slope of |t| at 0 is 1, that of max(t, 0) is 1 as well.
  expect_holds("jacobian(abs(t), t) + jacobian(max(t, 0), t) - 1.5", kUnit);
}

/// An arm of two links: a box of four variables, of which the jacobian is affine or quadratic in
/// three, and its inverse has no bound until the fourth is cut.
TEST(ProofTest, AJacobianWithAnInverse) {
  const Domain box = {interval("a", -1.5, 1.5), interval("b", -1.5, 1.5), interval("v", -2, 2),
                      interval("w", -2, 2)};
  const std::string mass = "[5 + 3*cos(b), 1 + 1.5*cos(b); 1 + 1.5*cos(b), 1]";
  const std::string force = "[1.5*sin(b)*w*(2*v + w); -1.5*sin(b)*v^2] - 5*[a; b] - 2*[v; w]";
  const auto column = [&](const std::string& by) {
    return "jacobian(inv(" + mass + ")*(" + force + "), " + by + ")";
  };
  const std::string slope = "[" + column("a") + ", " + column("b") + "]";
  const DomainProof proof = prove("100*I - He(" + slope + ")", box);
  EXPECT_EQ(proof.status, Status::holds) << proof.where << " " << proof.reason;
  EXPECT_LE(proof.pieces, 500U);
  expect_fails("10*I - He(" + slope + ")", box);
}

/// (t - a)^2 + m: O(log 1/m) pieces.
TEST(ProofTest, ParabolasOfKnownHeight) {
  for (const double a : {0.25, 0.3, 0.7131})
    for (int power = 2; power <= 12; ++power) {
      const double m = std::pow(10.0, -power);
      const numbers::Values known = {{"a", number(a)}, {"m", number(m)}};
      const DomainProof proof = prove("(t - a)^2 + m", kUnit, known);
      EXPECT_EQ(proof.status, Status::holds) << a << " " << power << " " << proof.where;
      EXPECT_LE(proof.pieces, 400U) << power;
      // 1 x 1 in other units, and inside a matrix with a large neighbour.
      expect_holds("1e-12*((t - a)^2 + m)", kUnit, known);
      expect_holds("[(t - a)^2 + m, 0; 0, 1e9]", kUnit, known);
      expect_fails("(t - a)^2 - m", kUnit, known);
    }
}

/// A minimum between doubles is still certain: where it is below 0 by less than rounding, open.
TEST(ProofTest, WhatTouchesZeroIsOpen) {
  for (const bool strict : {true, false}) {
    const DomainProof proof = prove("(t - 0.3)^2", kUnit, {}, strict);
    EXPECT_EQ(proof.status, Status::open);
    EXPECT_NE(proof.where.find("t in [0.3, 0.3"), std::string::npos) << proof.where;
    EXPECT_FALSE(proof.reason.empty());
  }
  // Exactly 0 at a double: certain for >, open for >=.
  expect_fails("(t - 0.5)^2", kUnit);
  EXPECT_EQ(prove("(t - 0.5)^2", kUnit, {}, false).status, Status::open);
  // Rows that are 0 everywhere.
  expect_holds("[1 + t, 0; 0, 0]", kUnit, {}, false);
  expect_holds("zeros(2, 2)*t", kUnit, {}, false);
  expect_fails("[1 + t, 0; 0, 0]", kUnit);
}

/// c + Q(t) diag(1, -1) Q(t)' with a rotation: eigenvalues c + 1 and c - 1 for all t.
TEST(ProofTest, Rotations) {
  const Domain domain = {interval("t", 0, 7)};
  const std::string Q = "expm([0, 5; -5, 0]*t)";
  for (const double m : {1e-1, 1e-3}) {
    const numbers::Values known = {{"c", number(1 + m)}};
    expect_holds("c*I + " + Q + "*[1, 0; 0, -1]*" + Q + "'", domain, known);
    const numbers::Values below = {{"c", number(1 - m)}};
    expect_fails("c*I + " + Q + "*[1, 0; 0, -1]*" + Q + "'", domain, below);
  }
}

/// P - e^(A't) P e^(At) e^(-2 a t) + r for a Lyapunov function of random stable A, in any units.
TEST(ProofTest, RandomDecayInAnyUnits) {
  std::mt19937 generator(17);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 12; ++trial) {
    const int n = 2 + trial % 4;
    Matrix A = Matrix::NullaryExpr(n, n, [&] { return normal(generator); });
    // A + A' <= -0.2 I: |e^(At)| decays in the Euclidean norm.
    A -= (0.1 + -0.5 * numbers::smallest_eigenvalue(-(A + A.transpose()))) * Matrix::Identity(n, n);
    Matrix S = Matrix::Zero(n, n);
    for (int i = 0; i < n; ++i) S(i, i) = std::ldexp(1.0, static_cast<int>(4 * normal(generator)));
    const Matrix inverse = tests::inverse(S);
    const Matrix units = tests::product({S, A, inverse});
    const numbers::Values known = {{"A", units}, {"P", tests::product({inverse, inverse})}};
    const std::string decay = "expm(A*t)'*P*expm(A*t)";
    // At t = 0 they are equal.
    expect_holds("1.001*P - " + decay, {interval("t", 0, 3)}, known);
    expect_holds("P - " + decay, {interval("t", 0.1, 3)}, known);
    expect_fails("0.999*P - " + decay, {interval("t", 0, 3)}, known);
  }
}

TEST(ProofTest, KinksInMatrices) {
  const std::string kink =
      "[abs(t - 0.37) + m, 0.5*abs(t - 0.37); 0.5*abs(t - 0.37), max(t, 1 - t)]";
  for (const double m : {1e-2, 1e-6, 1e-10}) {
    expect_holds(kink, kUnit, {{"m", number(m)}});
    expect_fails(kink, kUnit, {{"m", number(-m)}});
  }
  expect_holds("clip(3*t, 0.1, 1) + norm([t - 0.2, t])", kUnit);
  expect_fails("clip(3*t, 0.1, 1) - norm([t - 0.2, t])", kUnit);
}

/// c + cos(40 t) cos(30 s) + 0.1 t + 0.1 s: the minimum is c - 0.99215, near (pi/40, 0).
/// However wide its interval is, and though the slope varies with the others.
TEST(ProofTest, WhatIsAffineInAVariableIsJudgedAtItsEnds) {
  const auto pieces = [](const std::string& text, double limit) {
    const Domain domain = {interval("t", -0.5, 0.5), interval("u", -limit, limit)};
    const DomainProof proof = prove(text, domain, {{"limit", number(limit)}});
    EXPECT_EQ(proof.status, Status::holds) << text << ": " << proof.where;
    return proof.pieces;
  };
  const std::string text = "[1.05*limit, u*cos(t); u*cos(t), 1.05*limit + u*sin(t)^2/20]";
  EXPECT_LE(pieces(text, 1), 40U);
  EXPECT_EQ(pieces(text, 1), pieces(text, 1024));
}

TEST(ProofTest, RandomFormsThatAreAffineInSomeVariables) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto matrix = [&] {
    return Matrix(Matrix::NullaryExpr(3, 3, [&] { return uniform(random); }));
  };
  int held = 0, failed = 0;
  for (int k = 0; k < 40; ++k) {
    numbers::Values known = {{"A", matrix()},
                             {"B", matrix()},
                             {"C", matrix()},
                             {"m", number(1 + 3 * (uniform(random) + 1))}};
    const std::string text = "m*eye(3) + He(sin(2*t)*A + u*cos(3*t)*B + u*v*(1 + t)*C)/2";
    const Domain domain = {interval("t", -1, 1), interval("u", -1, 1), interval("v", -0.5, 1)};
    const DomainProof proof = prove(text, domain, known);
    double least = 1;
    const auto program = testing::program(text, domain, known);
    for (int i = 0; i < 2000; ++i) {
      known["t"] = number(uniform(random));
      known["u"] = number(i % 2 == 0 ? std::copysign(1, uniform(random)) : uniform(random));
      known["v"] = number(i % 4 < 2 ? (uniform(random) < 0 ? -0.5 : 1) : uniform(random) / 2);
      least = std::min(least, numbers::smallest_eigenvalue(numbers::evaluate(program, known)));
    }
    if (proof.status == Status::holds) {
      EXPECT_GT(least, 0) << k;
    }
    held += proof.status == Status::holds ? 1 : 0;
    failed += proof.status == Status::fails ? 1 : 0;
  }
  EXPECT_GE(held, 5);
  EXPECT_GE(failed, 5);
  EXPECT_GE(held + failed, 38);
}

TEST(ProofTest, BoxesOfSeveralVariables) {
  const Domain box = {interval("t", 0, 1), interval("s", 0, 1)};
  const std::string wave = "c + cos(40*t)*cos(30*s) + 0.1*t + 0.1*s";
  expect_holds(wave, box, {{"c", number(0.9925)}});
  expect_fails(wave, box, {{"c", number(0.9915)}});
  expect_holds("m + abs(t - s)", box, {{"m", number(0.01)}});
  expect_holds("[1 + t, s; s, 1.01]", box);
}

TEST(ProofTest, SetsAndPolytopes) {
  const Domain domain = {interval("t", 0, 1), testing::polytope("M", {number(1), number(-3)}),
                         testing::set("k", {number(1), number(2)})};
  expect_holds("4.1*k + M*t", domain);
  const DomainProof failed = prove("2*k + M*t", domain);
  ASSERT_EQ(failed.status, Status::fails);
  EXPECT_EQ(failed.point->values.at("M")(0, 0), -3);
  EXPECT_EQ(failed.point->values.at("k")(0, 0), 1);
  // Elements that are not doubles: a radius of 1 leaves 4 k - 4 open.
  numbers::EnclosedValues<double> none;
  EnclosedElements<double> elements;
  elements["M"] = {numbers::exactly<double>(number(1)), {number(-3), number(1)}};
  EXPECT_EQ(
      prove_on_domain<double>(testing::program("3.9*k + M*t", domain), domain, none, true, elements)
          .status,
      Status::open);
  EXPECT_EQ(
      prove_on_domain<double>(testing::program("4.1*k + M*t", domain), domain, none, true, elements)
          .status,
      Status::holds);
}

TEST(ProofTest, WithoutVariables) {
  expect_holds("[2, 1; 1, 2]", {});
  expect_fails("[1, 2; 2, 1]", {});
  EXPECT_EQ(prove("[1, 1; 1, 1]", {}, {}, false).status, Status::open);
}

/// 1e-25 above 0: double cannot tell, 31 digits can.
TEST(ProofTest, MoreDigitsSettleWhatIsOpenAtAPoint) {
  const std::string text = "(0.1 + 0.2 - 0.3) + 1e-25*(1 + t)";
  EXPECT_EQ(prove<double>(text, kUnit).status, Status::open);
  EXPECT_EQ(prove<DoubleDouble>(text, kUnit).status, Status::holds);
  EXPECT_EQ(prove<Decimal100>("0.1 + 0.2 - 0.3 + 1e-80*(1 + t)", kUnit).status, Status::holds);
  EXPECT_EQ(prove<DoubleDouble>("0.1 + 0.2 - 0.3 - 1e-25*(1 + t)", kUnit).status, Status::fails);
}

TEST(ProofTest, WhatHasNoValueIsOpenWithItsReason) {
  const DomainProof root = prove("1 + sqrt(t - 0.3)", kUnit);
  EXPECT_EQ(root.status, Status::open);
  EXPECT_NE(root.reason.find("sqrt of -0.3"), std::string::npos) << root.reason;
  EXPECT_EQ(prove("2 + 1/(t - 0.3)^2", kUnit).status, Status::open);
  const DomainProof many = prove("1.0001 + cos(1e7*t)", kUnit, {}, true, {500});
  EXPECT_EQ(many.status, Status::open);
  EXPECT_EQ(many.reason, "more pieces than are examined");
  EXPECT_EQ(many.pieces, 500U);
}

TEST(ProofTest, TheSmallestMarginSeen) {
  EXPECT_NEAR(prove("[1, t; t, 1]", {interval("t", -0.5, 0.25)}).margin, 0.5, 1e-12);
}

/// What a flow inequality costs.
TEST(ProofTest, SixBySixExponentials) {
  std::mt19937 generator(4);
  std::normal_distribution<double> normal;
  const int n = 6;
  Matrix A = Matrix::NullaryExpr(n, n, [&] { return normal(generator); });
  A -= (0.3 - 0.5 * numbers::smallest_eigenvalue(-(A + A.transpose()))) * Matrix::Identity(n, n);
  const Domain domain = {interval("t", 0, 1)};
  const DomainProof proof = prove("1.05*I - exp(0.2*t)*expm(A*t)'*expm(A*t)", domain, {{"A", A}});
  EXPECT_EQ(proof.status, Status::holds) << proof.where << proof.reason;
  RecordProperty("pieces", static_cast<int>(proof.pieces));
  EXPECT_LE(proof.pieces, 200U);
}

}  // namespace
}  // namespace gainsmith::forall
