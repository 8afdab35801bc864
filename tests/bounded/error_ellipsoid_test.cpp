#include "bounded/error_ellipsoid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace gainsmith::bounded {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Draw {
  RandomStream random;
  double in(double low, double high) { return low + (high - low) * random.uniform(); }
  VectorXd within(const VectorXd& delta) {
    return delta.unaryExpr([&](double d) { return in(-d, d); });
  }
};

/// Errors that are drawn, and steps in which they are as large as allowed, stay below the bounds.
TEST(ErrorEllipsoid, BoundsEveryErrorOfItsSteps) {
  for (std::uint64_t run = 0; run < 300; ++run) {
    Draw draw{RandomStream(0xE11, run)};
    const Index n = 1 + static_cast<Index>(draw.in(0, 5));
    const double growth = std::pow(10.0, draw.in(-2, 2));
    const auto fresh = [&] {
      return VectorXd(VectorXd::NullaryExpr(
          n, [&] { return draw.in(0, 1) < 0.3 ? 0.0 : std::pow(10.0, draw.in(-20, -10)); }));
    };
    ErrorEllipsoid ellipsoid;
    VectorXd delta = fresh();
    ellipsoid.start(delta);
    VectorXd error = draw.within(delta);
    for (int step = 0; step < 60; ++step) {
      const MatrixXd E =
          MatrixXd::NullaryExpr(n, n, [&] { return growth * draw.in(-1, 1) / std::sqrt(n); });
      delta = fresh();
      VectorXd extreme = delta;
      for (Index i = 0; i < n; ++i)
        if (draw.in(0, 1) < 0.5) extreme(i) = -extreme(i);
      error = E * error + (run % 2 == 0 ? extreme : draw.within(delta));
      ellipsoid.step(E, E.cwiseAbs(), delta);
      if (step % 7 == 6) ellipsoid.gather();
      const double slack = 1e-13 * error.cwiseAbs().maxCoeff();  // of this test's own sums
      for (Index i = 0; i < n; ++i)
        ASSERT_LE(std::abs(error(i)) - slack, ellipsoid.bounds()(i))
            << "run " << run << " step " << step;
    }
  }
}

/// Turning steps keep a bound that sums of |E| would let grow by 2^(steps/2).
TEST(ErrorEllipsoid, ErrorsThatTurnDoNotGrow) {
  MatrixXd E(2, 2);
  E << std::sqrt(0.5), -std::sqrt(0.5), std::sqrt(0.5), std::sqrt(0.5);
  ErrorEllipsoid ellipsoid;
  ellipsoid.start(VectorXd::Constant(2, 1e-10));
  for (int step = 0; step < 400; ++step) {
    ellipsoid.step(E, E.cwiseAbs(), VectorXd::Zero(2));
    if (step % 20 == 19) ellipsoid.gather();
  }
  EXPECT_GE(ellipsoid.bounds().maxCoeff(), 1e-10);
  EXPECT_LE(ellipsoid.bounds().maxCoeff(), 1e-7);
}

/// Errors of 1e-300 and of 1e300 are bounded as well as those of 1.
TEST(ErrorEllipsoid, FollowsErrorsOverManyDecades) {
  MatrixXd E(2, 2);
  E << 0.5, 0.1, 0, 0.25;
  ErrorEllipsoid ellipsoid;
  ellipsoid.start(VectorXd::Ones(2));
  VectorXd error = VectorXd::Ones(2);
  for (int step = 0; step < 900; ++step) {
    error = E * error;
    ellipsoid.step(E, E, VectorXd::Zero(2));
    if (step % 10 == 9) ellipsoid.gather();
    ASSERT_GE(ellipsoid.bounds()(0), error(0) * (1 - 1e-12)) << step;
  }
  EXPECT_LE(ellipsoid.bounds()(0), 1e-230);
}

TEST(ErrorEllipsoid, ZeroStaysExactlyZero) {
  ErrorEllipsoid ellipsoid;
  ellipsoid.start(VectorXd::Zero(3));
  for (int step = 0; step < 10; ++step) {
    ellipsoid.step(MatrixXd::Random(3, 3), MatrixXd::Ones(3, 3), VectorXd::Zero(3));
    ellipsoid.gather();
  }
  EXPECT_EQ(ellipsoid.bounds().maxCoeff(), 0);
}

}  // namespace
}  // namespace gainsmith::bounded
