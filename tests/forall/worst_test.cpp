#include "forall/worst.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "forall/variables.h"
#include "support/linear_algebra.h"

namespace gainsmith::forall {
namespace {

using testing::interval;
using testing::number;

std::vector<Minimum> minima_of(const std::string& text, const Domain& domain,
                               const numbers::Values& known = {}) {
  return local_minima(testing::program(text, domain, known), domain, known);
}

numbers::Matrix random_rotation(int n, std::mt19937& generator) {
  std::normal_distribution<double> normal;
  const numbers::Matrix random =
      numbers::Matrix::NullaryExpr(n, n, [&] { return normal(generator); });
  return tests::orthogonal_factor(random);
}

TEST(WorstTest, WithoutVariablesTheMatrixItself) {
  const auto found = minima_of("[2, 1; 1, 2]", {});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].value, 1, 1e-15);
  EXPECT_EQ(found[0].point.label, "");
}

/// Eigenvalues a_i + c_i (tau - m_i)^2 in a random basis: the smallest value is the smallest of the
/// a_i, and where two of them cross the curve of the smallest eigenvalue has a kink.
TEST(WorstTest, TheSmallestOfCrossingEigenvaluesIsFound) {
  std::mt19937 generator(21);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 60; ++trial) {
    constexpr int n = 4;
    numbers::Matrix a(n, 1);
    numbers::Matrix c(n, 1);
    numbers::Matrix m(n, 1);
    for (int i = 0; i < n; ++i) {
      a(i) = 2 * unit(generator) - 1;
      c(i) = std::exp(6 * unit(generator));
      m(i) = 0.05 + 2.9 * unit(generator);
    }
    const auto found = minima_of(
        "V*diag([a(1) + c(1)*(tau - m(1))^2, a(2) + c(2)*(tau - m(2))^2, "
        "a(3) + c(3)*(tau - m(3))^2, a(4) + c(4)*(tau - m(4))^2])*V'",
        {interval("tau", 0, 3)},
        {{"V", random_rotation(n, generator)}, {"a", a}, {"c", c}, {"m", m}});
    ASSERT_FALSE(found.empty());
    Eigen::Index lowest = 0;
    const double expected = a.col(0).minCoeff(&lowest);
    EXPECT_NEAR(found[0].value, expected, 1e-12);
    EXPECT_NEAR(found[0].point.values.at("tau")(0, 0), m(lowest), 1e-6);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end(), [](const Minimum& x, const Minimum& y) {
      return x.value < y.value;
    }));
  }
}

/// 1 + cos(w tau) touches 0 at odd multiples of pi/w, between the points of any grid.
TEST(WorstTest, EveryTouchingPointIsFound) {
  for (const int w : {1, 7, 40}) {
    const double pi = std::numbers::pi;
    std::set<int> expected;
    for (int k = 1; k * pi / w < 3.3; k += 2)
      if (k * pi / w > 0.1) expected.insert(k);
    std::set<int> touching;
    for (const Minimum& minimum :
         minima_of("[1 + cos(w*tau), 0; 0, 5]", {interval("tau", 0.1, 3.3)}, {{"w", number(w)}})) {
      if (minimum.value > 1e-9) continue;
      const double multiple = minimum.point.values.at("tau")(0, 0) * w / pi;
      touching.insert(static_cast<int>(std::lround(multiple)));
      EXPECT_NEAR(multiple, std::round(multiple), 1e-6);
    }
    EXPECT_EQ(touching, expected) << w;
  }
}

/// A gain for the rotation A = [0 1; -1 0] seen in one coordinate fails at tau = pi whatever it is:
/// [P, ((P - P F C) expm(A tau))'; *, P] is singular there.
TEST(WorstTest, TheRotationFailsAtPi) {
  std::mt19937 generator(22);
  std::uniform_real_distribution<double> unit(-1, 1);
  numbers::Matrix A(2, 2);
  A << 0, 1, -1, 0;
  for (int trial = 0; trial < 20; ++trial) {
    numbers::Matrix F(2, 1);
    F << 1 + 0.1 * unit(generator), 0.1 * unit(generator);
    numbers::Matrix P = numbers::Matrix::Identity(2, 2);
    P(0, 1) = P(1, 0) = 0.3 * unit(generator);
    const auto found = minima_of("[P, (P*(eye(2) - F*[1, 0])*expm(A*tau))'; *, P]",
                                 {interval("tau", 3, 3.3)}, {{"A", A}, {"F", F}, {"P", P}});
    ASSERT_FALSE(found.empty());
    EXPECT_LE(found[0].value, 1e-15);
  }
}

TEST(WorstTest, AMinimumAtAnEndIsOne) {
  const auto found = minima_of("exp(tau)*[2, 1; 1, 2]", {interval("tau", -1, 2)});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_DOUBLE_EQ(found[0].value, std::exp(-1.0));
  EXPECT_EQ(found[0].point.label, "tau = -1");
}

TEST(WorstTest, FunctionsThatAreNoAtomsAreTaken) {
  // tau + 1/tau >= 2 with equality at 1.
  const auto found =
      minima_of("inv([1/tau, 0; 0, 1]) + [1/tau, 0; 0, 9]", {interval("tau", 0.2, 7)});
  EXPECT_NEAR(found[0].value, 2, 1e-12);
  EXPECT_NEAR(found[0].point.values.at("tau")(0, 0), 1, 1e-6);
}

/// The smallest eigenvalue is concave over a polytope, so its smallest value is at a vertex.
TEST(WorstTest, OfAPolytopeTheWorstVertex) {
  std::mt19937 generator(23);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<numbers::Matrix> corners(4);
    for (numbers::Matrix& corner : corners)
      corner = numbers::Matrix::NullaryExpr(3, 3, [&] { return unit(generator); });
    const Domain domain = {testing::polytope("B", corners)};
    const auto found = minima_of("He(B)", domain);
    ASSERT_EQ(found.size(), corners.size());
    const double inside =
        minima_of("He(M)", {}, {{"M", 0.4 * corners[0] + 0.3 * corners[1] + 0.3 * corners[3]}})[0]
            .value;
    EXPECT_GE(inside, found[0].value);
    EXPECT_EQ(found[0].point.label.substr(0, 4), "B = ");
  }
}

TEST(WorstTest, SetsAndIntervalsTogether) {
  const Domain domain = {testing::set("k", {number(1), number(3), number(2)}),
                         interval("tau", 0, 4)};
  const auto found = minima_of("(tau - k)^2 - k", domain);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].point.label, "k = 2, tau = 3");
  EXPECT_NEAR(found[0].value, -3, 1e-12);
  EXPECT_NEAR(found[2].value, -1, 1e-12);
}

TEST(WorstTest, ABoxOfTwoIntervals) {
  std::mt19937 generator(24);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 10; ++trial) {
    numbers::Matrix m(2, 1);
    m << 2 * unit(generator), 1 + unit(generator);
    const auto found =
        minima_of("[1 + (s - m(1))^2 + 3*(t - m(2))^2 + (s - m(1))*(t - m(2)), 0; 0, 100]",
                  {interval("s", 0, 2), interval("t", 1, 2)}, {{"m", m}});
    EXPECT_NEAR(found[0].value, 1, 1e-8);
    EXPECT_NEAR(found[0].point.values.at("s")(0, 0), m(0), 1e-3);
    EXPECT_NEAR(found[0].point.values.at("t")(0, 0), m(1), 1e-3);
  }
}

}  // namespace
}  // namespace gainsmith::forall
