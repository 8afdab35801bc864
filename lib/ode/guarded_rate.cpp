#include "ode/guarded_rate.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "ode/tolerances.h"

namespace gainsmith::ode {

GuardedRate::GuardedRate(Eigen::Index size, Integrator::Rate rate)
    : rate_(std::move(rate)), slope_(Eigen::VectorXd::Zero(size)) {}

void GuardedRate::begin(double t, const Eigen::VectorXd& x, double last) {
  last_ = last;
  size_ = x.lpNorm<Eigen::Infinity>();
  Eigen::VectorXd slope(x.size());
  if (at(t, x, slope.data())) size_ = std::max(size_, (last - t) * slope.lpNorm<Eigen::Infinity>());
}

bool GuardedRate::at(double t, const Eigen::VectorXd& x, double* slope) {
  try {
    rate_(std::min(t, last_), x, slope_);
  } catch (const std::exception& error) {
    trouble_ = error.what();
    return false;
  }
  if (!slope_.allFinite()) {
    trouble_ = "the flow is not finite";
    return false;
  }
  std::copy_n(slope_.data(), slope_.size(), slope);
  return true;
}

bool GuardedRate::has_escaped(double t, const Eigen::VectorXd& x,
                              const Eigen::VectorXd& slope) const {
  const double now = x.lpNorm<Eigen::Infinity>();
  return size_ > 0 && now > kEscape * size_ &&
         (last_ - t) * slope.lpNorm<Eigen::Infinity>() > kEscape * now;
}

}  // namespace gainsmith::ode
