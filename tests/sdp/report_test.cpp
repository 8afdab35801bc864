// The measures and certificates of report.h, recomputed in long double.
#include "sdp/core/report.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "base/random.h"
#include "support/linear_algebra.h"
#include "support/sdp_check.h"
#include "support/sdp_dense.h"

namespace gainsmith::sdp {
namespace {

using testing::Real;
using testing::Square;

template <typename T>
class Report : public ::testing::Test {};
using NarrowScalars = ::testing::Types<double, DoubleDouble>;
TYPED_TEST_SUITE(Report, NarrowScalars);

/// Random numbers with all the digits of T.
template <typename T>
class Numbers {
 public:
  explicit Numbers(std::uint64_t seed) : stream_(seed, 0) {}
  T number() {
    const double value = 2 * stream_.uniform() - 1;
    return T(value) + T(value * stream_.uniform() * (std::is_same_v<T, double> ? 0 : 0x1p-54));
  }

 private:
  RandomStream stream_;
};

/// Symmetric blocks a of random numbers; a a' + shift I where `positive`.
template <typename T>
std::vector<std::vector<T>> random_blocks(const Problem& problem, Numbers<T>& random,
                                          bool positive) {
  std::vector<std::vector<T>> result;
  for (const Block& block : problem.blocks) {
    const auto n = static_cast<std::size_t>(block.size);
    auto& values = result.emplace_back(block.diagonal ? n : n * n, T(0));
    if (block.diagonal) {
      for (T& v : values) v = random.number();
      if (positive)
        for (T& v : values) v *= v;
      continue;
    }
    std::vector<T> a(n * n);
    for (T& v : a) v = random.number();
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = 0; i <= j; ++i) {
        T value = a[i + n * j] + a[j + n * i];
        if (positive) {
          value = i == j ? T(0.1) : T(0);
          for (std::size_t k = 0; k < n; ++k) value += a[i + n * k] * a[j + n * k];
        }
        values[i + n * j] = values[j + n * i] = value;
      }
  }
  return result;
}

template <typename T>
Point<T> random_point(const Problem& problem, std::uint64_t seed, bool positive) {
  Numbers<T> random(seed);
  Point<T> point;
  for (std::size_t i = 0; i < problem.c.size(); ++i) point.x.push_back(random.number());
  point.X = random_blocks(problem, random, positive);
  point.Y = random_blocks(problem, random, positive);
  return point;
}

/// The smallest eigenvalue, zero rows left out as they have no say.
double smallest_eigenvalue(const std::vector<Square>& matrix) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Square& block : matrix) {
    const auto n =
        static_cast<Eigen::Index>(std::lround(std::sqrt(static_cast<double>(block.size()))));
    Eigen::MatrixXd rounded(n, n);
    for (std::size_t k = 0; k < block.size(); ++k)
      rounded.data()[k] = static_cast<double>(block[k]);
    smallest = std::min(smallest, tests::symmetric_eigenvalues(rounded)[0]);
  }
  return smallest;
}

/// max(0, -lambda), rounded up to a power of two: at most twice as much.
void expect_negative_part(double got, double smallest, double unit) {
  const double exact = std::max(0.0, -smallest) / unit;
  EXPECT_GE(got, exact * (1 - 1e-9));
  EXPECT_LE(got, 2 * exact * (1 + 1e-9));
}

TYPED_TEST(Report, MeasuresWhatSolutionSays) {
  using T = TypeParam;
  for (const auto& [name, problem] : testing::random_problems(51))
    for (const bool inside : {true, false}) {
      SCOPED_TRACE(name + (inside ? ", inside" : ", outside"));
      const Point<T> point = random_point<T>(problem, 9, inside);
      Solution solution;
      measure(problem, point, solution);
      store(point, solution);
      const testing::Errors expected = testing::recompute(problem, solution, 1e-12L);
      const auto near = [](double got, Real exact) {
        EXPECT_NEAR(got, static_cast<double>(exact), 1e-12 * (1 + std::abs(got)));
      };
      near(solution.primal_objective, expected.primal_objective);
      near(solution.dual_objective, expected.dual_objective);
      near(solution.relative_gap, expected.gap);
      near(solution.dimacs[0], expected.dual);
      near(solution.dimacs[2], expected.primal);
      near(solution.dimacs[4], expected.gap);
      near(solution.dimacs[5], expected.complementarity);

      double largest_c = 0, largest_f0 = 0;
      for (const double c : problem.c) largest_c = std::max(largest_c, std::abs(c));
      for (const Entry& e : problem.f[0]) largest_f0 = std::max(largest_f0, std::abs(e.value));
      const auto X = testing::unpack(problem, solution.X, solution.rest.X);
      const auto Y = testing::unpack(problem, solution.Y, solution.rest.Y);
      expect_negative_part(solution.dimacs[1], smallest_eigenvalue(Y), 1 + largest_c);
      expect_negative_part(solution.dimacs[3], smallest_eigenvalue(X), 1 + largest_f0);
      if (inside) {
        EXPECT_EQ(solution.dimacs[1], 0);
        EXPECT_EQ(solution.dimacs[3], 0);
      }
    }
}

