#include "hybrid/step_values.h"

#include "hybrid/borders.h"
#include "hybrid/chebyshev.h"

namespace gainsmith::hybrid {

using Eigen::VectorXd;

VectorXd StepValues::at(double t) const {
  VectorXd values = *start_;
  if (t == step_->from) return values;
  chebyshev::at(step_->coefficients, chebyshev::inner(t, step_->from, step_->to), values.data());
  movement_->fill(t, values);
  return values;
}

const std::vector<double>& StepPoints::times() {
  if (times_.empty()) times_ = first_points(inside_->from(), inside_->to());
  return times_;
}

const std::vector<VectorXd>& StepPoints::values() {
  if (values_.empty())
    for (const double t : times()) values_.push_back(inside_->at(t));
  return values_;
}

}  // namespace gainsmith::hybrid
