// A no needs a certificate: of data that are nearly infeasible there is none, of plainly infeasible
// ones there is, whatever its rank.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "design/solve.h"
#include "design/synthesize.h"
#include "support/linear_algebra.h"
#include "support/yaml_problem.h"
#include "verdict/refutation.h"

namespace gainsmith::design {
namespace {

model::Gains lyapunov(const std::string& A) {
  return synthesized(
      "problem: lyapunov\nmethod:\n  method: lyapunov\n  data: {A: n x n}\n  unknowns: {P: "
      "symmetric n}\n  require: {positive: P > 0, stable: He(P*A) < 0}\ndata: {A: " +
      A + "}\n");
}

model::Gains scalars(const std::string& unknowns, const std::string& require) {
  return synthesized("problem: p\nmethod:\n  method: m\n  unknowns: {" + unknowns +
                     "}\n  require: {" + require + "}\n");
}

/// Feasible by the last of 16 digits: multipliers miss by the square of it.
TEST(CertificatesTest, AlmostACertificateIsNone) {
  EXPECT_NE(lyapunov("[[1, 1.0000000000000002], [-1, -1.0000000000000001]]").verdict,
            model::Verdict::no);
  EXPECT_NE(lyapunov("[[1, 1.000000000000000000002], [-1, -1.000000000000000000001]]").verdict,
            model::Verdict::no);
  EXPECT_NE(lyapunov("[[49006999, 343098014001], [-7000, -49007002]]").verdict, model::Verdict::no);
  EXPECT_NE(scalars("x: scalar, y: scalar, z: scalar",
                    "a: x > y, b: y > 0.9999999999999998*z, c: z > 1.0000000000000002*x")
                .verdict,
            model::Verdict::no);
  EXPECT_NE(scalars("x: scalar, y: scalar", "a: x > 0, b: \"tanh(50)*x < y\", c: y < x").verdict,
            model::Verdict::no);
  // A Jordan block leaves the eighth power, a cycle the product of its factors.
  EXPECT_NE(lyapunov("[[-2.0000001, 0, 3, -1], [-1, -2.0000001, 6, -3], [-3, 1, 1.9999999, 0], "
                     "[-4, 3, -1, 1.9999999]]")
                .verdict,
            model::Verdict::no);
  EXPECT_NE(lyapunov("[[-1.0000000000000001, 1, 0], [0, -1.0000000000000002, "
                     "1.0000000000000004], [1.0000000000000005, 0, -1.0000000000000006]]")
                .verdict,
            model::Verdict::no);
  EXPECT_NE(scalars("x: scalar, y: scalar, z: scalar",
                    "a: x > 0, b: 10000000000000001*y > 10000000000000000*x, c: "
                    "10000000000000002*z > 10000000000000004*y, d: 10000000000000006*x > "
                    "10000000000000005*z")
                .verdict,
            model::Verdict::no);
  // And what these digits make infeasible stays so.
  EXPECT_EQ(scalars("x: scalar, y: scalar, z: scalar",
                    "a: x > y, b: y > 0.9999999999999998*z, c: z > 1.0000000000000003*x, d: x > 0")
                .verdict,
            model::Verdict::no);
}

/// What is small in the file stands there like anything else.
TEST(CertificatesTest, SmallElementsAreNotOverlooked) {
  EXPECT_EQ(lyapunov("[[-1e-30, 1], [-1, 0]]").verdict, model::Verdict::yes);
  for (const char* small : {"1e-46", "1e-120", "1e-300"})
    EXPECT_NE(scalars("y: scalar, z: scalar",
                      "a: \"y - z + " + std::string(small) + " > 0\", b: z - y > 0, c: y > 1")
                  .verdict,
              model::Verdict::no)
        << small;
  EXPECT_NE(
      scalars("x: scalar, y: scalar", "a: \"[x, y; y, (1e-200*1e-200)*x] > 0\", b: y >= 1").verdict,
      model::Verdict::no);
}

/// The unit of an objective is no matter of its precision.
TEST(CertificatesTest, AnObjectiveIsAsPreciseInEveryUnit) {
  for (const double unit : {1e-12, 1e-6, 1.0, 1e6, 1e12}) {
    const std::string u = model::printed(unit);
    const model::Gains gains = synthesized(
        "problem: p\nmethod:\n  method: m\n  unknowns: {x: scalar, y: scalar}\n  require: {a: "
        "\"[x, " +
        u + "; " + u + ", y] > 0\", b: y < " + u + "}\n  minimize: x\n");
    ASSERT_EQ(gains.verdict, model::Verdict::yes) << unit;
    EXPECT_NEAR(*gains.objective / unit, 1, 1e-6);
    EXPECT_NEAR(*gains.objective_lower_bound / unit, 1, 1e-6);
    EXPECT_LE(*gains.objective_lower_bound, unit);
  }
}

/// Where solutions are unbounded a dual solution satisfies its equations only to a tolerance.
TEST(CertificatesTest, NoSolutionOfLikeSizeIsBelowTheBound) {
  const struct {
    const char* require;
    const char* minimize;
    double least;
  } cases[] = {
      {"a: x >= 1, b: y >= 5", "y", 5},
      {"a: x >= 2.5, b: y >= 0.5", "y", 0.5},
      {"a: x > 2.5, b: y > 1000000", "y", 1000000},
      {"a: x >= 1e12, b: y >= 1", "x", 1e12},
      {"a: \"(4e-3)*x >= 1000\", b: \"(1e-2)*x >= 50000\", c: \"(2e-8)*x > -1e-2\", d: y > x",
       "\"(1e-6)*x\"", 5}};
  for (const auto& one : cases) {
    const model::Gains gains = synthesized(
        "problem: p\nmethod:\n  method: m\n  unknowns: {x: scalar, y: scalar}\n  require: {" +
        std::string(one.require) + "}\n  minimize: " + one.minimize + "\n");
    ASSERT_EQ(gains.verdict, model::Verdict::yes) << one.require;
    EXPECT_LE(*gains.objective_lower_bound, one.least) << one.require;
    EXPECT_NEAR(*gains.objective / one.least, 1, 1e-6) << one.require;
  }
}

/// A state in other units: the gain has them, the margins stay.
TEST(CertificatesTest, TheDefaultGainBoundIsInNoUnits) {
  const auto reset = [](int exponent) {
    return synthesized("problem: p\nmethod: reset-observer\ndata: {A: [[0, 2^" +
                       std::to_string(exponent) + "], [0, 0]], C: [1, 0], T1: 0.1, T2: 0.2}\n");
  };
  const model::Gains reference = reset(0);
  ASSERT_EQ(reference.verdict, model::Verdict::yes);
  for (const int exponent : {-40, -20, 20}) {
    const model::Gains gains = reset(exponent);
    ASSERT_EQ(gains.verdict, model::Verdict::yes) << exponent;
    const numbers::Matrix& F = gains.gains.front().second;
    EXPECT_EQ(F(0), reference.gains.front().second(0)) << exponent;
    EXPECT_EQ(std::ldexp(F(1), exponent), reference.gains.front().second(1)) << exponent;
    for (std::size_t i = 0; i < gains.margins.size(); ++i)
      EXPECT_EQ(gains.margins[i].reached, reference.margins[i].reached) << exponent;
  }
}

/// A - L*C is Hurwitz for |L| > 1 only.
TEST(CertificatesTest, AStatedGainBoundHoldsToTheLastDigit) {
  const std::string text =
      "problem: p\nmethod:\n  method: m\n  unknowns: {P: symmetric 2, Y: 2 x 1}\n  require: {p: P "
      "> 0, "
      "r: \"He(P*[1, 0; 0, -1] - Y*[1, 0]) < 0\"}\n  gains: {L: inv(P)*Y}\nsynthesis: "
      "{gain_bound: ";
  EXPECT_EQ(synthesized(text + "1}\n").verdict, model::Verdict::undecided);
  EXPECT_EQ(synthesized(text + "1.01}\n").verdict, model::Verdict::yes);
}

/// The certificate of a plant with one unstable mode has the rank 1, and no other exists.
TEST(CertificatesTest, SingularCertificatesAreFound) {
  std::mt19937 generator(7);
  std::normal_distribution<double> number;
  std::vector<std::string> plants = {"[[1]]",
                                     "[[0, 1], [0, 0]]",
                                     "[[0, 1], [-1, 0]]",
                                     "[[0, 1, 0], [0, 0, 1], [0, 0, 0]]",
                                     "[[0, 1, 1, 0], [-1, 0, 0, 1], [0, 0, 0, 1], [0, 0, -1, 0]]",
                                     "[[1, 1], [0, 1]]",
                                     "[[2, 0, 0], [0, -1, 1], [0, 0, -1]]",
                                     "[[1e-3, 1000], [0, -1e6]]"};
  while (plants.size() < 40) {
    const int n = 2 + static_cast<int>(plants.size()) % 4;
    const numbers::Matrix A = numbers::Matrix::NullaryExpr(n, n, [&] { return number(generator); });
    if (tests::spectral_abscissa(A) > 1e-3) plants.push_back(tests::matrix_yaml(A));
  }
  for (const std::string& A : plants) {
    const model::Gains gains = lyapunov(A);
    EXPECT_EQ(gains.verdict, model::Verdict::no) << A << ' ' << gains.solver.message;
    ASSERT_TRUE(gains.certificate.has_value()) << A;
    EXPECT_TRUE(gains.certificate->exact || gains.certificate->backward_error <= verdict::kNothing)
        << A;
  }
}

/// |C A^-1 B|^2 = 2 g2, so the bounded real lemma with q C'C has no solution. One input hardly
/// reaches some of the states, so all multipliers are next to singular.
TEST(CertificatesTest, AHomogeneousBoundedRealLemmaIsRefutedByItsScale) {
  std::mt19937 generator(20);
  std::normal_distribution<double> normal;
  const auto in_1024ths = [&](double size) {
    return std::round(1024 * size * normal(generator)) / 1024;
  };
  constexpr int n = 20;
  using numbers::Matrix;
  Matrix A = Matrix::NullaryExpr(n, n, [&] { return in_1024ths(0.3); });
  A.diagonal().array() -= std::round(64 * (tests::spectral_abscissa(A) + 0.3)) / 64;
  const Matrix B = Matrix::NullaryExpr(n, 1, [&] { return in_1024ths(1); });
  const Matrix C = Matrix::NullaryExpr(1, n, [&] { return in_1024ths(1); });
  const double gain = C.row(0).dot(tests::solve(A, B));
  const model::Gains gains = synthesized(
      "problem: p\nmethod:\n  method: m\n  data: {A: n x n, B: n x m, C: p x n, g2: scalar}\n"
      "  unknowns: {P: symmetric n, q: scalar}\n"
      "  require: {b: \"[He(P*A) + q*C'*C, P*B; *, -g2*q*I] < 0\"}\ndata:\n  A: " +
      tests::matrix_yaml(A) + "\n  B: " + tests::matrix_yaml(B) +
      "\n  C: " + tests::matrix_yaml(C) + "\n  g2: " + model::printed(gain * gain / 2) + "\n");
  EXPECT_EQ(gains.verdict, model::Verdict::no) << gains.solver.message;
  EXPECT_FALSE(gains.solver.out_of_allowance);
}

}  // namespace
}  // namespace gainsmith::design