TYPED_TEST(Report, StoresEveryDigit) {
  using T = TypeParam;
  for (const auto& [name, problem] : testing::random_problems(52)) {
    const Point<T> point = random_point<T>(problem, 10, true);
    Solution solution;
    store(point, solution);
    const auto sum = [](const std::vector<double>& value, const std::vector<double>& rest,
                        std::size_t k) {
      return rest.empty() ? T(value[k]) : T(T(value[k]) + T(rest[k]));
    };
    for (std::size_t i = 0; i < point.x.size(); ++i)
      EXPECT_EQ(sum(solution.x, solution.rest.x, i), point.x[i]);
    const bool rests = !std::is_same_v<T, double>;
    EXPECT_EQ(solution.rest.Y.values.size(), rests ? problem.blocks.size() : 0U);
    const std::vector<double> none;
    for (std::size_t b = 0; b < point.Y.size(); ++b)
      for (std::size_t k = 0; k < point.Y[b].size(); ++k) {
        EXPECT_EQ(sum(solution.X.values[b], rests ? solution.rest.X.values[b] : none, k),
                  point.X[b][k]);
        EXPECT_EQ(sum(solution.Y.values[b], rests ? solution.rest.Y.values[b] : none, k),
                  point.Y[b][k]);
      }
  }
}

// Any Y is a certificate with some residual; only the tolerance decides whether that is small.
TYPED_TEST(Report, ChecksCertificatesOfPrimalInfeasibility) {
  using T = TypeParam;
  for (const auto& [name, problem] : testing::random_problems(53)) {
    SCOPED_TRACE(name);
    for (const bool inside : {true, false}) {
      Point<T> point = random_point<T>(problem, 11, inside);
      Solution before, after;
      store(point, before);
      const Real value =
          testing::inner(problem, problem.f[0], testing::unpack(problem, before.Y, before.rest.Y));
      Certificate found = check_primal_infeasible(problem, point, 1e9);
      if (value <= 0) {
        EXPECT_FALSE(found.checked);
        for (auto& block : point.Y)
          for (T& v : block) v = -v;
        found = check_primal_infeasible(problem, point, 1e9);
      }
      store(point, after);
      const auto Y = testing::unpack(problem, after.Y, after.rest.Y);
      Real residual = 0;
      for (std::size_t i = 1; i < problem.f.size(); ++i)
        residual += std::abs(testing::inner(problem, problem.f[i], Y));
      const double smallest = smallest_eigenvalue(Y);
      EXPECT_NEAR(static_cast<double>(testing::inner(problem, problem.f[0], Y)), 1, 1e-11);
      EXPECT_NEAR(found.value, 1, 1e-11);
      EXPECT_NEAR(found.residual, static_cast<double>(residual),
                  1e-11 * static_cast<double>(residual));
      EXPECT_NEAR(found.excluded_radius, static_cast<double>(1 / residual),
                  1e-11 * found.excluded_radius);
      if (smallest < 0)
        expect_negative_part(-found.min_eigenvalue, smallest, 1);
      else
        EXPECT_NEAR(found.min_eigenvalue, smallest, 1e-11);
      EXPECT_EQ(found.checked, smallest >= 0);
      if (smallest < 0) continue;
      const auto tolerance = [&](double factor) { return found.residual * factor; };
      EXPECT_TRUE(check_primal_infeasible(problem, point, tolerance(1 + 1e-9)).checked);
      EXPECT_FALSE(check_primal_infeasible(problem, point, tolerance(1 - 1e-9)).checked);
    }
  }
}

TYPED_TEST(Report, ChecksCertificatesOfDualInfeasibility) {
  using T = TypeParam;
  for (const auto& [name, problem] : testing::random_problems(54)) {
    SCOPED_TRACE(name);
    Point<T> point = random_point<T>(problem, 12, true);
    const auto exact = [&] {
      Solution stored;
      store(point, stored);
      std::vector<Real> x(stored.x.begin(), stored.x.end());
      for (std::size_t i = 0; i < stored.rest.x.size(); ++i) x[i] += stored.rest.x[i];
      return x;
    };
    const auto cost = [&](const std::vector<Real>& x) {
      Real sum = 0;
      for (std::size_t i = 0; i < x.size(); ++i)
        sum += x[i] * (static_cast<Real>(problem.c[i]) + problem.c_rest[i]);
      return sum;
    };
    const bool descends = cost(exact()) < 0;
    Certificate found = check_dual_infeasible(problem, point, 1e9);
    if (!descends) {
      EXPECT_FALSE(found.checked);
      for (T& v : point.x) v = -v;
      found = check_dual_infeasible(problem, point, 1e9);
    }
    EXPECT_NEAR(static_cast<double>(cost(exact())), -1, 1e-11);
    EXPECT_NEAR(found.value, 1, 1e-11);
    const double smallest = smallest_eigenvalue(testing::combine(problem, exact(), 0));
    expect_negative_part(found.residual, smallest, 1);
    EXPECT_EQ(found.residual, std::max(0.0, -found.min_eigenvalue));
    EXPECT_EQ(found.excluded_radius, 1 / found.residual);
    EXPECT_TRUE(found.checked);
    if (found.residual == 0) continue;
    EXPECT_TRUE(check_dual_infeasible(problem, point, 1.01 * found.residual).checked);
    EXPECT_FALSE(check_dual_infeasible(problem, point, 0.49 * found.residual).checked);
  }
}

}  // namespace
}  // namespace gainsmith::sdp
