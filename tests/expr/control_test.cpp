// The words of control: ranks, sampling, the equations of Lyapunov and Riccati, eigenvalues, tables.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <random>
#include <string>

#include "expr/world.h"
#include "support/input_error.h"
#include "support/linear_algebra.h"

namespace gainsmith::expr {
namespace {

using tests::input_error;

class Control : public testing::TestWithParam<int> {
 protected:
  Control() : random(static_cast<unsigned>(GetParam())) {
    n = 1 + GetParam() % 6;
    m = 1 + GetParam() % 3;
    world.set("A", random_matrix(random, n, n))
        .set("B", random_matrix(random, n, m))
        .set("F", random_matrix(random, n, n))
        .set("G", random_matrix(random, m, m))
        .set("N", 0.1 * random_matrix(random, n, m));
    world.define("Q", "F*F' + 0.1*eye(" + std::to_string(n) + ")")
        .define("R", "G*G' + 0.1*eye(" + std::to_string(m) + ")");
  }
  double size(const std::string& text) const {
    const Matrix value = world(text);
    return value.size() == 0 ? 0 : value.cwiseAbs().maxCoeff();
  }
  void expect_nothing(const std::string& residual, const std::string& beside) const {
    EXPECT_LE(size(residual), 1e-12 * (1 + size(beside))) << residual;
  }
  double rightmost(const std::string& text) const { return world("eig(" + text + ")")(0, 0); }

