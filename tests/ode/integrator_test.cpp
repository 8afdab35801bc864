#include "ode/integrator.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

namespace gainsmith::ode {
namespace {

using Eigen::VectorXd;

struct Solved {
  double error = 0;  ///< the largest, at the ends of steps and within
  int steps = 0;
  int evaluations = 0;
};

/// The errors of x(0) over a flow from t = 0 against a closed form.
Solved solve(const VectorXd& x, double last, double accuracy, Integrator::Rate rate,
             const std::function<double(double)>& truth) {
  Solved solved;
  Integrator integrator(x.size(), [&](double t, const VectorXd& at, VectorXd& slope) {
    ++solved.evaluations;
    rate(t, at, slope);
  });
  integrator.start(0, x, last, accuracy, VectorXd::Constant(x.size(), accuracy), last);
  VectorXd at(x.size());
  for (double t = 0; t < last; ++solved.steps) {
    const Integrator::Step step = integrator.step();
    EXPECT_EQ(step.from, t);
    for (int k = 0; k <= 20; ++k) {
      const double here = step.from + (step.to - step.from) * k / 20;
      integrator.within(here, at);
      solved.error = std::max(solved.error, std::abs(at(0) - truth(here)));
    }
    t = step.to;
  }
  return solved;
}

/// x'' = -x is a sine; x' = -t x^2 from 2 has the solution 2/(1 + t^2).
TEST(Integrator, IsAsAccurateWithinStepsAsAtTheirEnds) {
  for (const double accuracy : {1e-6, 1e-8, 1e-10, 1e-12}) {
    const Solved wave = solve(
        Eigen::Vector2d(0, 1), 30, accuracy,
        [](double, const VectorXd& x, VectorXd& slope) { slope << x(1), -x(0); },
        [](double t) { return std::sin(t); });
    EXPECT_LE(wave.error, 30 * accuracy);
    const Solved bell = solve(
        VectorXd::Constant(1, 2), 10, accuracy,
        [](double t, const VectorXd& x, VectorXd& slope) { slope(0) = -t * x(0) * x(0); },
        [](double t) { return 2 / (1 + t * t); });
    EXPECT_LE(bell.error, 10 * accuracy);
    EXPECT_LE(bell.steps, 60);
  }
}

/// What decays at once keeps explicit steps short.
TEST(Integrator, GoesOnWithImplicitStepsWhereAFlowIsStiff) {
  for (const double fast : {1e5, 1e8}) {
    const Solved solved = solve(
        VectorXd::Constant(1, 1), 10, 1e-9,
        [&](double t, const VectorXd& x, VectorXd& slope) {
          slope(0) = -fast * (x(0) - std::cos(t)) - std::sin(t);
        },
        [](double t) { return std::cos(t); });
    EXPECT_LE(solved.error, 1e-7);
    EXPECT_LE(solved.evaluations, 10000);
  }
}

/// An element that begins at 0 beside a tolerance of hardly anything, and a rate that is another one
/// at the start alone.
TEST(Integrator, DoesNotStandStillAtAnElementThatIsNothing) {
  Integrator integrator(
      2, [](double t, const VectorXd& x, VectorXd& slope) { slope << -x(0), t == 0 ? -7.0 : 0.0; });
  integrator.start(0, Eigen::Vector2d(1, 0), 3, 1e-10, Eigen::Vector2d(1e-12, 1e-40), 3);
  VectorXd x(2);
  Integrator::Step step;
  for (int steps = 0; step.to < 3 && steps < 100; ++steps) {
    step = integrator.step();
    EXPECT_EQ(step.degree, 7) << "implicit from " << step.from;
  }
  integrator.within(3, x);
  EXPECT_NEAR(x(0), std::exp(-3), 1e-9);
  EXPECT_NEAR(x(1), 0, 1e-9);
}

/// f with noise: explicit steps would have to be so short that 79,000 are needed.
TEST(Integrator, NoiseIsLeftToImplicitSteps) {
  const Solved solved = solve(
      VectorXd::Constant(1, 1), 1, 1e-10,
      [](double t, const VectorXd& x, VectorXd& slope) {
        slope(0) = -x(0) + 1e-6 * std::sin(1e9 * t + 1e9 * x(0));
      },
      [](double t) { return std::exp(-t); });
  EXPECT_LE(solved.error, 1e-5);
  EXPECT_LE(solved.steps, 10000);
}

TEST(Integrator, SaysWhatEndsAFlow) {
  const auto end = [](Integrator::Rate rate) {
    Integrator integrator(1, std::move(rate));
    integrator.start(0, VectorXd::Constant(1, 1), 10, 1e-10, VectorXd::Constant(1, 1e-10), 10);
    try {
      while (integrator.step().to < 10) {
      }
    } catch (const IntegrationError& error) {
      return error;
    }
    return IntegrationError("none", 0, false);
  };
  const IntegrationError pole =
      end([](double, const VectorXd& x, VectorXd& slope) { slope(0) = x(0) * x(0); });
  EXPECT_TRUE(pole.escaped) << pole.what();
  EXPECT_NEAR(pole.t, 1, 1e-3);
  const IntegrationError thrown = end([](double t, const VectorXd&, VectorXd& slope) {
    if (t > 2) throw std::runtime_error("no value beyond 2");
    slope(0) = 1;
  });
  EXPECT_TRUE(thrown.undefined);
  EXPECT_STREQ(thrown.what(), "no value beyond 2");
  EXPECT_NEAR(thrown.t, 2, 1e-9);
}

}  // namespace
}  // namespace gainsmith::ode
