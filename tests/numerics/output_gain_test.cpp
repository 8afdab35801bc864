#include "numerics/output_gain.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <random>

namespace gainsmith::numerics {
namespace {

double abscissa(const Matrix& M) { return M.eigenvalues().real().maxCoeff(); }
double radius(const Matrix& M) { return M.eigenvalues().cwiseAbs().maxCoeff(); }

Matrix random_matrix(std::mt19937& random, int rows, int columns) {
  std::normal_distribution<double> normal;
  return Matrix::NullaryExpr(rows, columns, [&] { return normal(random); });
}

struct Plant {
  Matrix A, B, C;
};

/// A plant that the gain F, some 1 in size, takes to the given abscissa or radius.
Plant stabilisable(std::mt19937& random, Time time) {
  const auto size = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
  };
  const int n = size(2, 8);
  const Matrix B = random_matrix(random, n, size(1, 3));
  const Matrix C = random_matrix(random, size(1, 3), n);
  const Matrix F = random_matrix(random, static_cast<int>(B.cols()), static_cast<int>(C.rows()));
  Matrix closed = random_matrix(random, n, n);
  if (time == Time::continuous)
    closed -= (abscissa(closed) + 0.3) * Matrix::Identity(n, n);
  else
    closed *= 0.8 / radius(closed);
  return {closed - B * F * C, B, C};
}

TEST(OutputGain, StabilisesMostPlantsThatSomeGainStabilises) {
  constexpr int kPlants = 100;
  for (const Time time : {Time::continuous, Time::discrete}) {
    std::mt19937 random(7);
    int stable = 0;
    for (int i = 0; i < kPlants; ++i) {
      const auto [A, B, C] = stabilisable(random, time);
      const Matrix closed = A + B * output_gain(A, B, C, time) * C;
      if (time == Time::continuous ? abscissa(closed) < 0 : radius(closed) < 1) ++stable;
    }
    EXPECT_GE(stable, 97);
  }
}

/// u = F x2 of x'' = u: the closed loop is s^2 - F2 s - F1.
TEST(OutputGain, SolvesWhatHasAnAnswerByHand) {
  const Matrix A{{0, 1}, {0, 0}}, B{{0}, {1}};
  const Matrix F = output_gain(A, B, Matrix::Identity(2, 2), Time::continuous);
  EXPECT_LT(F(0, 0), 0);
  EXPECT_LT(F(0, 1), 0);
  // Without the speed no gain makes the trace negative.
  const Matrix position = output_gain(A, B, Matrix{{1, 0}}, Time::continuous);
  EXPECT_GE(abscissa(A + B * position * Matrix{{1, 0}}), -1e-12);
}

/// Units of inputs and outputs change the gain as they should, bit for bit where they are powers of
/// two.
TEST(OutputGain, FollowsTheUnitsOfInputsAndOutputs) {
  std::mt19937 random(3);
  for (int i = 0; i < 20; ++i) {
    const auto [A, B, C] = stabilisable(random, Time::continuous);
    const Matrix F = output_gain(A, B, C, Time::continuous);
    EXPECT_EQ(output_gain(A, B, C, Time::continuous), F);
    EXPECT_EQ(output_gain(A, 1024 * B, C / 64, Time::continuous), F / 16);
  }
}

TEST(OutputGain, OfNothingIsNothing) {
  const Matrix one = Matrix::Ones(1, 1);
  EXPECT_EQ(output_gain(Matrix(0, 0), Matrix(0, 1), Matrix(2, 0), Time::continuous),
            Matrix::Zero(1, 2));
  EXPECT_EQ(output_gain(one, Matrix(1, 0), one, Time::continuous).size(), 0);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity(), 1e308}) {
    const Matrix F = output_gain(Matrix{{0, bad}, {bad, 0}}, Matrix{{0}, {1}}, Matrix{{1, 0}},
                                 Time::discrete);
    EXPECT_TRUE(F.allFinite());
  }
}

}  // namespace
}  // namespace gainsmith::numerics
