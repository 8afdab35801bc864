// Exact blocks, and the certificates that are made of them in little time.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <random>
#include <set>
#include <string>

#include "base/eigen_scalars.h"
#include "base/stop.h"
#include "model/gains.h"
#include "sdp/solver.h"
#include "support/linear_algebra.h"
#include "support/yaml_problem.h"
#include "verdict/boundary_pair.h"
#include "verdict/boundary_refutation.h"
#include "verdict/implied_equations.h"
#include "verdict/plants.h"
#include "verdict/refutation.h"

namespace gainsmith::verdict {
namespace {

using numbers::Matrix;

struct PosedInDouble {
  tests::YamlProblem yaml;
  lmi::Inequalities of;
  lmi::Lmi lmi;
  lmi::Formulation formulation;

  explicit PosedInDouble(const std::string& text)
      : yaml("problem: p\nmethod:\n  method: m\n" + text),
        of(yaml.instance),
        lmi(compile(of)),
        formulation(formulate_interior(lmi, {}, {})) {}

  Refutation on_boundary() const {
    return refute_on_boundary(of, lmi, formulation, sdp::solve(formulation.problem));
  }

  Refutation by_violation() const {
    const lmi::Formulation violation = formulate_violation(lmi);
    return refute_by_violation(of, lmi, violation, sdp::solve(violation.problem));
  }
};

Matrix random_matrix(int rows, int cols, std::mt19937& generator) {
  std::normal_distribution<double> number(0, 0.3);
  return Matrix::NullaryExpr(rows, cols, [&] { return number(generator); });
}

std::string observer(const Matrix& A, const Matrix& C) {
  return "  data: {A: n x n, C: p x n}\n  unknowns: {P: symmetric n, Y: n x p}\n  require: "
         "{positive: P > 0, stable: He(P*A - Y*C) < 0}\ndata: {A: " +
         tests::matrix_yaml(A) + ", C: " + tests::matrix_yaml(C) + "}\n";
}

/// The coefficients of every unknown come out of one evaluation, and are those of the affine forms
/// in double, which share no line with it.
TEST(ExactBlocks, AgreeWithTheFormsInDouble) {
  const std::string data = "\ndata: {A: [[0.1, 2], [-3, 0.7]], b: [[0.3], [1]], s: 0.3}\n";
  const std::string head =
      "  data: {A: 2 x 2, b: 2 x 1, s: scalar}\n  unknowns: {P: symmetric 2, Y: 2 x 1, D: diagonal "
      "2, x: scalar}\n  require: {a: \"";
  for (const char* text :
       {"He(P*A - Y*b') + x*eye(2) > 0", "[P, A'*P; P*A, P + I] > 0",
        "[trace(P*A), Y'; Y, x*A + (x*A)'] >= 0", "P/s + D*s - A*D*A' > expm(A)*expm(A)'",
        "P(1, 1)*A*A' + diag(D(1, 1)*b) > I", "P .* (A + A') + x*ones(2, 2) > 0",
        "-(P - D)*2 + I/3 > 0", "[x, s; s, P(2, 1)] > 0"}) {
    const PosedInDouble posed(head + text + "\"}" + data);
    const ExactBlocks<Decimal100> exact(posed.of, posed.formulation.balance);
    for (std::size_t k = 0; k < posed.lmi.blocks.size(); ++k) {
      const lmi::Block& block = posed.lmi.blocks[k];
      const auto found = exact.block(block, k, all_rows(block));
      ASSERT_EQ(found.terms.size(), block.terms.size()) << text;
      for (std::size_t t = 0; t < found.terms.size(); ++t) {
        const auto& [i, elements] = found.terms[t];
        EXPECT_EQ(i, block.terms[t].first) << text;
        const numbers::Enclosed<Decimal100> B = dense(elements, found.size);
        const Matrix expected(block.terms[t].second);
        for (int r = 0; r < block.size; ++r)
          for (int c = 0; c < block.size; ++c) {
            const double by = posed.formulation.balance.factor(k, r, c, i);
            EXPECT_NEAR(as<double>(B.mid(r, c)) / by, expected(r, c), 1e-14) << text;
            EXPECT_EQ(B.mid(r, c), B.mid(c, r)) << text;
            EXPECT_LE(B.rad(r, c), 1e-140) << text;
          }
      }
    }
  }
}

/// Whole numbers stay exact, so that what cancels is no element.
TEST(ExactBlocks, WholeNumbersHaveNoError) {
  const PosedInDouble posed(lyapunov(Matrix{{1, 2}, {-3, 4}}));
  const ExactBlocks<Decimal100> exact(posed.of, posed.formulation.balance);
  const auto block = exact.block(posed.lmi.blocks[1], 1, {0, 1});
  for (const auto& [i, elements] : block.terms)
    for (const auto& e : elements) EXPECT_EQ(e.rad, 0);
}

/// With stable modes besides every certificate is singular.
TEST(BoundaryPair, UnstablePlantsAreExcluded) {
  std::mt19937 generator(7);
  for (const int n : {2, 3, 5, 8, 12}) {
    const PosedInDouble posed(lyapunov(with_abscissa(random_matrix(n, n, generator), 0.1)));
    const Refutation found = posed.on_boundary();
    EXPECT_LE(found.backward_error, kNothing) << n;
  }
}

/// Growing modes that the output does not show: multipliers of any rank, and many of them.
TEST(BoundaryPair, HiddenModesAreExcluded) {
  std::mt19937 generator(8);
  for (const int n : {4, 7, 10}) {
    const Matrix A = Matrix::Identity(n, n);
    const PosedInDouble posed(observer(A, random_matrix(2, n, generator)));
    EXPECT_LE(posed.on_boundary().backward_error, kNothing) << n;
  }
}

TEST(BoundaryPair, FeasibleProblemsAreNot) {
  std::mt19937 generator(9);
  for (int trial = 0; trial < 20; ++trial) {
    const double depth = std::pow(10.0, -trial / 2.0);
    const PosedInDouble posed(lyapunov(with_abscissa(random_matrix(3, 3, generator), -depth)));
    const Refutation found = posed.on_boundary();
    EXPECT_FALSE(found.exact) << depth;
    EXPECT_GT(found.backward_error, 1e-30) << depth;
  }
}

/// What is neither needed nor in the way: a block without multipliers, an unknown of its own.
TEST(BoundaryPair, WhatIsBesideDoesNotHinder) {
  const PosedInDouble posed(
      "  data: {A: n x n}\n  unknowns: {x: scalar, P: symmetric n}\n  require: {high: x < 1, "
      "positive: P > 0, stable: He(P*A) < 0, size: P > I}\ndata: {A: [[-1, 5, 0], [-2, -3, 1], "
      "[0, 0, 0.2]]}\n");
  EXPECT_LE(posed.on_boundary().backward_error, kNothing);
}

/// With 20 states and one input the homogenised inequalities have next to no solution but 0, and
/// multipliers with eigenvalues that no gap divides; those of the least violation have rank 2. It is
/// one step of several, and rounding decides which systems it settles: some of six.
TEST(Violation, BelowANormThereIsACertificateOfSmallRank) {
  constexpr int kSystems = 6;
  int settled = 0;
  for (unsigned seed = 11; seed < 11 + kSystems; ++seed) {
    std::mt19937 generator(seed);
    const Matrix A = with_abscissa(random_matrix(20, 20, generator), -0.3);
    const Matrix B = random_matrix(20, 1, generator), C = random_matrix(1, 20, generator);
    const double at_rest = std::abs((C * tests::inverse(A) * B)(0, 0));
    const auto posed = [&](double gain) {
      return PosedInDouble(
          "  data: {A: n x n, B: n x m, C: p x n, g: scalar}\n  unknowns: {P: symmetric "
          "n}\n  require: {positive: P > 0, gain: \"[He(P*A) + C'*C, P*B; *, -g*I] < "
          "0\"}\ndata: {A: " +
          tests::matrix_yaml(A) + ", B: " + tests::matrix_yaml(B) +
          ", C: " + tests::matrix_yaml(C) + ", g: " + model::printed(gain * gain) + "}\n");
    };
    const PosedInDouble below = posed(0.7 * at_rest);
    EXPECT_GT(below.on_boundary().backward_error, kNothing) << seed;
    settled += below.by_violation().backward_error <= kNothing ? 1 : 0;
    EXPECT_GT(posed(1e3 * (at_rest + 1)).by_violation().backward_error, kNothing) << seed;
  }
  EXPECT_GE(settled, 2);
}

TEST(Certificates, EndWithTheirAllowance) {
  std::mt19937 generator(11);
  const PosedInDouble posed(lyapunov(with_abscissa(random_matrix(8, 8, generator), 0.1)));
  const Allowance allowance(1e-4);
  EXPECT_THROW(static_cast<void>(posed.on_boundary()), OutOfAllowance);
}

/// Gains that add the same to every inequality: their equations depend on each other, and what
/// meets expm() is 0 before.
TEST(ImpliedEquations, OfWhatCancelsAreDropped) {
  const PosedInDouble posed(
      "  data: {A: 2 x 2, C: 1 x 2, T: scalar}\n  unknowns: {Q: symmetric 2, Y: 2 x 1, Z: 2 x 1}\n "
      " require: "
      "{size: \"I <= Q <= 10*I\", contraction: \"[0.01*Q, ((Q - Y*C - 2*Z*C)*expm(A*T))'; *, Q] > "
      "0\"}\ndata: "
      "{A: [[0.1, 1], [-1, 0.3]], C: [1, 0], T: 0.3}\n");
  auto blocks = exact_blocks<Decimal100>(posed.of, posed.lmi, posed.formulation);
  drop_implied(posed.of, posed.lmi, posed.formulation, blocks);
  std::set<int> used;
  for (const auto& block : blocks)
    for (const auto& [i, elements] : block.terms) used.insert(i);
  // Q has the scalars 1 to 3; of Y and Z one is left of each pair.
  EXPECT_EQ(used.size(), 1U + 3 + 2);
  const auto solution = sdp::solve(posed.formulation.problem);
  const auto Y = multipliers_of(posed.formulation, posed.lmi.blocks.size(), solution);
  EXPECT_TRUE(refute<DoubleDouble>(posed.of, posed.lmi, posed.formulation, Y).exact);
}

/// The same gains beside two matrices that differ in their last decimal imply nothing.
TEST(ImpliedEquations, OfWhatNearlyCancelsStay) {
  const PosedInDouble posed(
      "  data: {A: 2 x 2, C: 1 x 2, D: 1 x 2}\n  unknowns: {Q: symmetric 2, Y: 2 x 1, Z: 2 x 1}\n  "
      "require: "
      "{size: \"I <= Q <= 10*I\", contraction: \"[0.01*Q, ((Q - Y*C - Z*D)*expm(A))'; *, Q] > "
      "0\"}\ndata: "
      "{A: [[0.1, 1], [-1, 0.3]], C: [1, 0], D: [1, 1e-30]}\n");
  auto blocks = exact_blocks<Decimal100>(posed.of, posed.lmi, posed.formulation);
  drop_implied(posed.of, posed.lmi, posed.formulation, blocks);
  std::set<int> used;
  for (const auto& block : blocks)
    for (const auto& [i, elements] : block.terms) used.insert(i);
  EXPECT_EQ(used.size(), 1U + 3 + 4);
}

}  // namespace
}  // namespace gainsmith::verdict
