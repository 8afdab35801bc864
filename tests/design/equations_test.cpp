// Equations between matrices: solved exactly, or refused by a certificate.
#include <gtest/gtest.h>

#include <cmath>

#include "design/solve.h"
#include "numbers/dense/dense.h"

namespace gainsmith::design {
namespace {

/// min tr(C P) over P >= 0, tr(P) = 1 is the smallest eigenvalue of C.
TEST(Equations, TheSmallestEigenvalueIsAMinimumOverATrace) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomStream random(0xE0, seed);
    const int n = 2 + static_cast<int>(seed % 4);
    const numbers::Matrix C = random_symmetric(random, n);
    const model::Gains gains = solve(
        "  data: {C: n x n}\n  unknowns: {P: symmetric n}\n"
        "  require: {shape: P >= 0, one: trace(P) == 1}\n  minimize: trace(C*P)\n",
        "data: {C: " + tests::matrix_yaml(C) + "}\n");
    ASSERT_EQ(gains.verdict, model::Verdict::yes) << seed;
    EXPECT_NEAR(*gains.objective, numbers::smallest_eigenvalue(C), 1e-6) << seed;
    EXPECT_NEAR(gains.unknowns.front().second.trace(), 1, 1e-15) << seed;
  }
}

const std::string kPassive =
    "  data: {A: n x n, B: n x 1, C: 1 x n}\n  unknowns: {P: symmetric n}\n"
    "  require: {positive: P > 0, decrease: He(P*A) < 0, output: P*B == C'}\n";

/// (s + 1)/(s^2 + 3 s + 2): P = [a, 1; 1, 1] with 1 < a and |a - 5| < 4 (Kalman, Yakubovich,
/// Popov).
TEST(Equations, ThoseOfPassivityHoldExactly) {
  const model::Gains gains =
      solve(kPassive, "data: {A: [[0, 1], [-2, -3]], B: [[0], [1]], C: [1, 1]}\n");
  ASSERT_EQ(gains.verdict, model::Verdict::yes);
  const numbers::Matrix& P = gains.unknowns.front().second;
  EXPECT_EQ(P(0, 1), 1);
  EXPECT_EQ(P(1, 1), 1);
  EXPECT_LT(std::abs(P(0, 0) - 5), 4);
  // With s - 1 above it is not passive: P(1,2) = -1.
  EXPECT_EQ(solve(kPassive, "data: {A: [[0, 1], [-2, -3]], B: [[0], [1]], C: [-1, 1]}\n").verdict,
            model::Verdict::no);
}

/// Elements in 64ths, in [-1, 1].
numbers::Matrix drawn_matrix(RandomStream& random, int rows, int columns) {
  numbers::Matrix M(rows, columns);
  for (double& x : M.reshaped()) x = std::round(128 * random.uniform() - 64) / 64;
  return M;
}

numbers::Matrix in_64ths(const numbers::Matrix& M) {
  return M.unaryExpr([](double x) { return std::round(64 * x) / 64; });
}