  std::mt19937 random;
  World world;
  int n = 0;
  int m = 0;
};

TEST_P(Control, ResidualsOfLyapunov) {
  world.define("X", "lyap(A, F)").define("Y", "dlyap(A, F)");
  SCOPED_TRACE(tests::singular_values(world.values.at("A")).transpose());
  EXPECT_LE(size("A*X + X*A' + F"), 1e-10 * (1 + size("X")));
  EXPECT_LE(size("A*Y*A' - Y + F"), 1e-10 * (1 + size("Y")));
}

TEST_P(Control, ResidualsOfRiccati) {
  world.define("X", "care(A, B, Q, R)").define("K", "inv(R)*B'*X");
  expect_nothing("A'*X + X*A - X*B*inv(R)*B'*X + Q", "X*B*inv(R)*B'*X");
  EXPECT_LT(rightmost("A - B*K"), 0);
  EXPECT_EQ(world("X - X'").cwiseAbs().maxCoeff(), 0);
  world.define("Y", "dare(A, B, Q, R)").define("L", "inv(R + B'*Y*B)*B'*Y*A");
  expect_nothing("A'*Y*A - Y - A'*Y*B*inv(R + B'*Y*B)*B'*Y*A + Q", "Y");
  EXPECT_LT(size("eig(A - B*L)"), 1);
}

TEST_P(Control, ResidualsOfRiccatiWithACrossTerm) {
  world.define("X", "care(A, B, Q, R, N)").define("K", "inv(R)*(X*B + N)'");
  expect_nothing("A'*X + X*A - (X*B + N)*K + Q", "(X*B + N)*K");
  EXPECT_LT(rightmost("A - B*K"), 0);
  world.define("Y", "dare(A, B, Q, R, N)").define("L", "inv(R + B'*Y*B)*(A'*Y*B + N)'");
  expect_nothing("A'*Y*A - Y - (A'*Y*B + N)*L + Q", "Y");
}

TEST_P(Control, RiccatiIsLyapunovOfTheClosedLoop) {
  world.define("X", "care(A, B, Q, R)").define("K", "inv(R)*B'*X").define("E", "A - B*K");
  EXPECT_LE(size("X - lyap(E', Q + K'*R*K)"), 1e-9 * (1 + size("X")));
}

TEST_P(Control, SamplingIsTheVariationOfConstants) {
  world.define("M", "c2d(A, B, 0.3)");
  const std::string cut = ":, " + std::to_string(n + 1) + ":end";
  expect_nothing("M(:, 1:" + std::to_string(n) + ") - expm(0.3*A)", "M");
  expect_nothing("A*M(" + cut + ") - (expm(0.3*A) - I)*B", "M");
}

TEST_P(Control, EigenvaluesAreThoseOfEigen) {
  const Matrix A = random_matrix(random, n, n);
  world.set("A", A);
  const Matrix found = world("eig(A)");
  const auto expected = tests::eigenvalues(A);
  ASSERT_EQ(found.rows(), n);
  for (Eigen::Index i = 0; i < n; ++i) {
    EXPECT_GE(found(std::max<Eigen::Index>(i - 1, 0), 0), found(i, 0));
    double nearest = 1;
    for (Eigen::Index j = 0; j < n; ++j)
      nearest =
          std::min(nearest, std::abs(expected(j) - std::complex<double>(found(i, 0), found(i, 1))));
    EXPECT_LT(nearest, 1e-12);
  }
  EXPECT_NEAR(found.col(0).sum(), A.trace(), 1e-13 * n);
  EXPECT_NEAR(found.col(1).sum(), 0, 1e-15);
}

/// Murray, "Differentiation of the Cholesky decomposition", 2016: dL = L*Phi(inv(L)*dM*inv(L)'), Phi
/// the lower triangle with half of the diagonal.
TEST_P(Control, CholeskyFactorsAreLowerAndHaveTheirDerivative) {
  const Matrix L = world("chol(Q)");
  EXPECT_TRUE(L.isLowerTriangular(0));
  EXPECT_GT(L.diagonal().minCoeff(), 0);
  expect_nothing("chol(Q)*chol(Q)' - Q", "Q");
  // A symmetric direction: the argument is symmetric, and its lower triangle is read.
  world.define("M(s)", "Q + s*(A + A')");
  Matrix inner = world("inv(chol(Q))*(A + A')*inv(chol(Q))'");
  const Matrix lower = inner.triangularView<Eigen::StrictlyLower>();
  const Matrix slope = L * (lower + Matrix(inner.diagonal().asDiagonal()) / 2);
  world.set("s", 0);
  EXPECT_LE((world("jacobian(chol(M(s)), s)") - slope.reshaped()).cwiseAbs().maxCoeff(),
            1e-11 * (1 + slope.cwiseAbs().maxCoeff()));
}

TEST_P(Control, DeterminantsMultiplyAndHaveTheirDerivative) {
  const double det = tests::determinant(world.values.at("A"));
  EXPECT_NEAR(world("det(A)")(0, 0), det, 1e-14 * (1 + std::abs(det)));
  EXPECT_NEAR(world("det(A*F) - det(A)*det(F)")(0, 0), 0, 1e-13);
  const Matrix slope = world("jacobian(det(A), A)");
  const Matrix adjugate = (tests::inverse(world.values.at("A")) * det).transpose();
  EXPECT_LE((slope - adjugate.reshaped().transpose()).cwiseAbs().maxCoeff(), 1e-11);
}

INSTANTIATE_TEST_SUITE_P(Random, Control, testing::Range(1, 13));

class ControlWords : public testing::Test {
 protected:
  void expect(const std::string& text, int column, const std::string& message) const {
    const InputError error = input_error([&] { world(text); });
    EXPECT_NE(error.message().find(message), std::string::npos) << text << ": " << error.what();
    EXPECT_EQ(error.place().column, column) << text;
  }
  World world;
};

TEST_F(ControlWords, EigenvaluesComeInOneOrder) {
  EXPECT_EQ(world("eig([0, 1; -4, 0])"), (Matrix{{0, 2}, {0, -2}}));
  EXPECT_EQ(world("eig(blkdiag([0, 3; -3, 0], [0, 1; -1, 0], -2, 5))"),
            (Matrix{{5, 0}, {0, 1}, {0, -1}, {0, 3}, {0, -3}, {-2, 0}}));
  // A defective eigenvalue is one to rounding.
  EXPECT_LE((world("eig([-1, 1; 0, -1])") - Matrix{{-1, 0}, {-1, 0}}).cwiseAbs().maxCoeff(), 0);
  // What is small beside the matrix, but known, is not 0.
  EXPECT_EQ(world("eig([1, 0; 0, 1e-20])")(1, 0), 1e-20);
  // A companion matrix with the roots 1, ..., 12.
  world.set("roots", Eigen::VectorXd::LinSpaced(12, 1, 12));
  Matrix companion = Matrix::Zero(12, 12);
  Eigen::VectorXd polynomial = Eigen::VectorXd::Zero(13);
  polynomial(0) = 1;
  for (int root = 1; root <= 12; ++root)
    for (int k = root; k >= 1; --k) polynomial(k) -= root * polynomial(k - 1);
  companion.row(0) = -polynomial.tail(12).transpose();
  companion.diagonal(-1).setOnes();
  world.set("T", companion);
  EXPECT_LE((world("eig(T)(:, 1)") - world("roots").colwise().reverse()).cwiseAbs().maxCoeff(),
            1e-12);
}

TEST_F(ControlWords, RanksSaySizes) {
  world.set("M", Matrix{{1, 2, 3}, {2, 4, 6}, {0, 0, 1e-9}});
  EXPECT_EQ(world("rank(M)")(0, 0), 2);
  EXPECT_EQ(world("rank(M, 1e-6)")(0, 0), 1);
  EXPECT_EQ(world("zeros(rank(M), 3)"), (Matrix::Zero(2, 3)));
  EXPECT_EQ(world("M(1:rank(M, 1e-6), :)"), world("M(1, :)"));
  world.scope.symbols["X"] = {{2, 2}, false};
  expect("1 + rank(X)", 10, "must not depend on 'X'");
  expect("rank(M, -1)", 9, "must not be negative");
  EXPECT_NEAR(world("cond([2, 0; 0, 1e-3])")(0, 0), 2000, 1e-9);
  expect("cond(zeros(2))", 1, "cond: a singular value is 0");
}

TEST_F(ControlWords, OnlyDefiniteMatricesHaveACholeskyFactor) {
  for (const char* text : {"chol([1, 2; 2, 1])", "chol([1, 1; 1, 1])", "chol([0, 1; 1, 2])",
                           "chol(zeros(3))", "chol(-1)"})
    expect(text, 1, "chol: the matrix is not positive definite");
  expect("chol([1, 2])", 6, "square");
  EXPECT_EQ(world("chol([4, 2; 2, 10])"), (Matrix{{2, 0}, {1, 3}}));
}

TEST_F(ControlWords, UnitsArePowersOfTwo) {
  // A flow in m3/s beside a pressure in Pa; what no output leads to is beside the first of its kind.
  EXPECT_EQ(world("units([0, 1e9, 0, 0; 1e-9, 5, 0, 0; 0, 0, 1, 64; 0, 0, 0, 2], [1, 0, 0, 0])"),
            (Matrix{{1, 0, 0, 0}, {0, 0x1p-30, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 0x1p-6}}));
  EXPECT_EQ(world("units(zeros(2), [2^70, 0; 0, 0])"), (Matrix{{0x1p-70, 0}, {0, 1}}));
  world.scope.symbols["X"] = {{2, 2}, false};
  expect("1 + units(X, [1, 0])", 11, "must not depend on 'X'");
  expect("units(eye(2), [1, 0, 0])", 15, "1 x 3");
}

TEST_F(ControlWords, AGainOfTheOutputsIsKnownBeforehand) {
  world.set("A", Matrix{{0, 1}, {2, 0}}).set("B", Matrix{{0}, {1}});
  world.define("F", "output_gain(A, B, eye(2))").define("G", "discrete_output_gain(A, B, eye(2))");
  EXPECT_LT(world("max(eig(A + B*F)(:, 1))")(0, 0), 0);
  EXPECT_LT(world("max(eig(A + B*G)(:, 1).^2 + eig(A + B*G)(:, 2).^2)")(0, 0), 1);
  EXPECT_EQ(world("output_gain(A, B, zeros(0, 2))").size(), 0);
  world.scope.symbols["X"] = {{2, 2}, false};
  expect("1 + output_gain(X, B, eye(2))", 17, "must not depend on 'X'");
  expect("output_gain([1, 2], B, eye(2))", 13, "square");
  expect("output_gain(A, [1, 2], eye(2))", 16, "2 rows");
  expect("output_gain(A, B, [1, 2, 3])", 19, "1 x 3");
}

/// X = 0 solves the equation too, but does not stabilise.
TEST_F(ControlWords, WeightsNeedNotSeeUnstableModes) {
  EXPECT_EQ(world("dare(2, 1, 0, 1)")(0, 0), 3);
  EXPECT_EQ(world("care(1, 1, 0, 1)")(0, 0), 2);
  world.set("A", Matrix{{1, 1}, {0, -2}}).set("B", Matrix{{1}, {1}});
  EXPECT_LT(world("eig(A - B*B'*care(A, B, 0, 1))")(0, 0), 0);
  // Feedback without a weight on the state mirrors the unstable modes.
  EXPECT_NEAR(world("eig(A - B*B'*care(A, B, 0, 1))")(0, 0), -1, 1e-14);
  EXPECT_LT(world("eig(3*A - B*inv(1 + B'*dare(3*A, B, 0, 1)*B)*B'*dare(3*A, B, 0, 1)*3*A)")
                .cwiseAbs()
                .maxCoeff(),
            1);
}

/// Of dare R + B'*X*B has to be invertible, R need not be. Without a weight on the input and with CB
/// invertible the output is 0 after a step: X = C'*C.
TEST_F(ControlWords, AWeightOfTheInputMayBeSingular) {
  EXPECT_LE(world("dare([2, -1; 1, 0], [1; 0], diag([0, 1]), 0) - I").cwiseAbs().maxCoeff(), 1e-14);
  world.set("A", Matrix{{0.9, 0.2}, {-0.1, 0.7}}).set("B", Matrix{{1}, {0.5}});
  world.define("C", "[1, 0.3]");
  EXPECT_LE(world("dare(A, B, C'*C, 0) - C'*C").cwiseAbs().maxCoeff(), 1e-14);
  world.define("D", "[1, 0; 0.5, 1]");
  world.define("X", "dare(A, D, I, diag([2, 0]))");
  EXPECT_LE(
      world("A'*X*A - X - A'*X*D*inv(diag([2, 0]) + D'*X*D)*D'*X*A + I").cwiseAbs().maxCoeff(),
      1e-14);
  expect("dare(A, [1, 1; 1, 1], I, 0)", 1, "R + B'*X*B is not invertible");
}

/// The game of H-infinity: R is indefinite.
TEST_F(ControlWords, WeightsNeedNotBeDefinite) {
  world.set("A", Matrix{{0, 1}, {-2, -1}}).set("B", Matrix{{0, 0}, {1, 0.5}});
  world.define("X", "care(A, B, I, diag([1, -4]))");
  EXPECT_LE(world("A'*X + X*A - X*B*diag([1, -0.25])*B'*X + I").cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT(world("eig(A - B*diag([1, -0.25])*B'*X)")(0, 0), 0);
}

TEST_F(ControlWords, EquationsWithoutASolutionSayWhy) {
  world.set("A", Matrix{{1, 0}, {0, -1}}).set("B", Matrix{{0}, {1}});
  world.set("S", Matrix{{0, 1}, {-4, 0}}).set("T", Matrix{{0.6, 0.8}, {-0.8, 0.6}});
  expect("1 + lyap(A, I)(1, 1)", 5, "two eigenvalues of A have the sum 0");
  expect("dlyap(A, I)", 1, "two eigenvalues of A have the product 1");
  expect("care(A, B, I, 1)", 1, "B does not reach the mode of A at 1, which is not stable");
  expect("dare(2*A, B, I, 1)", 1, "B does not reach the mode of A at 2, which is not stable");
  expect("care(S, B, 0, 1)", 1,
         "the weights do not see the mode at 0 +- 2i, on the imaginary axis");
  expect("dare(T, B, 0, 1)", 1,
         "the weights do not see the mode at 0.6 +- 0.8i, on the unit circle");
  expect("care(A, [1; 1], I, 0)", 1, "R is not invertible");
  expect("care(-eye(1), 1, -2, 1)", 1, "no X leaves A - B*K with all eigenvalues");
}

TEST_F(ControlWords, ShapesAreChecked) {
  world.set("A", Matrix{{1, 2}, {3, -4}}).set("B", Matrix{{0}, {1}});
  world.set("W", Matrix::Ones(2, 3));
  expect("lyap(W, I)", 6, "lyap needs a square matrix");
  expect("lyap(A, W)", 9, "expected 2 x 2");
  expect("care(A, 1, I, 1)", 9, "care needs B with 2 rows");
  expect("care(A, B, I, W)", 15, "expected 1 x 1");
  expect("care(A, B, I)", 1, "is written care(A, B, Q, R, S)");
  expect("c2d(A, W', 1)", 8, "c2d needs B with 2 rows");
  expect("ctrb(A, W')", 9, "ctrb needs B with 2 rows");
  expect("eig(W)", 5, "eig needs a square matrix");
  expect("det(W)", 5, "det needs a square matrix");
  EXPECT_EQ(world("dare(A, B, 0, I)").rows(), 2);
}

TEST_F(ControlWords, StiffAndLargeEquations) {
  // Time constants from 1e-6 to 1e3, and twenty states.
  world.set("A", Matrix{{-1e6, 1}, {0, -1e-3}});
  EXPECT_LE((world("A*lyap(A, I) + lyap(A, I)*A' + I")).cwiseAbs().maxCoeff(), 1e-9);
  std::mt19937 random(7);
  world.set("L", random_matrix(random, 20, 20)).set("B", random_matrix(random, 20, 3));
  world.define("X", "lyap(L, I)").define("Y", "care(L, B, I, I)");
  EXPECT_LE(world("L*X + X*L' + I").cwiseAbs().maxCoeff(),
            1e-9 * (1 + world("X").cwiseAbs().maxCoeff()));
  EXPECT_LE(world("L'*Y + Y*L - Y*B*B'*Y + I").cwiseAbs().maxCoeff(),
            1e-12 * (1 + world("Y*B*B'*Y").cwiseAbs().maxCoeff()));
}

TEST_F(ControlWords, TablesAreLinearBetweenTheirPoints) {
  world.set("x", Matrix{{-1}, {0}, {0.5}, {4}}).set("y", Matrix{{3}, {1}, {2}, {-2}});
  EXPECT_EQ(world("interp1(x, y, [-5; -1; -0.5; 0; 0.25; 0.5; 4; 9])"),
            (Matrix{{3}, {3}, {2}, {1}, {1.5}, {2}, {-2}, {-2}}));
  EXPECT_EQ(world("interp1(x', y, [0.25, 2.25])"), (Matrix{{1.5, 0}}));
  EXPECT_EQ(world("interp1(x, y', 2.25)"), (Matrix{{0}}));
  world.set("q", 0.3);
  EXPECT_NEAR(world("jacobian(interp1(x, y, q), q)")(0, 0), 2, 1e-15);
  expect("interp1(y, x, 0)", 9, "the points x must rise");
  expect("interp1([0; 0], [1; 2], 0)", 9, "the points x must rise");
  expect("interp1([0; 1], [1; 2; 3], 0)", 1, "not 2 points and 3 values");
  expect("interp1(eye(2), x, 0)", 9, "interp1 takes columns or rows");
}

}  // namespace
}  // namespace gainsmith::expr
