// Certificates, judged from the decimals of the file.
#include "verdict/refutation.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <memory>
#include <random>
#include <string>

#include "base/eigen_scalars.h"
#include "base/scalars.h"
#include "model/gains.h"
#include "sdp/solver.h"
#include "support/linear_algebra.h"
#include "support/yaml_problem.h"
#include "verdict/boundary_refutation.h"
#include "verdict/plants.h"
#include "verdict/relaxed_backward_error.h"

namespace gainsmith::verdict {
namespace {

using numbers::Matrix;
using Wide = numbers::MatrixOf<DoubleDouble>;

/// A problem with the program of its largest margin.
struct Posed {
  tests::YamlProblem yaml;
  lmi::Inequalities of;
  lmi::Lmi lmi;
  lmi::GainBounds bounds;

  explicit Posed(const std::string& text)
      : yaml("problem: p\nmethod:\n  method: m\n" + text),
        of(yaml.instance),
        lmi(compile(of)),
        bounds(gain_bounds(of, of.design().synthesis.gain_bound)) {}

  /// With the coefficients in 31 digits.
  lmi::Formulation formulation() const {
    std::optional<ExactBlocks<Decimal100>> exact;
    return formulate_interior(
        lmi, {}, {}, [&](std::size_t k, const lmi::Balance& balance, const std::vector<int>& kept) {
          if (!exact) exact.emplace(of, balance);
          return rounded(exact->block(lmi.blocks[k], k, kept));
        });
  }

  /// What the solver's multipliers show, in this arithmetic.
  Refutation refuted(const std::string& precision, double tolerance) const {
    const lmi::Formulation asked = formulation();
    sdp::Options options;
    options.precision = precision;
    options.tolerance = tolerance;
    const sdp::Solution solution = sdp::solve(asked.problem, options);
    return refute<Decimal100>(of, lmi, asked, multipliers_of(asked, lmi.blocks.size(), solution));
  }

