#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "response/systems.h"

namespace gainsmith::response {
namespace {

using Complex = std::complex<double>;

/// num/den in controllable form, num as long as den.
StateSpace transfer(const std::vector<double>& num, const std::vector<double>& den) {
  const auto n = static_cast<Eigen::Index>(den.size()) - 1;
  StateSpace system{Matrix::Zero(n, n), Matrix::Zero(n, 1), Matrix::Zero(1, n), Matrix{{num[0]}},
                    0};
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto at = static_cast<std::size_t>(k) + 1;
    system.A(0, k) = -den[at];
    system.C(0, k) = num[at] - num[0] * den[at];
    if (k + 1 < n) system.A(k + 1, k) = 1;
  }
  system.B(0, 0) = 1;
  return system;
}

std::vector<Complex> sorted(const Matrix& roots) {
  std::vector<Complex> all;
  for (Eigen::Index k = 0; k < roots.rows(); ++k) all.emplace_back(roots(k, 0), roots(k, 1));
  std::sort(all.begin(), all.end(), [](const Complex& a, const Complex& b) {
    return std::abs(a.real() - b.real()) > 1e-9 ? a.real() < b.real() : a.imag() < b.imag();
  });
  return all;
}

void expect_zeros(const StateSpace& system, const std::vector<Complex>& expected) {
  const std::vector<Complex> found = sorted(zeros(system));
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k)
    EXPECT_LT(std::abs(found[k] - expected[k]), 1e-7 * (1 + std::abs(expected[k])));
}

TEST(Zeros, AreThoseOfTheNumerator) {
  expect_zeros(transfer({0, 0, 0, 1}, {1, 6, 11, 6}), {});
  expect_zeros(transfer({0, 0, 1, 5}, {1, 6, 11, 6}), {{-5, 0}});
  expect_zeros(transfer({0, 1, 2, 10}, {1, 6, 11, 6}), {{-1, -3}, {-1, 3}});
  expect_zeros(transfer({2, 2, -12, 0}, {1, 6, 11, 6}), {{-3, 0}, {0, 0}, {2, 0}});
  // In other units of time.
  expect_zeros(transfer({0, 0, 1, 5e4}, {1, 6e4, 11e8, 6e12}), {{-5e4, 0}});
}

/// (1 - s T/2 + s^2 T^2/12)/(1 + s T/2 + s^2 T^2/12): the zeros are the poles on the other side.
TEST(Zeros, DoNotDependOnTheUnitOfTime) {
  for (const double T : {1e-9, 1e-3, 1.0, 1e6}) {
    const StateSpace delay{Matrix{{-6, -12}, {1, 0}} / T, Matrix{{1}, {0}} / T, Matrix{{-12, 0}},
                           Matrix{{1}}, 0};
    const double w = std::sqrt(3.0) / T;
    expect_zeros(delay, {{3 / T, -w}, {3 / T, w}});
  }
}

TEST(Zeros, AreHiddenModesToo) {
  // The second state is not reached, the third not seen.
  const StateSpace system{Matrix{{-1, 1, 0}, {0, -7, 0}, {1, 0, -9}}, Matrix{{1}, {0}, {2}},
                          Matrix{{1, 1, 0}}, Matrix{{0}}, 0};
  expect_zeros(system, {{-9, 0}, {-7, 0}});
}

TEST(Zeros, OfNothingAreNone) {
  expect_zeros({Matrix{{-1}}, Matrix{{0}}, Matrix{{0}}, Matrix{{0}}, 0}, {{-1, 0}});
  expect_zeros({Matrix(0, 0), Matrix(0, 1), Matrix(1, 0), Matrix{{2}}, 0}, {});
}

class RandomZeros : public testing::TestWithParam<int> {};

TEST_P(RandomZeros, LoseRank) {
  std::mt19937 random(static_cast<unsigned>(GetParam()));
  const Eigen::Index m = 1 + GetParam() % 3, n = 2 + GetParam() % 6;
  StateSpace system = random_system(random, n, m, m);
  const bool proper = GetParam() % 2 == 0;
  if (proper) system.D.setZero();
  const Matrix found = zeros(system);
  EXPECT_EQ(found.rows(), proper ? std::max<Eigen::Index>(n - m, 0) : n);
  for (Eigen::Index k = 0; k < found.rows(); ++k) {
    Eigen::MatrixXcd M(n + m, n + m);
    M << system.A.cast<Complex>(), system.B.cast<Complex>(), system.C.cast<Complex>(),
        system.D.cast<Complex>();
    M.diagonal().head(n).array() -= Complex(found(k, 0), found(k, 1));
    const Eigen::VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXcd>(M).singularValues();
    EXPECT_LT(values(n + m - 1), 1e-8 * values(0));
  }
}

TEST_P(RandomZeros, AreNoneWithMoreOutputsThanInputs) {
  std::mt19937 random(static_cast<unsigned>(GetParam()) + 50);
  EXPECT_EQ(zeros(random_system(random, 2 + GetParam() % 6, 1, 2)).rows(), 0);
  EXPECT_EQ(zeros(random_system(random, 2 + GetParam() % 6, 3, 2)).rows(), 0);
}

INSTANTIATE_TEST_SUITE_P(Random, RandomZeros, testing::Range(0, 18));

}  // namespace
}  // namespace gainsmith::response
