#include "claims/parting.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "claims/tolerances.h"

namespace gainsmith::claims {

Parting::Parting(const Eigen::VectorXd& start, double relative, double absolute)
    : low_(start),
      high_(start),
      since_(Eigen::VectorXd::Constant(start.size(), kNever)),
      terms_(Eigen::VectorXd::Zero(start.size())),
      from_(static_cast<std::size_t>(start.size())),
      relative_(relative),
      absolute_(absolute) {
  std::iota(from_.begin(), from_.end(), 0);
}

void Parting::relate(const hybrid::Slot& difference, const hybrid::Slot& from) {
  for (Eigen::Index e = 0; e < difference.shape.size(); ++e)
    from_[static_cast<std::size_t>(difference.offset + e)] = from.offset + e;
}

void Parting::compute(const Eigen::VectorXd& terms) {
  for (Eigen::Index e = 0; e < terms.size(); ++e)
    if (terms(e) > 0) terms_(e) = terms(e);
}

/// Parted: |own - other| > kParted (range so far) and > kPartedAccuracy (relative size + absolute).
void Parting::see(double t, const Eigen::VectorXd& own, const Eigen::VectorXd& other) {
  low_ = low_.cwiseMin(own);
  high_ = high_.cwiseMax(own);
  for (Eigen::Index e = 0; e < low_.size(); ++e) {
    const double difference = std::abs(own(e) - other(e));
    const auto size_of = [&](Eigen::Index one) {
      return std::fmax(std::abs(low_(one)), std::abs(high_(one)));
    };
    const double size =
        std::max({terms_(e), size_of(e), size_of(from_[static_cast<std::size_t>(e)])});
    if (difference > kParted * (high_(e) - low_(e)) &&
        difference > kPartedAccuracy * (relative_ * size + absolute_))
      since_(e) = std::fmin(since_(e), t);
  }
}

}  // namespace gainsmith::claims
