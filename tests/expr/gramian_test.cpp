// Observability Gramians of hybrid systems against their definition and their identities.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <random>

#include "expr/world.h"
#include "support/input_error.h"
#include "support/linear_algebra.h"

namespace gainsmith::expr {
namespace {

using tests::input_error;
using tests::product;

Matrix flow(const Matrix& F, double t) { return tests::exponential(F * t); }

/// int_0^t (Hc expm(F s) M)' (Hc expm(F s) M) ds by Gauss-Legendre on 40 pieces of 4 points.
Matrix integral(const Matrix& F, const Matrix& Hc, const Matrix& M, double t) {
  constexpr double kPositions[] = {0.0694318442029737, 0.3300094782075719, 0.6699905217924281,
                                   0.9305681557970263};
  constexpr double kWeights[] = {0.1739274225687269, 0.3260725774312731, 0.3260725774312731,
                                 0.1739274225687269};
  constexpr int kPieces = 40;
  Matrix sum = Matrix::Zero(F.rows(), F.rows());
  for (int piece = 0; piece < kPieces; ++piece) {
    for (int i = 0; i < 4; ++i) {
      const Matrix row = product({Hc, flow(F, t * (piece + kPositions[i]) / kPieces), M});
      sum += kWeights[i] * t / kPieces * product({row.transpose(), row});
    }
  }
  return sum;
}

struct Window {
  explicit Window(unsigned seed, int flows) : t(1, flows) {
    std::mt19937 random(seed);
    F = random_matrix(random, 3, 3);
    J = random_matrix(random, 3, 3) + 1.5 * Matrix::Identity(3, 3);
    Hc = random_matrix(random, 1, 3);
    Hd = random_matrix(random, 2, 3);
    t = random_matrix(random, 1, flows).cwiseAbs();
    world.set("F", F).set("J", J).set("Hc", Hc).set("Hd", Hd).set("t", t);
  }
  /// The transition from the start to the end.
  Matrix transition() const {
    Matrix M = flow(F, t(0));
    for (Eigen::Index k = 1; k < t.size(); ++k) M = product({flow(F, t(k)), J, M});
    return M;
  }
  Matrix F, J, Hc, Hd, t;
  World world;
};

class Gramian : public testing::TestWithParam<int> {};

TEST_P(Gramian, IsTheSumOfTheOutputsOfItsDefinition) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Window w(seed, GetParam());
    Matrix M = Matrix::Identity(3, 3);
    Matrix expected = Matrix::Zero(3, 3);
    for (Eigen::Index k = 0; k < w.t.size(); ++k) {
      expected += integral(w.F, w.Hc, M, w.t(k));
      M = product({flow(w.F, w.t(k)), M});
      if (k + 1 == w.t.size()) break;
      const Matrix seen = product({w.Hd, M});
      expected += product({seen.transpose(), seen});
      M = product({w.J, M});
    }
    EXPECT_LT(relative_difference(w.world("gramian(F, Hc, J, Hd, t)"), expected), 1e-12);
    EXPECT_EQ(w.world("gramian(F, Hc, J, Hd, t')"), w.world("gramian(F, Hc, J, Hd, t)"));
  }
}

TEST_P(Gramian, TheBackwardOneIsItsCongruence) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Window w(seed, GetParam());
    const Matrix inverse = tests::inverse(w.transition());
    const Matrix expected =
        product({inverse.transpose(), w.world("gramian(F, Hc, J, Hd, t)"), inverse});
    EXPECT_LT(relative_difference(w.world("backward_gramian(F, Hc, J, Hd, t)"), expected), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Flows, Gramian, testing::Values(1, 2, 3, 5));

/// The plant of Tran, Bernard and Marconi, Example 2: J has rank 2.
World example() {
  World world;
  world.set("F", Matrix{{0, -1, 0, 0}, {1, 0, 0, 0}, {0, 0, 0, -2}, {0, 0, 2, 0}});
  world.set("J", Matrix{{0, 0, 1, 0}, {0, 0, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}});
  world.set("Hc", Matrix{{1, 0, 0, 0}}).set("Hd", Matrix{{0, 0, 1, 0}});
  return world;
}

/// The observed oscillator is seen during the first flow only, since J maps nothing of it: its part
/// has the eigenvalues (tau +- sin tau)/2. Near pi/2 the other part is seen less.
TEST(GramianOfExample2, ItsSmallestEigenvalueIsThatOfTheObservedOscillator) {
  for (const double tau : {0.1, 0.4, 0.9, 1.3}) {
    World world = example();
    const Matrix G = world.set("tau", tau)("gramian(F, Hc, J, Hd, [tau, tau, tau])");
    const double smallest = tests::symmetric_eigenvalues(G)(0);
    EXPECT_NEAR(smallest, (tau - std::sin(tau)) / 2, 1e-14);
  }
}

TEST(GramianOfExample2, TheBackwardOneIsRefusedOnceTheWindowHasAJump) {
  const World world = example();
  const InputError error =
      input_error([&] { world("2*backward_gramian(F, Hc, J, Hd, [1, 0.5])"); });
  EXPECT_EQ(error.message(),
            "backward_gramian: the jump matrix J, which must be invertible, is singular to working "
            "precision");
  EXPECT_EQ(error.place().column, 3);
  EXPECT_EQ(world("backward_gramian(F, Hc, J, Hd, 1)").rows(), 4);
}

TEST(GramianArguments, MustFit) {
  const World world = example();
  const auto message = [&](const std::string& text) {
    return input_error([&] { world(text); }).message();
  };
  EXPECT_NE(message("gramian(Hc, Hc, J, Hd, 1)").find("needs a square matrix"), std::string::npos);
  EXPECT_NE(message("gramian(F, [1, 2], J, Hd, 1)").find("expected 1 x 4"), std::string::npos);
  EXPECT_NE(message("gramian(F, Hc, Hd, Hd, 1)").find("expected 4 x 4"), std::string::npos);
  EXPECT_NE(message("gramian(F, Hc, J, Hd', 1)").find("expected 4 x 4"), std::string::npos);
  EXPECT_NE(message("gramian(F, Hc, J, Hd, zeros(0, 1))").find("lengths of the flows"),
            std::string::npos);
  EXPECT_NE(message("gramian(F, Hc, J, Hd, eye(2))").find("lengths of the flows"),
            std::string::npos);
  EXPECT_EQ(world("gramian(F, Hc, J, zeros(0, 4), [1, 1])").rows(), 4) << "no output at jumps";
}

}  // namespace
}  // namespace gainsmith::expr
