// Every equation of newton.h, recomputed in full matrices from random data.
#include "sdp/core/newton.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <string>

#include "sdp/core/presolve.h"
#include "support/linear_algebra.h"
#include "support/sdp_dense.h"

namespace gainsmith::sdp {
namespace {

using testing::Dense;
using testing::Full;
using testing::full;
using testing::largest;
using testing::plus;
using testing::symmetric_part;
using testing::times;
using testing::trace_of_product;

/// A random interior point and what it leaves of the equations, by the definition.
template <typename T>
struct Setting {
  Setting(const Problem& problem, std::uint64_t seed)
      : data(presolve(problem).data), dense(data), point(data), defect(data) {
    testing::fill(seed, point.x);
    testing::fill_positive(seed + 1, data, point.X);
    testing::fill_positive(seed + 2, point.Y);
    point.tau = T(1.25) + T(1) / T(3);
    point.kappa = T(0.5) + T(1) / T(7);
    observe();
  }

  void observe() {
    X = full(point.X);
    Y = full(point.Y);
    R = plus(dense.combine(point.x, point.tau), T(-1), X);
    r = point.tau * dense.c - dense.products(Y);
    g = trace_of_product(dense.f[0], Y) - dense.c.dot(point.x) - point.kappa;
    for (int b = 0; b < data.layout.blocks(); ++b)
      defect.primal.dense(b) = R[static_cast<std::size_t>(b)];
    for (int k = 0; k < data.layout.linear; ++k)
      defect.primal.linear()[k] = R[static_cast<std::size_t>(data.layout.blocks() + k)](0, 0);
    defect.dual = r;
  }

  T order() const { return T(static_cast<double>(data.layout.order())); }

  Data data;
  Dense<T> dense;
  Iterate<T> point;
  Defect<T> defect;
  Full<T> X, Y, R;
  Vector<T> r;
  T g{0};
};

template <typename T>
class NewtonEquations : public ::testing::Test {
 protected:
  /// For numbers of the size of the largest that cancel.
  static double tolerance() { return 1e4 * static_cast<double>(std::numeric_limits<T>::epsilon()); }

  /// What a direction for sigma, eta and the second-order terms C, c_tk must satisfy.
  struct Aim {
    T sigma{0}, eta{1}, mu{0};
    Full<T> second_order;  ///< C
    T c_tau_kappa{0};
  };

  static void expect_direction(const Setting<T>& at, const Aim& aim, Model model,
                               const Iterate<T>& direction) {
    const Full<T> dX = full(direction.X), dY = full(direction.Y);
    const Full<T> inverse_X = testing::inverse(at.X);

    // dX = A*(dx) - dtau F_0 + eta R
    const Full<T> image = at.dense.combine(direction.x, direction.tau);
    const Full<T> primal = plus(plus(dX, T(-1), image), T(-aim.eta), at.R);
    EXPECT_LT(largest(primal), tolerance() * (largest(dX) + largest(at.R)));

    // A(dY) = dtau c + eta r
    const Vector<T> products = at.dense.products(dY);
    const Vector<T> dual = products - direction.tau * at.dense.c - aim.eta * at.r;
    // At a fixed tau wide arithmetic may leave a thousandth of the defect.
    const bool loose = model == Model::fixed && !std::is_same_v<T, double>;
    EXPECT_LT(largest(dual), tolerance() * (largest(products) + largest(at.r)) +
                                 (loose ? 1e-3 * static_cast<double>(T(at.r.norm())) : 0));

    // dY + H(X^-1 dX Y) = sigma mu X^-1 - Y - H(X^-1 C)
    const Full<T> moved = symmetric_part(times(inverse_X, times(dX, at.Y)));
    const Full<T> second = symmetric_part(times(inverse_X, aim.second_order));
    const T target = aim.sigma * aim.mu;
    const Full<T> left = plus(plus(dY, T(1), moved), T(1), second);
    const Full<T> difference = plus(plus(left, T(1), at.Y), T(-target), inverse_X);
    EXPECT_LT(largest(difference), tolerance() * (largest(moved) + largest(at.Y)));

    if (model == Model::fixed) {
      EXPECT_EQ(direction.tau, T(0));
      EXPECT_EQ(direction.kappa, T(0));
      return;
    }
    // F_0.dY - c'dx - dkappa = -eta g
    const T rise = trace_of_product(at.dense.f[0], dY), cost = at.dense.c.dot(direction.x);
    const T gap = rise - cost - direction.kappa + aim.eta * at.g;
    EXPECT_LT(std::abs(static_cast<double>(gap)),
              tolerance() * (1 + std::abs(static_cast<double>(rise)) +
                             std::abs(static_cast<double>(cost)) + largest(dY) * largest(at.X)));
    // kappa dtau + tau dkappa = sigma mu - tau kappa - c_tk
    const T scalar = at.point.kappa * direction.tau + at.point.tau * direction.kappa - target +
                     at.point.tau * at.point.kappa + aim.c_tau_kappa;
    EXPECT_LT(std::abs(static_cast<double>(scalar)),
              tolerance() * (1 + std::abs(static_cast<double>(direction.tau))));
  }