/// C = B'P without rounding for a P that is planted, with He(P A) = -2 I up to the rounding of
/// A = P^-1 (S - S' - I).
TEST(Equations, ThoseOfPassivityHoldExactlyForTenStatesAndTwoInputs) {
  RandomStream random(0xE1, 1);
  constexpr int n = 10;
  const numbers::Matrix R = drawn_matrix(random, n, n);
  const numbers::Matrix I = numbers::Matrix::Identity(n, n);
  const numbers::Matrix P = in_64ths(0.25 * R * R.transpose() + I);
  const numbers::Matrix S = drawn_matrix(random, n, n);
  const numbers::Matrix A = in_64ths(numbers::Cholesky(P).solve(S - S.transpose() - I));
  const numbers::Matrix B = drawn_matrix(random, n, 2);
  const numbers::Matrix C = B.transpose() * P;
  const std::string method =
      "  data: {A: n x n, B: n x m, C: m x n}\n  unknowns: {P: symmetric n}\n"
      "  require: {positive: P > 0, decrease: He(P*A) < 0, output: P*B == C'}\n";
  const auto data = [&](const numbers::Matrix& output) {
    return "data:\n  A: " + tests::matrix_yaml(A) + "\n  B: " + tests::matrix_yaml(B) +
           "\n  C: " + tests::matrix_yaml(output) + "\n";
  };
  const model::Gains gains = solve(method, data(C));
  ASSERT_EQ(gains.verdict, model::Verdict::yes);
  const numbers::Matrix& found = gains.unknowns.front().second;
  EXPECT_LT((found * B - C.transpose()).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_GT(numbers::smallest_eigenvalue(found), 0);
  EXPECT_GT(numbers::smallest_eigenvalue(-found * A - A.transpose() * found), 0);
  // C B = B'P B is positive definite.
  EXPECT_EQ(solve(method, data(-C)).verdict, model::Verdict::no);
}

/// More unknowns than fractions are used for in searches of faces.
TEST(Equations, ATraceOfALyapunovMatrixOfFourteenStates) {
  constexpr int n = 14;
  RandomStream random(0xE2, 1);
  const numbers::Matrix S = drawn_matrix(random, n, n);
  const numbers::Matrix A = S - S.transpose() - numbers::Matrix::Identity(n, n);
  const std::string method =
      "  data: {A: n x n}\n  unknowns: {P: symmetric n}\n"
      "  require: {positive: P > 0, decrease: He(P*A) < 0, one: trace(P) == 1}\n";
  const model::Gains gains = solve(method, "data: {A: " + tests::matrix_yaml(A) + "}\n");
  ASSERT_EQ(gains.verdict, model::Verdict::yes);
  EXPECT_NEAR(gains.unknowns.front().second.trace(), 1, 1e-15);
  EXPECT_EQ(solve(method, "data: {A: " + tests::matrix_yaml(-A) + "}\n").verdict,
            model::Verdict::no);
}

TEST(Equations, WithoutASolutionAreANo) {
  EXPECT_EQ(
      solve("  unknowns: {P: symmetric 2}\n  require: {a: P > I, b: trace(P) == 2}\n").verdict,
      model::Verdict::no);
  EXPECT_EQ(solve("  unknowns: {x: scalar}\n  require: {a: x == 1, b: x == 2}\n").verdict,
            model::Verdict::no);
}

TEST(Equations, StandInChainsAndHaveAnyShape) {
  const model::Gains gains = solve(
      "  data: {M: n x m}\n  unknowns: {X: n x m, Y: n x m, g: scalar}\n"
      "  require: {same: X == Y == M, size: \"[g*I, X; *, I] > 0\"}\n  minimize: g\n",
      "data: {M: [[3, 0, 0.1], [0, 4, 0]]}\n");
  ASSERT_EQ(gains.verdict, model::Verdict::yes);
  const numbers::Matrix expected{{3, 0, 0.1}, {0, 4, 0}};
  EXPECT_EQ(gains.unknowns[0].second, expected);
  EXPECT_EQ(gains.unknowns[1].second, expected);
  EXPECT_NEAR(*gains.objective, 16, 1e-5);
}

/// The solution is 1/3, and 2/3 - 1/3 >= 1/3 holds there with equality.
TEST(Equations, WithoutDecimalsHoldAtASolutionNearTheDecimals) {
  const std::string unknown = "  unknowns: {x: scalar, g: scalar}\n";
  const model::Gains one = solve(
      unknown + "  require: {third: 3*x == 1, below: g >= x, two: 2/3 - x >= x}\n  minimize: g\n");
  ASSERT_EQ(one.verdict, model::Verdict::yes);
  EXPECT_NEAR(*one.objective, 1. / 3, 1e-8);
  ASSERT_TRUE(one.solution_within);
  // The decimals 0.33333333333333331 are that far.
  EXPECT_GE(*one.solution_within, 2.2e-17);
  EXPECT_LT(*one.solution_within, 1e-15);
  // Less than equality is a no, however little.
  EXPECT_EQ(solve(unknown + "  require: {third: 3*x == 1, g: g > 0, two: 2/3 - x > x}\n").verdict,
            model::Verdict::no);
  const model::Gains decimals =
      solve(unknown + "  require: {quarter: 4*x == 1, below: g >= x}\n  minimize: g\n");
  EXPECT_EQ(decimals.verdict, model::Verdict::yes);
  EXPECT_FALSE(decimals.solution_within);
}

/// A X + X A' + B B' = 0 of companion matrices: X > 0; with a state that B does not reach X is
/// singular.
TEST(Equations, OfLyapunovHoldNearTheDecimals) {
  const std::string method =
      "  data: {A: n x n, B: n x 1}\n  unknowns: {X: symmetric n}\n"
      "  require: {gramian: \"He(A*X) + B*B' == 0\", psd: X >= 0}\n  minimize: trace(X)\n";
  for (const char* data :
       {"{A: [[-1, 0.3], [0.2, -0.7]], B: [[1], [0.5]]}",
        "{A: [[-0.7, 0.3], [0, -1.1]], B: [[1], [0]]}",
        "{A: [[-0.7, 0.1, 1], [1, -1.1, 0], [0, 0, -3]], B: [[1], [0.3], [0]]}"}) {
    const std::string text = "problem: p\nmethod:\n  method: m\n" + method + "data: " + data + "\n";
    const tests::YamlProblem yaml(text);
    const numbers::Matrix& A = yaml.instance.values.at("A");
    const numbers::Matrix& B = yaml.instance.values.at("B");
    const model::Gains gains = synthesize(yaml.instance, {});
    ASSERT_EQ(gains.verdict, model::Verdict::yes) << data;
    const numbers::Matrix& X = gains.unknowns.front().second;
    EXPECT_LT((A * X + X * A.transpose() + B * B.transpose()).cwiseAbs().maxCoeff(), 1e-14) << data;
    EXPECT_GT(numbers::smallest_eigenvalue(X), -1e-15) << data;
    ASSERT_TRUE(gains.solution_within) << data;
    EXPECT_LT(*gains.solution_within, 1e-15) << data;
  }
  // -A is not stable: X < 0.
  EXPECT_EQ(solve(method, "data: {A: [[1, -0.3], [-0.2, 0.7]], B: [[1], [0.5]]}\n").verdict,
            model::Verdict::no);
}

/// E'P is symmetric by the equation (descriptor systems); a stable and an unstable one of index 1.
TEST(Equations, MakeInequalitiesSymmetric) {
  const std::string method =
      "  data: {E: n x n, A: n x n}\n  unknowns: {P: n x n}\n"
      "  require: {sym: E'*P == P'*E, pos: E'*P >= 0, dec: He(P'*A) < 0}\n";
  const std::string E = "data: {E: [[1, 0, 0], [0, 1, 0], [0, 0, 0]], A: ";
  const model::Gains gains = solve(method, E + "[[0, 1, 0], [-2, -3, 1], [1, 0, -1]]}\n");
  ASSERT_EQ(gains.verdict, model::Verdict::yes);
  const numbers::Matrix& P = gains.unknowns.front().second;
  EXPECT_EQ(P(0, 1), P(1, 0));
  EXPECT_EQ(P(0, 2), 0);
  EXPECT_GT(numbers::smallest_eigenvalue(P.topLeftCorner(2, 2)), 0);
  EXPECT_EQ(solve(method, E + "[[0, 1, 0], [2, -3, 1], [1, 0, -1]]}\n").verdict,
            model::Verdict::no);
}

/// Output feedback by M C = C W (Crusius and Trofino, 1999): W = I, M = I, N = [-1, 4] is a
/// solution.
TEST(Equations, GainsWithInversesThatAreNotSymmetricAreBounded) {
  const model::Gains gains = solve(
      "  data: {A: n x n, B: n x m, C: p x n}\n  unknowns: {W: symmetric n, M: p x p, N: m x p}\n"
      "  require: {pos: W > 0, stab: He(A*W - B*N*C) < 0, eq: M*C == C*W}\n"
      "  gains: {K: -N*inv(M)}\n",
      "data: {A: [[-1, 1, 0], [0, -1, 1], [-1, -2, 1]], B: [[0], [0], [1]], C: [[1, 0, 0], [0, 0, "
      "1]]}\n");
  ASSERT_EQ(gains.verdict, model::Verdict::yes);
  ASSERT_EQ(gains.bounds.size(), 1U);
  EXPECT_NE(gains.bounds[0].what.find("N*inv(M)"), std::string::npos);
  EXPECT_LT(gains.gains.front().second.norm(), 100);
}

}  // namespace
}  // namespace gainsmith::design
