#include "simulate/step_values.h"

#include "ode/chebyshev.h"

namespace gainsmith::simulate {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd StepValues::at(double t) const {
  VectorXd values = *start_;
  if (t == step_->from) return values;
  ode::chebyshev::at(step_->coefficients, ode::chebyshev::inner(t, step_->from, step_->to),
                     values.data());
  field_->fill(t, values);
  return values;
}

numbers::Box StepValues::box() const {
  numbers::Box box = ode::chebyshev::ranges(step_->coefficients);
  for (Index k = 0; k < start_->size(); ++k) {
    const double first = (*start_)(k);
    if (static_cast<std::size_t>(k) == box.size()) box.push_back({first, first});
    box[static_cast<std::size_t>(k)].widen(first);
  }
  return box;
}

SomeValues::SomeValues(const StepValues& inside, const std::vector<Index>& elements)
    : inside_(inside), values_(*inside.start_) {
  const numbers::Matrix& all = inside.step_->coefficients;
  for (const Index element : elements)
    if (element < all.rows()) elements_.push_back(element);
  coefficients_ = all(elements_, Eigen::all);
  found_.resize(coefficients_.rows());
}

const VectorXd& SomeValues::at(double t) {
  if (t == inside_.from()) return values_ = *inside_.start_;
  ode::chebyshev::at(coefficients_, ode::chebyshev::inner(t, inside_.from(), inside_.to()),
                     found_.data());
  for (std::size_t k = 0; k < elements_.size(); ++k)
    values_(elements_[k]) = found_(static_cast<Index>(k));
  inside_.field_->fill(t, values_);
  return values_;
}

}  // namespace gainsmith::simulate
