// Lower bounds by weak duality, against objectives of feasible points in fractions.
#include "verdict/weak_duality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "numbers/dense/dense.h"

namespace gainsmith::verdict {
namespace {

using numbers::Matrix;
using numbers::RationalMatrix;

/// min <C, X> over X >= 0 with trace(X) = 1, X = E_nn + sum of x_i B_i: the smallest eigenvalue of
/// C.
struct Case {
  Matrix C;
  RationalBlock block;
  Costs costs;

  explicit Case(const Matrix& of) : C(of) {
    const Eigen::Index n = C.rows();
    const RationalMatrix zero = RationalMatrix::Constant(n, n, Rational(0));
    block = {static_cast<int>(n), false, true, {{0, zero}}};
    block.terms[0].second(n - 1, n - 1) = 1;
    costs.push_back(numbers::ball_of(Rational(C(n - 1, n - 1))));
    for (Eigen::Index c = 0; c < n; ++c)
      for (Eigen::Index r = 0; r <= c; ++r) {
        if (r == n - 1) continue;
        RationalMatrix B = zero;
        B(r, c) = B(c, r) = 1;
        if (r == c) B(n - 1, n - 1) = -1;
        costs.push_back(numbers::ball_of(r == c ? Rational(C(r, r)) - Rational(C(n - 1, n - 1))
                                                : 2 * Rational(C(r, c))));
        block.terms.emplace_back(static_cast<int>(costs.size()) - 1, std::move(B));
      }
  }

  std::optional<double> bound(const Matrix& Y) const {
    lmi::Balance units;
    units.rows.emplace_back(static_cast<std::size_t>(C.rows()), 0);
    units.unknowns.assign(costs.size() - 1, 0);
    std::vector<int> rows(static_cast<std::size_t>(C.rows()));
    std::iota(rows.begin(), rows.end(), 0);
    const auto found = lower_bound({exact_block(block, units, 0, rows)},
                                   {Y.unaryExpr([](double y) { return DoubleDouble(y); })}, costs);
    return found ? std::optional(found->value) : std::nullopt;
  }

  /// <C, v v'> / v'v, without rounding.
  Rational at(const numbers::Vector& v) const {
    Rational value = 0, size = 0;
    for (Eigen::Index i = 0; i < v.size(); ++i) {
      size += Rational(v[i]) * Rational(v[i]);
      for (Eigen::Index j = 0; j < v.size(); ++j)
        value += Rational(C(i, j)) * Rational(v[i]) * Rational(v[j]);
    }
    return value / size;
  }
};

Matrix drawn(std::mt19937_64& random, int n) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Matrix M = Matrix::NullaryExpr(n, n, [&] { return uniform(random); });
  return (M + M.transpose()) / 2;
}

/// Y = C - l I is feasible for every l below the smallest eigenvalue, and its bound is l.
TEST(WeakDuality, ABoundIsNearTheMinimumAndNotAboveIt) {
  std::mt19937_64 random(0xB0);
  for (int n = 2; n <= 9; ++n) {
    const Case of(drawn(random, n));
    const numbers::SymmetricEigen eigen(of.C);
    const Rational least = of.at(eigen.vectors().col(0));
    const Matrix I = Matrix::Identity(n, n);
    for (const double gap : {1e-3, 1e-6, 1e-8}) {
      for (const double noise : {0.0, 1e-12, 0.01 * gap}) {
        const Matrix Y = of.C - (eigen.values()[0] - gap) * I + noise * drawn(random, n);
        const auto bound = of.bound(Y);
        ASSERT_TRUE(bound) << n << " " << gap << " " << noise;
        EXPECT_LE(Rational(*bound), least) << n << " " << gap << " " << noise;
        EXPECT_NEAR(*bound, eigen.values()[0], 3 * gap) << n << " " << noise;
      }
    }
  }
}

/// Whatever the multipliers are.
TEST(WeakDuality, NoMultipliersShowWhatIsFalse) {
  std::mt19937_64 random(0xB1);
  int shown = 0;
  for (int n = 2; n <= 6; ++n)
    for (int k = 0; k < 40; ++k) {
      const Case of(drawn(random, n));
      const numbers::SymmetricEigen eigen(of.C);
      const Matrix R = drawn(random, n);
      const Matrix Y = R * R + std::pow(10.0, -k % 8) * Matrix::Identity(n, n);
      const auto bound = of.bound(Y);
      shown += bound.has_value() ? 1 : 0;
      if (bound) {
        EXPECT_LE(Rational(*bound), of.at(eigen.vectors().col(0)));
      }
      // A multiple of the identity is off by a multiple of C.
      if (const auto far = of.bound(Matrix::Identity(n, n))) {
        EXPECT_LE(Rational(*far), of.at(eigen.vectors().col(0)));
      }
    }
  EXPECT_GT(shown, 0);
}

/// x_1 costs something, and no block holds it: nothing is below.
TEST(WeakDuality, ACostThatNothingLimitsHasNoBound) {
  Case of(Matrix::Identity(2, 2));
  of.costs.push_back(numbers::ball_of(Rational(1, 3)));
  EXPECT_FALSE(of.bound(Matrix::Identity(2, 2)));
  of.costs.pop_back();
  EXPECT_TRUE(of.bound(0.5 * Matrix::Identity(2, 2)));
}

}  // namespace
}  // namespace gainsmith::verdict