  /// What those near the solver's show.
  Refutation on_boundary() const {
    const lmi::Formulation asked = formulation();
    return refute_on_boundary(of, lmi, asked, sdp::solve(asked.problem, {}));
  }
};

Matrix random_matrix(int n, std::mt19937& generator) {
  std::normal_distribution<double> number;
  return Matrix::NullaryExpr(n, n, [&] { return number(generator); });
}

/// The decimals of the file.
Wide decimals(const Matrix& A) {
  return A.unaryExpr([](double a) { return *parse_as<DoubleDouble>(model::printed(a)); });
}

/// Multipliers in the units of the balance: S^-1 Y S^-1.
Multipliers in_units(const lmi::Formulation& formulation, const std::vector<Wide>& Y) {
  Multipliers result = Y;
  for (std::size_t k = 0; k < Y.size(); ++k)
    for (int r = 0; r < Y[k].rows(); ++r)
      for (int c = 0; c < Y[k].cols(); ++c)
        result[k](r, c) = Y[k](r, c) / DoubleDouble(formulation.balance.row(k, r) *
                                                    formulation.balance.row(k, c));
  return result;
}

/// Y_2 > 0 and Y_1 = A Y_2 + Y_2 A': <P, Y_1> = <P A + A' P, Y_2> for every P.
std::vector<Wide> lyapunov_certificate(const Matrix& A, const Wide& Y2) {
  const Wide product = decimals(A).lazyProduct(Y2);
  return {product + product.transpose().eval(), Y2};
}

Matrix kronecker(const Matrix& a, const Matrix& b) {
  Matrix result(a.rows() * b.rows(), a.cols() * b.cols());
  for (Eigen::Index i = 0; i < a.rows(); ++i)
    for (Eigen::Index j = 0; j < a.cols(); ++j)
      result.block(i * b.rows(), j * b.cols(), b.rows(), b.cols()) = a(i, j) * b;
  return result;
}

/// Every direction of an A whose modes are all unstable has room: the certificate is exact.
TEST(RefutationTest, AnAWithoutStableModesIsRefutedExactly) {
  std::mt19937 generator(1);
  for (int trial = 0; trial < 10; ++trial) {
    const int n = 1 + trial % 4;
    const Matrix A = -with_abscissa(random_matrix(n, generator), -0.2);
    const Refutation found = Posed(lyapunov(A)).refuted("double", 1e-9);
    EXPECT_TRUE(found.exact) << A;
    EXPECT_LT(found.backward_error, 1e-6);
  }
}

/// With a stable mode the certificate lives on an irrational subspace, as a rule.
TEST(RefutationTest, AnUnstableAIsRefuted) {
  std::mt19937 generator(2);
  for (int trial = 0; trial < 6; ++trial) {
    const Matrix A = with_abscissa(random_matrix(2 + trial % 3, generator), 0.2);
    const Refutation found = Posed(lyapunov(A)).on_boundary();
    EXPECT_TRUE(found.exact || found.backward_error <= kNothing)
        << A << "\nbackward error " << found.backward_error;
  }
}

/// Neither by the solver's multipliers nor by those of a problem beside it.
TEST(RefutationTest, AFeasibleProblemIsNeverRefuted) {
  std::mt19937 generator(3);
  for (int trial = 0; trial < 12; ++trial) {
    const int n = 2 + trial % 3;
    const double depth = std::pow(10.0, -1 - trial);
    const Matrix A = with_abscissa(random_matrix(n, generator), -depth);
    const Posed feasible(lyapunov(A));
    for (const char* precision : {"double", "quad"}) {
      const Refutation found = feasible.refuted(precision, 1e-12);
      EXPECT_FALSE(found.exact) << A;
      EXPECT_GT(found.backward_error, 1e-30) << A;
    }
    // Those of A + 2 depth I, which is unstable.
    const Matrix near = A + 2 * depth * Matrix::Identity(n, n);
    const Posed beside(lyapunov(near));
    const lmi::Formulation asked = beside.formulation();
    const sdp::Solution solution = sdp::solve(asked.problem);
    const auto Y = multipliers_of(asked, 2, solution);
    std::vector<Wide> units;
    for (std::size_t k = 0; k < 2; ++k) {
      units.push_back(Y[k]);
      for (int r = 0; r < n; ++r)
        for (int c = 0; c < n; ++c)
          units[k](r, c) *= DoubleDouble(asked.balance.row(k, r) * asked.balance.row(k, c));
    }
    const lmi::Formulation own = feasible.formulation();
    const Refutation found =
        refute<DoubleDouble>(feasible.of, feasible.lmi, own, in_units(own, units));
    EXPECT_FALSE(found.exact) << A;
    // The data are a relative change of about depth away from infeasible ones.
    EXPECT_GT(found.backward_error, 1e-4 * depth) << A;
  }
}

TEST(RefutationTest, RandomMultipliersRefuteNoFeasibleProblem) {
  std::mt19937 generator(4);
  for (int trial = 0; trial < 200; ++trial) {
    const int n = 1 + trial % 3;
    const Posed feasible(lyapunov(with_abscissa(random_matrix(n, generator), -1e-3)));
    const lmi::Formulation asked = feasible.formulation();
    Multipliers Y;
    for (int k = 0; k < 2; ++k) {
      const Matrix root = random_matrix(n, generator) * std::pow(10.0, 3 * k * (trial % 5));
      Y.push_back(tests::widened<DoubleDouble>(tests::product({root, root.transpose()})));
    }
    EXPECT_FALSE((refute<DoubleDouble>(feasible.of, feasible.lmi, asked, Y).exact)) << trial;
  }
}

/// A certificate with an error of relative size d is exact as long as its residual is small in the
/// measure of its own interior, and its backward error is about d.
TEST(RefutationTest, APerturbedCertificateIsJudgedByItsResidual) {
  std::mt19937 generator(5);
  for (int trial = 0; trial < 10; ++trial) {
    const int n = 2 + trial % 3;
    const Matrix A = -with_abscissa(random_matrix(n, generator), -0.2);
    const Posed posed(lyapunov(A));
    const lmi::Formulation asked = posed.formulation();
    // Y_2 with A Y_2 + Y_2 A' = I: both have room.
    const Matrix I = Matrix::Identity(n, n);
    const Matrix lifted = kronecker(I, A) + kronecker(A, I);
    const Eigen::VectorXd right = Eigen::Map<const Eigen::VectorXd>(I.data(), n * n);
    const Eigen::VectorXd solved = tests::solve(lifted, right);
    const Matrix raw = Eigen::Map<const Matrix>(solved.data(), n, n);
    const Matrix Y2 = 0.5 * (raw + raw.transpose());
    for (const double size : {0., 1e-12, 1e-6}) {
      std::vector<Wide> Y = lyapunov_certificate(A, tests::widened<DoubleDouble>(Y2));
      Matrix error = random_matrix(n, generator);
      error = size / error.norm() * (error + error.transpose()).eval();
      Y[0] += tests::widened<DoubleDouble>(error);
      const Refutation found = refute<DoubleDouble>(posed.of, posed.lmi, asked, in_units(asked, Y));
      EXPECT_TRUE(found.exact) << size << "\n" << A;
      EXPECT_LT(found.backward_error, 100 * size + 1e-27);
      EXPECT_GE(found.backward_error, 1e-4 * size);
    }
    // As large as the certificate: nothing is shown.
    std::vector<Wide> Y = lyapunov_certificate(A, tests::widened<DoubleDouble>(Y2));
    Y[0] *= DoubleDouble(30);
    const Refutation wrong = refute<DoubleDouble>(posed.of, posed.lmi, asked, in_units(asked, Y));
    EXPECT_FALSE(wrong.exact);
    EXPECT_GT(wrong.backward_error, 0.01);
    // Not positive semidefinite: no certificate at all.
    Y = lyapunov_certificate(A, tests::widened<DoubleDouble>(Y2));
    Y[1](0, 0) = DoubleDouble(-1);
    EXPECT_EQ((refute<DoubleDouble>(posed.of, posed.lmi, asked, in_units(asked, Y)).backward_error),
              1);
  }
}

/// A lower triangular matrix of whole numbers with the inverse of one.
std::pair<Matrix, Matrix> whole_triangular(int n, int k, std::mt19937& generator) {
  Matrix L = Matrix::Identity(n, n);
  for (int i = 1; i < n; ++i) L(i, i - 1) = generator() % 2 == 0 ? k : -k;
  return {L, tests::inverse(L).array().round().matrix()};
}

/// Certificates that are known by construction, in coordinates of condition 1e8 and more: Y_2 = T
/// T' with T^-1 A T antistable, so that Y_2 and A Y_2 + Y_2 A' are positive definite. All numbers
/// are whole.
TEST(RefutationTest, CoordinatesDoNotMatter) {
  std::mt19937 generator(6);
  for (int trial = 0; trial < 12; ++trial) {
    const int n = 2 + trial % 3;
    const int k = n == 2 ? 100 : n == 3 ? 20 : 8;
    const auto [lower, lower_inverse] = whole_triangular(n, k, generator);
    const auto [other, other_inverse] = whole_triangular(n, k, generator);
    const Matrix T = tests::product({lower, other.transpose()});
    const Matrix inverse = tests::product({other_inverse.transpose(), lower_inverse});
    ASSERT_EQ(tests::product({T, inverse}), Matrix::Identity(n, n));
    const Eigen::VectorXd sizes = tests::singular_values(T);
    EXPECT_GT(sizes(0) / sizes(n - 1), 1e7);
    Matrix skew = random_matrix(n, generator).array().round();
    const Matrix antistable = Matrix::Identity(n, n) + skew - skew.transpose();
    const Matrix A = tests::product({T, antistable, inverse});
    const Wide root = tests::widened<DoubleDouble>(T);
    const Posed posed(lyapunov(A));
    const lmi::Formulation asked = posed.formulation();
    const auto Y = lyapunov_certificate(A, root.lazyProduct(root.transpose()));
    const Refutation found = refute<Decimal100>(posed.of, posed.lmi, asked, in_units(asked, Y));
    EXPECT_TRUE(found.exact) << trial;
    EXPECT_LT(found.backward_error, 1e-25) << trial;
  }
}

/// Blocks that the certificate does not need have multipliers that are only nearly 0.
TEST(RefutationTest, WhatIsNotNeededDoesNotHinder) {
  const Posed posed(
      "  data: {A: n x n}\n  unknowns: {x: scalar, P: symmetric n}\n  require: {low: x > 3, high: "
      "x "
      "< 1, positive: P > 0, stable: He(P*A) < 0, size: P > I}\ndata: {A: [[-1, 5], [-2, -3]]}\n");
  const Refutation found = posed.refuted("quad", 1e-22);
  EXPECT_TRUE(found.exact || found.backward_error <= kNothing) << found.backward_error;
}

TEST(RefutationTest, WithConstantsTheValueCounts) {
  const std::string unknown = "  unknowns: {x: scalar}\n  require: ";
  for (const char* require :
       {"{low: x > 2, high: x < 1}", "{low: x >= 2, high: x <= 1}", "{low: x > 1, high: x < 1}"}) {
    const Refutation found = Posed(unknown + require + "\n").refuted("100", 1e-40);
    EXPECT_TRUE(found.exact || found.backward_error <= kNothing)
        << require << " " << found.backward_error;
  }
  const Refutation touching =
      Posed(unknown + "{low: x >= 1, high: x <= 1}\n").refuted("100", 1e-40);
  EXPECT_FALSE(touching.exact);
  EXPECT_EQ(touching.backward_error, 1);  // only blocks with >= have multipliers, and v = 0
}

/// exp(t) over an interval, by the corners of a box that t does not reach.
TEST(RefutationTest, CornersThatAreNoPointsAreRefutedAsTheyAreInDouble) {
  const Posed posed(
      "  unknowns: {x: scalar}\n  require:\n    a: {forall: \"t in [0, 1]\", that: \"x*(3 - "
      "exp(t)) > t + exp(-t)\"}\n    b: x < 0\nsynthesis: {forall: hull}\n");
  ASSERT_FALSE(posed.lmi.represents_points());
  const lmi::Formulation asked = formulate_interior(posed.lmi, {}, {});
  const sdp::Solution solution = sdp::solve(asked.problem);
  const auto Y = multipliers_of(asked, posed.lmi.blocks.size(), solution);
  const Refutation found = refute<DoubleDouble>(posed.of, posed.lmi, asked, Y);
  EXPECT_TRUE(found.exact);
  EXPECT_LT(relaxed_backward_error(posed.lmi, {}, asked, solution), 1e-6);
}

/// What only the bound on a gain excludes is excluded with it.
TEST(RefutationTest, AGainBoundHasItsOwnBackwardError) {
  for (const double bound : {1., 100.}) {
    const Posed posed(
        "  unknowns: {x: scalar}\n  require: {floor: x > 5}\n  gains: {K: x}\n"
        "synthesis: {gain_bound: " +
        model::printed(bound) + "}\n");
    const lmi::Formulation asked = formulate_interior(posed.lmi, posed.bounds, {});
    const sdp::Solution solution = sdp::solve(asked.problem);
    const double backward_error = relaxed_backward_error(posed.lmi, posed.bounds, asked, solution);
    EXPECT_EQ(backward_error < 1e-6, bound == 1) << backward_error;
  }
}

}  // namespace
}  // namespace gainsmith::verdict
