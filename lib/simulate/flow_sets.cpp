#include "simulate/flow_sets.h"

#include <fmt/format.h>

namespace gainsmith::simulate {

using Eigen::VectorXd;

namespace {

[[noreturn]] void leave(EventWatch::FlowSet& flow_set, const VectorXd& values) {
  throw RunEnd(hybrid::Ending::left,
               fmt::format("{} ('{}' is false, {})", flow_set.say, flow_set.where.text(),
                           flow_set.where.differences(values)));
}

}  // namespace

void FlowSets::begin(const VectorXd& values) {
  for (std::size_t s = 0; s < inside_.size(); ++s) inside_[s] = watch_->flow_sets[s].where(values);
}

void FlowSets::require_inside(const StepValues& inside, double soon) {
  for (std::size_t s = 0; s < inside_.size(); ++s)
    if (!inside_[s] && !watch_->flow_sets[s].where(inside.at(soon)))
      leave(watch_->flow_sets[s], inside.at(inside.from()));
}

bool FlowSets::leaves(const VectorXd& values) {
  for (std::size_t s = 0; s < inside_.size(); ++s) {
    const bool now = watch_->flow_sets[s].where(values);
    if (inside_[s] && !now) return true;
    inside_[s] = now;
  }
  return false;
}

void FlowSets::leave_first(const VectorXd& values) {
  for (EventWatch::FlowSet& flow_set : watch_->flow_sets)
    if (!flow_set.where(values)) leave(flow_set, values);
}

}  // namespace gainsmith::simulate
