#include "simulate/crossings_on_step.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "ode/chebyshev.h"
#include "ode/tolerances.h"
#include "simulate/tolerances.h"

namespace gainsmith::simulate {

using Eigen::Index;
using Eigen::RowVectorXd;
using Eigen::VectorXd;
using numbers::Matrix;

namespace {

/// Of the interpolant of an event function.
constexpr int turn_degree = 16;
/// Of the slope of an interpolant at an end, in units of what its values may be off.
constexpr int slope_noise = turn_degree * turn_degree;
/// They lead from the length of a step to its rounding.
constexpr int most_halvings = 60;
/// Of the step: the earliest turning point that rounding leaves.
constexpr double earliest = 1 / hybrid::kPlain;

/// Where seems_apart compares.
constexpr std::array<double, 2> check_points = {-0.617, 0.443};

}  // namespace

/// With c_k the series of degree 4, |c_0| > sum_(k >= 1) |c_k| + kFar error + noise excludes a
/// root, since |T_k| <= 1. The error is seen at two more points and in the last two coefficients.
bool seems_apart(hybrid::EventFunction& function, const StepValues& inside, double near) {
  constexpr int few = 4;
  if (!function.breaks().none()) return false;
  SomeValues used(inside, function.elements());
  const auto at = [&](double x) -> const VectorXd& {
    return used.at(ode::chebyshev::outer(x, inside.from(), inside.to()));
  };
  const VectorXd& points = ode::chebyshev::points(few);
  Matrix values(function.size(), points.size());
  Matrix checks(function.size(), static_cast<Index>(check_points.size()));
  for (Index k = 0; k < checks.cols(); ++k)
    checks.col(k) = function(at(check_points[static_cast<std::size_t>(k)])).reshaped();
  for (Index k = 0; k < points.size(); ++k) values.col(k) = function(at(points(k))).reshaped();
  const VectorXd terms = function.terms(at(1)).reshaped();
  const Matrix series = ode::chebyshev::coefficients(values);
  VectorXd error = series.rightCols(2).cwiseAbs().rowwise().sum();
  for (Index k = 0; k < checks.cols(); ++k)
    error = error.cwiseMax(
        (checks.col(k) - ode::chebyshev::at(series, check_points[static_cast<std::size_t>(k)]))
            .cwiseAbs());
  for (Index e = 0; e < function.size(); ++e) {
    const double swing = series.row(e).tail(few).cwiseAbs().sum();
    const double noise = std::max(2 * (near + hybrid::kTermRounding) * terms(e),
                                  ode::kTurnsNear * std::abs(series(e, 0)));
    if (!(std::abs(series(e, 0)) > swing + ode::kFar * error(e) + noise)) return false;
  }
  return true;
}

CrossingsOnStep::CrossingsOnStep(hybrid::EventFunction& function, const StepValues& inside,
                                 const std::vector<double>& times)
    : function_(function),
      inside_(inside),
      times_(times),
      used_(inside, function.elements()),
      values_(function.size(), static_cast<Index>(times.size())),
      is_known_(times.size(), false) {
  // kTermRounding times the largest terms at the start, the middle and the end.
  noise_ = function.terms(used_.at(times.front())).reshaped();
  for (const double t : {times[times.size() / 2], times.back()})
    noise_ = noise_.cwiseMax(function.terms(used_.at(t)).reshaped());
  noise_ *= hybrid::kTermRounding;
  breaks_ = function.breaks()
                .on([this](double t) -> const VectorXd& { return used_.at(t); }, inside_.from(),
                    inside_.to(), function.breaks().none() ? numbers::Box() : inside_.box())
                .value_or(std::vector<ode::Break>());
}

ode::Found CrossingsOnStep::roots(Index element, bool strict, double near) {
  const ode::RootFunction root_function{[&](double t) { return value(element, t); }, strict,
                                        noise_(element),
                                        near * noise_(element) / hybrid::kTermRounding};
  return ode::find_roots(root_function, inside_.from(), inside_.to(), breaks_);
}

double CrossingsOnStep::value(Index element, double t) {
  const auto known = std::lower_bound(times_.begin(), times_.end(), t);
  if (known == times_.end() || *known != t) return function_(used_.at(t))(element);
  const auto k = known - times_.begin();
  if (!is_known_[static_cast<std::size_t>(k)]) {
    values_.col(k) = function_(used_.at(t)).reshaped();
    is_known_[static_cast<std::size_t>(k)] = true;
  }
  return values_(element, k);
}

RowVectorXd CrossingsOnStep::on_points(Index element) {
  const VectorXd& points = ode::chebyshev::points(turn_degree);
  RowVectorXd values(points.size());
  for (Index k = 0; k < points.size(); ++k)
    values(k) = value(element, ode::chebyshev::outer(points(k), inside_.from(), inside_.to()));
  return values;
}

/// The root of g' in the first kEarly of the step, by bisection of the derivative of an
/// interpolant.
std::optional<double> CrossingsOnStep::hidden_turn(Index element) {
  const double noise = noise_(element);
  if (!(std::abs(value(element, inside_.from())) <= noise) || !breaks_.empty()) return std::nullopt;
  const RowVectorXd values = on_points(element);
  if (!(values.cwiseAbs().maxCoeff() > hybrid::kPlain * noise)) return std::nullopt;
  const Matrix c = ode::chebyshev::trimmed(ode::chebyshev::coefficients(values), noise);
  const Matrix slope = ode::chebyshev::derivative(c);
  const double first = ode::chebyshev::first(slope, -1);
  if (std::abs(first) <= slope_noise * noise) return earliest;
  double low = -1;
  double high = -1 + 2 * kEarly;
  if ((ode::chebyshev::first(slope, high) > 0) == (first > 0)) return std::nullopt;
  for (int k = 0; k < most_halvings; ++k) {
    const double x = low + (high - low) / 2;
    ((ode::chebyshev::first(slope, x) > 0) == (first > 0) ? low : high) = x;
  }
  if (std::abs(ode::chebyshev::first(c, high) - values(0)) > hybrid::kPlain * noise)
    return std::nullopt;
  return std::max((1 + high) / 2, earliest);
}

/// g'(from), as long as |g'| (t - from) is below kPlain times the rounding.
double CrossingsOnStep::hidden_slope(Index element, double t) {
  const double from = inside_.from();
  const double x = 1 + ode::chebyshev::inner(t, from, inside_.to());
  if (x > kEarly || value(element, from) != 0 || !breaks_.empty()) return 0;
  const double noise = hybrid::kPlain * noise_(element);
  const Matrix slope = ode::chebyshev::derivative(ode::chebyshev::coefficients(on_points(element)));
  const double first = ode::chebyshev::first(slope, -1);
  return std::abs(first) > noise && std::abs(first) * x <= noise ? first : 0;
}

/// Bisection between the last sample within twice the noise and the first beyond it.
std::optional<double> CrossingsOnStep::leaves_zero(Index element, double rounding) {
  double low = inside_.from();
  if (!(std::abs(value(element, low)) <= std::max(noise_(element), rounding))) return std::nullopt;
  // Clearly beyond it, so that who evaluates again does not find it within.
  const auto is_noise = [&](double t) {
    return std::abs(value(element, t)) <= 2 * noise_(element);
  };
  for (double high : times_) {
    if (is_noise(high)) {
      low = high;
      continue;
    }
    for (int k = 0; k < most_halvings; ++k) {
      const double middle = low + (high - low) / 2;
      (is_noise(middle) ? low : high) = middle;
    }
    // Before that everything else may be noise that was 0 at the start.
    return std::max(high, inside_.from() + ode::kFinest * (inside_.to() - inside_.from()));
  }
  return std::nullopt;
}

}  // namespace gainsmith::simulate
