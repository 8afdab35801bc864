// The implicit Runge-Kutta method of Gauss: its coefficients, its order, stiff flows.
#include "ode/gauss.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace gainsmith::ode {
namespace {

using Eigen::VectorXd;

VectorXd column(std::initializer_list<double> values) {
  VectorXd result(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), result.begin());
  return result;
}

/// Steps of length h from x at 0 to `last`; the stages begin at x.
VectorXd integrate(const GaussIntegrator::Rate& rate, VectorXd x, double last, int steps,
                   double tolerance = 1e-13) {
  GaussIntegrator gauss(x.size(), rate);
  const VectorXd allowed = VectorXd::Constant(x.size(), tolerance);
  const double h = last / steps;
  for (int k = 0; k < steps; ++k) {
    const VectorXd here = x;
    const auto next = gauss.step(k * h, x, h, allowed, [&](double) { return here; });
    if (!next) throw std::runtime_error("no convergence");
    x = *next;
  }
  return x;
}

TEST(Gauss, CoefficientsSatisfyTheOrderConditions) {
  // B(8): sum_i b_i c_i^(k-1) = 1/k, k <= 8; C(4): sum_j a_ij c_j^(k-1) = c_i^k/k, k <= 4;
  // D(4): sum_i b_i c_i^(k-1) a_ij = b_j (1 - c_j^k)/k, k <= 4. They give order 8 (Butcher).
  const GaussTableau g = gauss_tableau();
  for (int k = 1; k <= 8; ++k)
    EXPECT_NEAR((g.b.array() * g.c.array().pow(k - 1)).sum(), 1.0 / k, 2e-16) << k;
  EXPECT_GT(std::abs((g.b.array() * g.c.array().pow(8)).sum() - 1.0 / 9), 1e-6);
  for (int k = 1; k <= 4; ++k) {
    const Eigen::Vector4d left = g.A * g.c.array().pow(k - 1).matrix();
    const Eigen::Vector4d right = g.c.array().pow(k) / k;
    EXPECT_LT((left - right).cwiseAbs().maxCoeff(), 2e-16) << k;
    const Eigen::Vector4d dual = g.A.transpose() * (g.b.array() * g.c.array().pow(k - 1)).matrix();
    const Eigen::Vector4d expected = g.b.array() * (1 - g.c.array().pow(k)) / k;
    EXPECT_LT((dual - expected).cwiseAbs().maxCoeff(), 2e-16) << k;
  }
  EXPECT_LT((g.A.transpose() * g.d - g.b).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(Gauss, ErrorFallsLikeTheEighthPowerOfTheStep) {
  // x' = cos(5 t) x from 1: x = exp(sin(5 t)/5).
  const auto rate = [](double t, const VectorXd& x, VectorXd& out) { out = std::cos(5 * t) * x; };
  const double exact = std::exp(std::sin(10.0) / 5);
  const double coarse = std::abs(integrate(rate, column({1}), 2, 10)(0) - exact);
  const double fine = std::abs(integrate(rate, column({1}), 2, 20)(0) - exact);
  EXPECT_GT(fine, 1e-14);  // above rounding, so that the ratio says something
  EXPECT_GT(std::log2(coarse / fine), 7.5);
  EXPECT_LT(std::log2(coarse / fine), 9.5);
}

TEST(Gauss, KeepsTheEnergyOfAnOscillator) {
  const auto rate = [](double, const VectorXd& x, VectorXd& out) { out = column({x(1), -x(0)}); };
  const VectorXd x = integrate(rate, column({1, 0}), 100, 200);
  EXPECT_NEAR(x.norm(), 1, 1e-12);
  EXPECT_NEAR(x(0), std::cos(100.0), 1e-7);
}

TEST(Gauss, FollowsStiffFlows) {
  // x' = -1e8 (x - cos t) - sin t, x = cos t: fixed-point iterations diverge here.
  const auto rate = [](double t, const VectorXd& x, VectorXd& out) {
    out = column({-1e8 * (x(0) - std::cos(t)) - std::sin(t)});
  };
  // Of the eight orders the four of the stages are left.
  const double coarse = std::abs(integrate(rate, column({1}), 2, 20, 1e-12)(0) - std::cos(2.0));
  const double fine = std::abs(integrate(rate, column({1}), 2, 80, 1e-12)(0) - std::cos(2.0));
  EXPECT_LT(coarse, 1e-7);
  EXPECT_GT(std::log2(coarse / fine) / 2, 3.7);
  // Van der Pol with mu = 1e4 on its slow branch, against steps that are ten times shorter.
  const auto relaxation = [](double, const VectorXd& x, VectorXd& out) {
    out = column({x(1), 1e4 * ((1 - x(0) * x(0)) * x(1) - x(0) * 1e-4)});
  };
  const VectorXd start = column({2, -2.0 / 3 * 1e-4});
  const VectorXd rough_end = integrate(relaxation, start, 100, 50, 1e-12);
  const VectorXd fine_end = integrate(relaxation, start, 100, 500, 1e-12);
  EXPECT_LT((rough_end - fine_end).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(Gauss, SaysWhereItDoesNotConverge) {
  const auto rate = [](double, const VectorXd&, VectorXd& out) {
    out = column({0});
    throw std::runtime_error("no value");
  };
  GaussIntegrator gauss(1, rate);
  const VectorXd x = column({1});
  EXPECT_FALSE(gauss.step(0, x, 0.1, column({1e-10}), [&](double) { return x; }));
  // x' = x^2 from 1 over a step beyond its escape at t = 1 has no solution near by for 30.
  const auto escape = [](double, const VectorXd& y, VectorXd& out) { out = y.cwiseAbs2(); };
  GaussIntegrator far(1, escape);
  EXPECT_FALSE(far.step(0, x, 30, column({1e-10}), [&](double) { return x; }));
}

TEST(Gauss, OfNothingThereIsNothingToSolve) {
  const auto rate = [](double, const VectorXd&, VectorXd& out) { out.resize(0); };
  GaussIntegrator gauss(0, rate);
  const VectorXd none(0);
  EXPECT_EQ(gauss.step(0, none, 1, none, [&](double) { return none; })->size(), 0);
}

}  // namespace
}  // namespace gainsmith::ode