  static Full<T> zero(const Setting<T>& at) { return plus(at.X, T(-1), at.X); }

  static void expect_both_directions(const Setting<T>& at, Model model) {
    Newton<T> newton(at.data, 1);
    ASSERT_TRUE(newton.factorise(at.point));
    ASSERT_TRUE(newton.prepare(at.point, at.defect, model, 0));
    const bool fixed = model == Model::fixed;
    Aim aim;
    aim.mu = fixed ? T(trace_of_product(at.X, at.Y) / at.order())
                   : T((trace_of_product(at.X, at.Y) + at.point.tau * at.point.kappa) /
                       (at.order() + T(1)));
    aim.second_order = zero(at);
    Iterate<T> predictor(at.data), direction(at.data);
    newton.predict(at.point, at.defect, predictor);
    expect_direction(at, aim, model, predictor);
    EXPECT_FALSE(newton.exhausted() || newton.imprecise());

    aim.sigma = T(0.3) + T(1) / T(11);
    aim.eta = fixed ? T(1) : T(T(1) - aim.sigma);
    aim.second_order = times(full(predictor.X), full(predictor.Y));
    aim.c_tau_kappa = predictor.tau * predictor.kappa;
    newton.correct(at.point, at.defect, predictor, aim.sigma, aim.eta, direction);
    expect_direction(at, aim, model, direction);
  }
};

using Scalars = ::testing::Types<double, DoubleDouble, Decimal100>;
TYPED_TEST_SUITE(NewtonEquations, Scalars);

TYPED_TEST(NewtonEquations, HoldInTheHomogeneousModel) {
  for (const auto& [name, problem] : testing::random_problems(31)) {
    SCOPED_TRACE(name);
    this->expect_both_directions(Setting<TypeParam>(problem, 7), Model::homogeneous);
  }
}

TYPED_TEST(NewtonEquations, HoldAtAFixedTau) {
  for (const auto& [name, problem] : testing::random_problems(32)) {
    SCOPED_TRACE(name);
    this->expect_both_directions(Setting<TypeParam>(problem, 8), Model::fixed);
  }
}

// (n+1) mu = -(tau g + x'r + R.Y), from which dtau is computed.
TYPED_TEST(NewtonEquations, RestOnAnIdentityOfTheModel) {
  using T = TypeParam;
  for (const auto& [name, problem] : testing::random_problems(33)) {
    SCOPED_TRACE(name);
    const Setting<T> at(problem, 9);
    const T sum = at.point.tau * at.g + at.point.x.dot(at.r) + trace_of_product(at.R, at.Y);
    const T expected = (at.order() + T(1)) * at.point.mu();
    EXPECT_LT(std::abs(static_cast<double>(T(sum + expected))),
              this->tolerance() * (static_cast<double>(expected) + largest(at.R) * 100));
    EXPECT_LT(std::abs(static_cast<double>(
                  T(at.order() * at.point.mu_fixed() - trace_of_product(at.X, at.Y)))),
              this->tolerance() * static_cast<double>(expected));
  }
}

TYPED_TEST(NewtonEquations, DoNotDependOnTheNumberOfThreads) {
  using T = TypeParam;
  for (const auto& [name, problem] : testing::random_problems(34)) {
    const Setting<T> at(problem, 10);
    Iterate<T> one(at.data), two(at.data);
    for (auto* const direction : {&one, &two}) {
      Newton<T> newton(at.data, direction == &one ? 1 : 2);
      ASSERT_TRUE(newton.factorise(at.point));
      ASSERT_TRUE(newton.prepare(at.point, at.defect, Model::homogeneous, 0));
      newton.predict(at.point, at.defect, *direction);
    }
    EXPECT_TRUE(one.x == two.x && one.Y.flat() == two.Y.flat() && one.tau == two.tau) << name;
  }
}

// The term that prepare() leaves out at a fixed tau changes dY by less than a part of Y.
TEST(NewtonResidual, IsLeftOutWhereItIsNegligible) {
  for (const auto& [name, problem] : testing::random_problems(37)) {
    SCOPED_TRACE(name);
    Setting<double> at(problem, 13);
    Iterate<double> with(at.data), without(at.data);
    for (const double size : {1e-7, 1.0}) {
      // The directions for R and for 0: equal where R is negligible.
      Defect<double> defect = at.defect;
      defect.primal.flat() *= size / defect.primal.flat().norm();
      for (auto* const direction : {&with, &without}) {
        if (direction == &without) defect.primal.flat().setZero();
        Newton<double> newton(at.data, 1);
        ASSERT_TRUE(newton.factorise(at.point));
        ASSERT_TRUE(newton.prepare(at.point, defect, Model::fixed, 0));
        newton.predict(at.point, defect, *direction);
      }
      const double difference = (with.Y.flat() - without.Y.flat()).norm();
      EXPECT_EQ(difference == 0, size < 1);
    }
  }
}

/// The largest a with matrix + a direction >= 0, block by block, from the eigenvalues of
/// L^-1 D L^-T.
double longest_step(const Full<double>& matrix, const Full<double>& direction) {
  double smallest = 0;
  for (std::size_t b = 0; b < matrix.size(); ++b)
    smallest = std::min(smallest, tests::pencil_eigenvalues(direction[b], matrix[b])[0]);
  return smallest < 0 ? -1 / smallest : std::numeric_limits<double>::infinity();
}

TEST(NewtonStep, EndsAtTheBoundary) {
  constexpr double kLongest = 2, kSharp = 0.02;
  // Blocks of 32 rows and more: by Lanczos, which may miss the smallest eigenvalue by some percent.
  constexpr int kLanczosSize = 32;
  for (const auto& [name, problem] : testing::random_problems(35)) {
    SCOPED_TRACE(name);
    Setting<double> at(problem, 11);
    bool large = false;
    for (const int n : at.data.layout.size) large = large || n >= kLanczosSize;
    const double above = large ? 1.1 : 1 + 1e-12;
    for (const Model model : {Model::fixed, Model::homogeneous}) {
      Newton<double> newton(at.data, 1);
      ASSERT_TRUE(newton.factorise(at.point));
      ASSERT_TRUE(newton.prepare(at.point, at.defect, model, 0));
      Iterate<double> direction(at.data);
      testing::fill_symmetric(3, direction.X);
      testing::fill_symmetric(4, direction.Y);
      // Each of the four is the nearest boundary once.
      for (int nearest = 0; nearest < 4; ++nearest) {
        direction.tau = nearest == 2 ? -30 * at.point.tau : 0.1;
        direction.kappa = nearest == 3 ? -20 * at.point.kappa : 0.1;
        Iterate<double> scaled = direction;
        scaled.X.flat() *= nearest == 0 ? 10 : 0.001;
        scaled.Y.flat() *= nearest == 1 ? 10 : 0.001;
        const double in_X = std::min(kLongest, longest_step(at.X, full(scaled.X)));
        const double in_Y = std::min(kLongest, longest_step(at.Y, full(scaled.Y)));
        const Steps<double> steps = newton.step(at.point, scaled, kLongest);
        if (model == Model::fixed) {
          EXPECT_LE(steps.primal, in_X * above);
          EXPECT_GE(steps.primal, in_X * (1 - kSharp));
          EXPECT_LE(steps.dual, in_Y * above);
          EXPECT_GE(steps.dual, in_Y * (1 - kSharp));
          continue;
        }
        double expected = std::min(in_X, in_Y);
        if (nearest == 2) expected = std::min(expected, 1.0 / 30);
        if (nearest == 3) expected = std::min(expected, 1.0 / 20);
        EXPECT_LE(steps.primal, expected * above);
        EXPECT_GE(steps.primal, expected * (1 - kSharp));
        EXPECT_EQ(steps.primal, steps.dual);
      }
    }
  }
}

TEST(NewtonFactor, RefusesAPointOutsideTheCone) {
  for (const auto& [name, problem] : testing::random_problems(36)) {
    Setting<double> at(problem, 12);
    Newton<double> newton(at.data, 1);
    for (auto* const matrix : {&at.point.X, &at.point.Y}) {
      const Blocks<double> before = *matrix;
      matrix->flat() *= -1;
      EXPECT_FALSE(newton.factorise(at.point)) << name;
      *matrix = before;
    }
    EXPECT_TRUE(newton.factorise(at.point)) << name;
  }
}

}  // namespace
}  // namespace gainsmith::sdp
