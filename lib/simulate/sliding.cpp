#include "simulate/sliding.h"

#include <fmt/format.h>

#include "base/error.h"
#include "simulate/jump_maps.h"

namespace gainsmith::simulate {

namespace {

/// |D|, element by element.
Eigen::VectorXd sizes(hybrid::EventFunction& function, const Eigen::VectorXd& values) {
  return function(values).reshaped().cwiseAbs();
}

}  // namespace

SlidingDetector::SlidingDetector(const hybrid::System& system, EventWatch& watch,
                                 const Accuracy& accuracy, double horizon)
    : system_(&system), watch_(&watch), accuracy_(accuracy), horizon_(horizon) {}

void SlidingDetector::moved(const Eigen::VectorXd& values) {
  if (row_ > 0) swing_ = swing_.cwiseMax(sizes(watch_->switches[branch_], values));
}

void SlidingDetector::switched(std::size_t branch, double t, const Eigen::VectorXd& values) {
  times_.push_back(t);
  if (times_.size() > hybrid::kAtOnce) times_.erase(times_.begin());
  if (times_.size() == hybrid::kAtOnce && t - times_.front() <= hybrid::kHardly * horizon_)
    end(branch);
  row_ = row_ > 0 && branch == branch_ && is_noise(values) ? row_ + 1 : 1;
  if (row_ > hybrid::kInARow) end(branch);
  branch_ = branch;
  swing_ = Eigen::VectorXd::Zero(watch_->switches[branch].size());
}

/// Whether the element that switches has stayed in the error of the integration since it did last.
bool SlidingDetector::is_noise(const Eigen::VectorXd& values) {
  if (system_->affine) return false;  // exact
  hybrid::EventFunction& function = watch_->switches[branch_];
  Eigen::Index element = 0;
  sizes(function, values).minCoeff(&element);
  const double terms = function.terms(values).reshaped()(element);
  return swing_(element) <= accuracy_.absolute + accuracy_.relative * terms;
}

void SlidingDetector::end(std::size_t branch) const {
  const hybrid::Switch& one = system_->switches[branch];
  throw RunEnd(
      hybrid::Ending::sliding,
      fmt::format(
          "sliding on the switching surface of the {} at {}: both branches lead back to it; a sign "
          "with a width, clip(s/w, -1, 1), or a mode with two thresholds can be followed",
          one.kind == hybrid::Switch::Kind::sign ? "sign" : "where", to_string(one.place)));
}

}  // namespace gainsmith::simulate
