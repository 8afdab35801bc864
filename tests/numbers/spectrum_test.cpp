#include "numbers/dense/spectrum.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <type_traits>

#include "base/eigen_scalars.h"
#include "base/scalars.h"

namespace gainsmith::numbers {
namespace {

template <class S>
class Spectrum : public testing::Test {
 protected:
  using M = MatrixOf<S>;

  M random(Eigen::Index rows, Eigen::Index cols) {
    std::uniform_real_distribution<double> element(-1, 1);
    M matrix(rows, cols);
    for (S& x : matrix.reshaped()) x = S(element(generator_));
    return matrix;
  }
  static double size(const M& matrix) {
    return static_cast<double>(S(matrix.cwiseAbs().maxCoeff()));
  }
  static double rounding() {
    return std::is_same_v<S, Decimal100> ? 1e-100
                                         : static_cast<double>(std::numeric_limits<S>::epsilon());
  }

 private:
  std::mt19937 generator_{3};
};

using Scalars = testing::Types<double, DoubleDouble, Decimal100>;
TYPED_TEST_SUITE(Spectrum, Scalars);

/// tr M = sum of l, tr M^2 = sum of l^2, tr M^3 = sum of l^3.
TYPED_TEST(Spectrum, PowerSumsAreTraces) {
  for (const Eigen::Index n : {1, 2, 3, 5, 9, 16}) {
    const auto A = this->random(n, n);
    const auto found = real_eigenvalues<TypeParam>(A);
    TypeParam one(0), two(0), three(0);
    for (Eigen::Index i = 0; i < n; ++i) {
      const TypeParam a = found(i, 0), b = found(i, 1);
      one += a;
      two += a * a - b * b;
      three += a * a * a - TypeParam(3) * a * b * b;
    }
    const auto square = times<TypeParam>(A, A);
    const double unit = 64 * static_cast<double>(n * n) * this->rounding();
    EXPECT_NEAR(static_cast<double>(TypeParam(one - A.trace())), 0, unit);
    EXPECT_NEAR(static_cast<double>(TypeParam(two - square.trace())), 0, unit);
    EXPECT_NEAR(static_cast<double>(TypeParam(three - times<TypeParam>(square, A).trace())), 0,
                4 * unit);
  }
}

TYPED_TEST(Spectrum, UnitsThatArePowersOfTwoDoNotMatter) {
  auto A = this->random(6, 6);
  const auto found = real_eigenvalues<TypeParam>(A);
  for (Eigen::Index k = 0; k < 6; ++k) {
    const TypeParam unit(std::ldexp(1.0, static_cast<int>(7 * k)));
    A.row(k) *= unit;
    A.col(k) /= unit;
  }
  EXPECT_EQ(this->size(real_eigenvalues<TypeParam>(A) - found), 0);
}

TYPED_TEST(Spectrum, NothingHasNoEigenvalues) {
  EXPECT_EQ(real_eigenvalues<TypeParam>(MatrixOf<TypeParam>(0, 0)).rows(), 0);
  EXPECT_EQ(this->size(real_eigenvalues<TypeParam>(MatrixOf<TypeParam>::Zero(3, 3))), 0);
}

TYPED_TEST(Spectrum, StabilisingSolutionsSolveTheirEquations) {
  for (const Eigen::Index n : {1, 2, 4, 7}) {
    const auto A = this->random(n, n);
    const auto B = this->random(n, 2);
    const MatrixOf<TypeParam> Q = MatrixOf<TypeParam>::Identity(n, n);
    const MatrixOf<TypeParam> R = MatrixOf<TypeParam>::Identity(2, 2);
    const MatrixOf<TypeParam> S = TypeParam(0.125) * this->random(n, 2);
    const auto product = [](const auto& a, const auto& b) {
      return times<TypeParam>(MatrixOf<TypeParam>(a), MatrixOf<TypeParam>(b));
    };
    const auto X = stabilising_solution<TypeParam>(Riccati::continuous, A, B, Q, R, S);
    const MatrixOf<TypeParam> cross = product(X, B) + S;
    const MatrixOf<TypeParam> XA = product(X, A);
    const MatrixOf<TypeParam> left = XA + XA.transpose() + Q;
    const MatrixOf<TypeParam> right = product(cross, cross.transpose());
    EXPECT_LE(this->size(left - right), 256 * this->rounding() * (1 + this->size(right)));
    const MatrixOf<TypeParam> closed = A - product(B, cross.transpose());
    EXPECT_LT(static_cast<double>(real_eigenvalues<TypeParam>(closed)(0, 0)), 0);

    const auto Y = stabilising_solution<TypeParam>(Riccati::discrete, A, B, Q, R, S);
    const MatrixOf<TypeParam> open = product(A.transpose(), product(Y, A)) - Y + Q;
    const MatrixOf<TypeParam> mixed = product(A.transpose(), product(Y, B)) + S;
    const MatrixOf<TypeParam> weight = R + product(B.transpose(), product(Y, B));
    // open * inv(weight) is checked without an inverse: K with weight K = mixed' by Cramer's rule.
    const TypeParam det = weight(0, 0) * weight(1, 1) - weight(0, 1) * weight(1, 0);
    MatrixOf<TypeParam> adjugate(2, 2);
    adjugate << weight(1, 1), -weight(0, 1), -weight(1, 0), weight(0, 0);
    const MatrixOf<TypeParam> K = product(adjugate, mixed.transpose()) / det;
    EXPECT_LE(this->size(open - product(mixed, K)),
              256 * this->rounding() * (1 + this->size(open)));
  }
}

/// The scalar equations are quadratic: 2 a x - (b x)^2/r + q = 0 has the root on the stable side.
TYPED_TEST(Spectrum, ScalarSolutionsAreThoseOfTheQuadraticEquation) {
  using std::sqrt;
  const auto number = [](double x) {
    return MatrixOf<TypeParam>(MatrixOf<TypeParam>::Constant(1, 1, TypeParam(x)));
  };
  for (const double a : {-3.0, -0.5, 0.0, 0.25, 4.0}) {
    const TypeParam x = stabilising_solution<TypeParam>(Riccati::continuous, number(a), number(2),
                                                        number(3), number(0.5), number(0))(0, 0);
    const TypeParam A(a);
    const TypeParam expected =
        (A + TypeParam(sqrt(TypeParam(A * A + TypeParam(24))))) / TypeParam(8);
    EXPECT_LE(static_cast<double>(TypeParam(x - expected)) / static_cast<double>(expected),
              8 * this->rounding());
    EXPECT_GE(static_cast<double>(TypeParam(x - expected)) / static_cast<double>(expected),
              -8 * this->rounding());
  }
}

TYPED_TEST(Spectrum, WithoutAStabilisingSolutionSayWhy) {
  const MatrixOf<TypeParam> one = MatrixOf<TypeParam>::Identity(1, 1);
  const MatrixOf<TypeParam> none = MatrixOf<TypeParam>::Zero(1, 1);
  const auto why = [&](Riccati equation, const auto& A, const auto& B, const auto& Q) {
    try {
      stabilising_solution<TypeParam>(equation, A, B, Q, one, none);
    } catch (const NoSolution& error) {
      return std::string(error.what());
    }
    return std::string("there is one");
  };
  EXPECT_NE(why(Riccati::continuous, one, none, one).find("B does not reach"), std::string::npos);
  EXPECT_NE(why(Riccati::discrete, one, none, one).find("B does not reach"), std::string::npos);
  EXPECT_NE(why(Riccati::continuous, none, one, none).find("on the imaginary axis"),
            std::string::npos);
  EXPECT_NE(why(Riccati::discrete, one, one, none).find("on the unit circle"), std::string::npos);
}

}  // namespace
}  // namespace gainsmith::numbers
