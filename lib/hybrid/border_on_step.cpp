#include "hybrid/border_on_step.h"

#include <algorithm>

namespace gainsmith::hybrid {

using Eigen::Index;
using Eigen::VectorXd;

BorderOnStep::BorderOnStep(EventBorder& border, StepPoints& points)
    : border_(border), points_(points), values_(border.size(), 0) {
  const std::vector<VectorXd>& all = points.values();
  values_.resize(border.size(), static_cast<Index>(all.size()));
  for (std::size_t k = 0; k < all.size(); ++k)
    values_.col(static_cast<Index>(k)) = border(all[k]).reshaped();
  noise_ = border.terms(all.front()).reshaped();
  for (const VectorXd* point : {&all[all.size() / 2], &all.back()})
    noise_ = noise_.cwiseMax(border.terms(*point).reshaped());
  noise_ *= kTermRounding;
  const StepValues& inside = points.inside();
  breaks_ = border.breaks().on([&](double t) { return inside.at(t); }, inside.from(), inside.to());
}

Found BorderOnStep::roots(Index element, bool strict) {
  const StepValues& inside = points_.inside();
  const Border border{[&](double t) { return value(element, t); }, strict, noise_(element)};
  return find_roots(border, inside.from(), inside.to(), breaks_);
}

double BorderOnStep::value(Index element, double t) {
  const std::vector<double>& times = points_.times();
  const auto known = std::lower_bound(times.begin(), times.end(), t);
  if (known != times.end() && *known == t) return values_(element, known - times.begin());
  return border_(points_.inside().at(t))(element);
}

}  // namespace gainsmith::hybrid
