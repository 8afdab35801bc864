#include "claims/parting.h"

#include <cmath>

#include "claims/tolerances.h"

namespace gainsmith::claims {

Parting::Parting(const Eigen::VectorXd& start, double relative, double absolute)
    : low_(start),
      high_(start),
      since_(Eigen::VectorXd::Constant(start.size(), kNever)),
      terms_(Eigen::VectorXd::Zero(start.size())),
      relative_(relative),
      absolute_(absolute) {}

void Parting::compute(const Eigen::VectorXd& terms) {
  for (Eigen::Index e = 0; e < terms.size(); ++e)
    if (terms(e) > 0) terms_(e) = terms(e);
}

void Parting::see(double t, const Eigen::VectorXd& own, const Eigen::VectorXd& other) {
  low_ = low_.cwiseMin(own);
  high_ = high_.cwiseMax(own);
  for (Eigen::Index e = 0; e < low_.size(); ++e) {
    const double difference = std::abs(own(e) - other(e));
    const double size = std::fmax(terms_(e), std::fmax(std::abs(low_(e)), std::abs(high_(e))));
    if (difference > kParted * (high_(e) - low_(e)) &&
        difference > kPartedAccuracy * (relative_ * size + absolute_))
      since_(e) = std::fmin(since_(e), t);
  }
}

}  // namespace gainsmith::claims
