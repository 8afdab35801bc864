// largest_over_box against maxima that are known: smooth, on borders, on ridges, one of many.
#include "numerics/box_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace gainsmith::numerics {
namespace {

Vector ends(int n, double value) { return Vector::Constant(n, value); }

Vector random_vector(std::mt19937& random, int n, double low, double high) {
  std::uniform_real_distribution<double> element(low, high);
  Vector x(n);
  for (double& each : x) each = element(random);
  return x;
}

TEST(BoxSearch, FindsTheTopOfConcaveQuadratics) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 20; ++trial) {
    const int n = 1 + trial % 5;
    Matrix half(n, n);
    for (double& x : half.reshaped()) x = std::uniform_real_distribution<double>(-1, 1)(random);
    const Matrix Q = half * half.transpose() + 0.01 * Matrix::Identity(n, n);
    const Vector top = random_vector(random, n, -0.9, 0.9);
    const auto f = [&](const Vector& x) { return 3 - (x - top).dot(Q * (x - top)); };
    const BoxPoint found = largest_over_box(f, ends(n, -1), ends(n, 1));
    EXPECT_NEAR(found.value, 3, 1e-13) << "n = " << n;
    EXPECT_EQ(found.value, f(found.point));
    EXPECT_LT((found.point - top).lpNorm<Eigen::Infinity>(), 1e-5);
  }
}

TEST(BoxSearch, FindsCornersOfConvexFunctionsExactly) {
  std::mt19937 random(2);
  for (int n = 1; n <= 8; ++n) {
    const Vector centre = random_vector(random, n, -0.3, 0.3);
    const Vector low = random_vector(random, n, -2, -1), high = random_vector(random, n, 1, 2);
    const Vector farthest = (low - centre).cwiseAbs().cwiseMax((high - centre).cwiseAbs());
    const BoxPoint found =
        largest_over_box([&](const Vector& x) { return (x - centre).norm(); }, low, high);
    EXPECT_NEAR(found.value, farthest.norm(), 1e-15 * found.value);
    for (int i = 0; i < n; ++i)
      EXPECT_TRUE(found.point(i) == low(i) || found.point(i) == high(i)) << found.point(i);
  }
}

TEST(BoxSearch, FindsTopsOnBoundaries) {
  // x(1) pushes against its end, x(2) has its top inside.
  const auto f = [](const Vector& x) { return x(0) + x(0) * x(1) - x(1) * x(1); };
  Vector low(2), high(2);
  low << 0, -3;
  high << 2, 3;
  const BoxPoint found = largest_over_box(f, low, high);
  EXPECT_EQ(found.point(0), 2);
  EXPECT_NEAR(found.point(1), 1, 1e-6);
  EXPECT_NEAR(found.value, 3, 1e-14);
}

TEST(BoxSearch, ClimbsRidges) {
  // Steep across, slow along: the top of the ridge x = y at x + y = 1.
  const auto sharp = [](const Vector& x) {
    return -100 * std::abs(x(0) - x(1)) - std::abs(x(0) + x(1) - 1);
  };
  EXPECT_NEAR(largest_over_box(sharp, ends(2, -3), ends(2, 2)).value, 0, 1e-7);
  const auto curved = [](const Vector& x) {
    return -100 * std::pow(x(1) - x(0) * x(0), 2) - std::pow(1 - x(0), 2);
  };
  EXPECT_NEAR(largest_over_box(curved, ends(2, -2), ends(2, 2)).value, 0, 1e-12);
  const auto least = [](const Vector& x) { return std::min({x(0), 2 * x(1), 1.5 - x(0) - x(1)}); };
  EXPECT_NEAR(largest_over_box(least, ends(2, -2), ends(2, 2)).value, 0.6, 1e-9);
}

TEST(BoxSearch, FindsTheHighestOfManyTops) {
  const auto waves = [](const Vector& x) {
    double sum = 0;
    for (const double each : x) {
      const double d = each - 0.7;
      sum += std::cos(6 * std::numbers::pi * d) - d * d;
    }
    return sum;
  };
  for (int n = 1; n <= 3; ++n)
    EXPECT_NEAR(largest_over_box(waves, ends(n, -2), ends(n, 2)).value, n, 1e-12) << n;
}

TEST(BoxSearch, FindsANeedleThatIsNotNarrowerThanItsPoints) {
  const auto needle = [](const Vector& x) {
    return std::exp(-std::pow((x(0) - 0.61) / 0.003, 2)) + 0.1 * x(0);
  };
  const double at = largest_over_box(needle, ends(1, 0), ends(1, 1)).value;
  EXPECT_GT(at, needle(ends(1, 0.61)) - 1e-12);
}

TEST(BoxSearch, IsNeverBelowRandomPoints) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 10; ++trial) {
    const int n = 1 + trial % 4;
    const Vector w = random_vector(random, n, -4, 4), shift = random_vector(random, n, -3, 3);
    const auto f = [&](const Vector& x) {
      return std::abs(std::sin(w.dot(x) + 1)) + (x - shift).lpNorm<1>() * std::cos(x(0));
    };
    const BoxPoint found = largest_over_box(f, ends(n, -2), ends(n, 2));
    for (int k = 0; k < 5000; ++k)
      ASSERT_LE(f(random_vector(random, n, -2, 2)), found.value + 1e-9) << "trial " << trial;
  }
}

/// Tops that lie closer together than starts would be apart on a box of several coordinates.
TEST(BoxSearch, TakesTheHighestOfManyTops) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 40; ++trial) {
    const double top = std::uniform_real_distribution<>(0.5, 9.5)(random);
    const auto f = [&](const Vector& x) {
      return std::cos(30 * (x(0) - top)) * std::exp(-0.3 * (x(0) - top) * (x(0) - top));
    };
    EXPECT_NEAR(largest_over_box(f, ends(1, 0), ends(1, 10)).value, 1, 1e-9) << top;
  }
}

TEST(BoxSearch, OfOnePoint) {
  int calls = 0;
  const auto f = [&](const Vector& x) {
    ++calls;
    return x.sum();
  };
  EXPECT_EQ(largest_over_box(f, ends(3, 2), ends(3, 2)).value, 6);
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(largest_over_box(f, Vector(0), Vector(0)).value, 0);
}

TEST(BoxSearch, GivesTheSameBits) {
  const auto f = [](const Vector& x) { return std::sin(5 * x(0)) * std::cos(3 * x(1)) + x(2); };
  const BoxPoint first = largest_over_box(f, ends(3, -1), ends(3, 2));
  const BoxPoint again = largest_over_box(f, ends(3, -1), ends(3, 2));
  EXPECT_EQ(first.value, again.value);
  EXPECT_EQ(first.point, again.point);
}

TEST(BoxSearch, AsksWithinTheBoxAlone) {
  Vector low(2), high(2);
  low << 0.1, -1e-3;
  high << 0.3, 1e3;
  const auto f = [&](const Vector& x) {
    EXPECT_TRUE((x.array() >= low.array()).all() && (x.array() <= high.array()).all());
    return x(0) - std::abs(x(1) - 5);
  };
  EXPECT_NEAR(largest_over_box(f, low, high).value, 0.3, 1e-6);
}

}  // namespace
}  // namespace gainsmith::numerics
