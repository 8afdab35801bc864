#include "simulate/step_values.h"

#include "ode/chebyshev.h"
#include "ode/roots.h"

namespace gainsmith::simulate {

using Eigen::VectorXd;

VectorXd StepValues::at(double t) const {
  VectorXd values = *start_;
  if (t == step_->from) return values;
  ode::chebyshev::at(step_->coefficients, ode::chebyshev::inner(t, step_->from, step_->to),
                     values.data());
  field_->fill(t, values);
  return values;
}

const std::vector<double>& StepPoints::times() {
  if (times_.empty()) times_ = ode::first_points(inside_->from(), inside_->to());
  return times_;
}

const std::vector<VectorXd>& StepPoints::values() {
  if (values_.empty())
    for (const double t : times()) values_.push_back(inside_->at(t));
  return values_;
}

}  // namespace gainsmith::simulate
