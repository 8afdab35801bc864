#include "simulate/crossings_on_step.h"

#include <algorithm>
#include <cmath>

#include "ode/chebyshev.h"
#include "simulate/tolerances.h"

namespace gainsmith::simulate {

using Eigen::Index;
using Eigen::RowVectorXd;
using Eigen::VectorXd;
using numbers::Matrix;

namespace {

/// Of the interpolant of an event function.
constexpr int turn_degree = 16;
/// They lead from the length of a step to its rounding.
constexpr int most_halvings = 60;
/// Of the step: the earliest turning point that rounding leaves.
constexpr double earliest = 1 / hybrid::kPlain;

}  // namespace

CrossingsOnStep::CrossingsOnStep(hybrid::EventFunction& function, StepPoints& points)
    : function_(function), points_(points), values_(function.size(), 0) {
  const std::vector<VectorXd>& all = points.values();
  values_.resize(function.size(), static_cast<Index>(all.size()));
  for (std::size_t k = 0; k < all.size(); ++k)
    values_.col(static_cast<Index>(k)) = function(all[k]).reshaped();
  noise_ = function.terms(all.front()).reshaped();
  for (const VectorXd* point : {&all[all.size() / 2], &all.back()})
    noise_ = noise_.cwiseMax(function.terms(*point).reshaped());
  noise_ *= hybrid::kTermRounding;
  const StepValues& inside = points.inside();
  breaks_ = function.breaks()
                .on([&](double t) { return inside.at(t); }, inside.from(), inside.to())
                .value_or(std::vector<ode::Break>());
}

ode::Found CrossingsOnStep::roots(Index element, bool strict, double near) {
  const StepValues& inside = points_.inside();
  const ode::RootFunction root_function{[&](double t) { return value(element, t); }, strict,
                                        noise_(element),
                                        near * noise_(element) / hybrid::kTermRounding};
  return ode::find_roots(root_function, inside.from(), inside.to(), breaks_);
}

double CrossingsOnStep::value(Index element, double t) {
  const std::vector<double>& times = points_.times();
  const auto known = std::lower_bound(times.begin(), times.end(), t);
  if (known != times.end() && *known == t) return values_(element, known - times.begin());
  return function_(points_.inside().at(t))(element);
}

std::optional<double> CrossingsOnStep::hidden_turn(Index element) {
  const StepValues& inside = points_.inside();
  const double noise = noise_(element);
  if (!(std::abs(value(element, inside.from())) <= noise) || !breaks_.empty()) return std::nullopt;
  const VectorXd& points = ode::chebyshev::points(turn_degree);
  RowVectorXd values(points.size());
  for (Index k = 0; k < points.size(); ++k)
    values(k) = value(element, ode::chebyshev::outer(points(k), inside.from(), inside.to()));
  if (!(values.cwiseAbs().maxCoeff() > hybrid::kPlain * noise)) return std::nullopt;
  const Matrix c = ode::chebyshev::coefficients(values);
  const Matrix slope = ode::chebyshev::derivative(c);
  const double first = ode::chebyshev::first(slope, -1);
  if (std::abs(first) <= turn_degree * turn_degree * noise) return earliest;
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

std::optional<double> CrossingsOnStep::leaves_zero(Index element) {
  const StepValues& inside = points_.inside();
  const auto is_noise = [&](double t) { return function_.is_noise(inside.at(t), element); };
  double low = inside.from();
  if (!is_noise(low)) return std::nullopt;
  for (double high : points_.times()) {
    if (is_noise(high)) {
      low = high;
      continue;
    }
    for (int k = 0; k < most_halvings; ++k) {
      const double middle = low + (high - low) / 2;
      (is_noise(middle) ? low : high) = middle;
    }
    return high;
  }
  return std::nullopt;
}

}  // namespace gainsmith::simulate
