#include "ode/gauss.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "base/eigen_scalars.h"
#include "ode/gauss_stages.h"
#include "ode/tolerances.h"

namespace gainsmith::ode {

namespace {

constexpr int stages = 4;

/// The largest change in units of the tolerance.
double weighted(const numbers::Matrix& change, const Eigen::VectorXd& tolerance) {
  if (change.size() == 0) return 0;
  return (change.array().colwise() / tolerance.array()).abs().maxCoeff();
}

}  // namespace

GaussTableau gauss_tableau() {
  const GaussStages<DoubleDouble> of(stages);
  GaussTableau tableau{of.c.cast<double>(), of.b.cast<double>(), of.A.cast<double>(), {}};
  tableau.d = tableau.A.transpose().partialPivLu().solve(tableau.b);
  return tableau;
}

GaussIntegrator::GaussIntegrator(Eigen::Index size, Rate rate)
    : tableau_(gauss_tableau()),
      rate_(std::move(rate)),
      stages_(size, stages),
      rates_(size, stages),
      residual_(size, stages),
      at_(size),
      value_(size) {}

std::optional<Eigen::VectorXd> GaussIntegrator::step(double t, const Eigen::VectorXd& x, double h,
                                                     const Eigen::VectorXd& tolerance,
                                                     const Guess& guess) {
  for (Eigen::Index i = 0; i < stages; ++i) stages_.col(i) = guess(t + tableau_.c(i) * h) - x;
  if (!fixed_point(t, x, h, tolerance)) {
    for (Eigen::Index i = 0; i < stages; ++i) stages_.col(i) = guess(t + tableau_.c(i) * h) - x;
    if (!newton(t, x, h, tolerance)) return std::nullopt;
  }
  return x + stages_ * tableau_.d;
}

bool GaussIntegrator::residual(double t, const Eigen::VectorXd& x, double h) {
  try {
    for (Eigen::Index i = 0; i < stages; ++i) {
      at_ = x + stages_.col(i);
      rate_(t + tableau_.c(i) * h, at_, value_);
      rates_.col(i) = value_;
    }
  } catch (const std::runtime_error&) {
    return false;
  }
  residual_ = h * rates_ * tableau_.A.transpose() - stages_;
  return residual_.allFinite();
}

bool GaussIntegrator::fixed_point(double t, const Eigen::VectorXd& x, double h,
                                  const Eigen::VectorXd& tolerance) {
  double last = -1;
  for (int k = 0; k < kMostIterations; ++k) {
    if (!residual(t, x, h)) return false;
    const double change = weighted(residual_, tolerance);
    stages_ += residual_;
    // A change of ratio q leaves an error of q/(1 - q) times the change.
    const double q = last > 0 ? change / last : 0.5;
    if (change == 0 || (q < 1 && change * q / (1 - q) <= kSolved)) return true;
    if (k > 1 && q > 0.5) return false;
    last = change;
  }
  return false;
}

numbers::Matrix GaussIntegrator::jacobian(double t, const Eigen::VectorXd& x,
                                          const Eigen::VectorXd& tolerance) {
  numbers::Matrix J =
      numbers::Matrix::Constant(x.size(), x.size(), std::numeric_limits<double>::quiet_NaN());
  const double root_of_unit = std::sqrt(std::numeric_limits<double>::epsilon());
  try {
    Eigen::VectorXd base(x.size());
    rate_(t, x, base);
    Eigen::VectorXd moved = x;
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      const double delta = root_of_unit * std::abs(x(j)) + tolerance(j);
      moved(j) = x(j) + delta;
      rate_(t, moved, value_);
      J.col(j) = (value_ - base) / (moved(j) - x(j));
      moved(j) = x(j);
    }
  } catch (const std::runtime_error&) {
    return J;
  }
  return J;
}

bool GaussIntegrator::newton(double t, const Eigen::VectorXd& x, double h,
                             const Eigen::VectorXd& tolerance) {
  const Eigen::Index n = x.size();
  const numbers::Matrix J = jacobian(t, x, tolerance);
  if (!J.allFinite()) return false;
  numbers::Matrix M = numbers::Matrix::Identity(stages * n, stages * n);
  for (Eigen::Index i = 0; i < stages; ++i)
    for (Eigen::Index j = 0; j < stages; ++j)
      M.block(i * n, j * n, n, n) -= h * tableau_.A(i, j) * J;
  const Eigen::PartialPivLU<numbers::Matrix> lu(M);
  double last = -1;
  for (int k = 0; k < kMostIterations; ++k) {
    if (!residual(t, x, h)) return false;
    const Eigen::VectorXd change = lu.solve(residual_.reshaped());
    if (!change.allFinite()) return false;
    const numbers::Matrix by_stage = change.reshaped(n, stages);
    const double size = weighted(by_stage, tolerance);
    stages_ += by_stage;
    const double q = last > 0 ? size / last : 0.5;
    if (size == 0 || (q < 1 && size * q / (1 - q) <= kSolved && k > 0)) return true;
    if (k > 2 && q >= 1) return false;
    last = size;
  }
  return false;
}

}  // namespace gainsmith::ode
