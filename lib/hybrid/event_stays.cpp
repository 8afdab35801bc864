#include "hybrid/event_stays.h"

#include <fmt/format.h>

#include "hybrid/event_jump.h"

namespace gainsmith::hybrid {

using Eigen::VectorXd;

namespace {

[[noreturn]] void leave(EventWatch::Stay& stay, const VectorXd& values) {
  throw RunEnd(Ending::left, fmt::format("{} ('{}' is false, {})", stay.say, stay.where.text(),
                                         stay.where.differences(values)));
}

}  // namespace

void EventStays::begin(const VectorXd& values) {
  for (std::size_t s = 0; s < inside_.size(); ++s) inside_[s] = watch_->stays[s].where(values);
}

void EventStays::require_inside(const StepValues& inside, double soon) {
  for (std::size_t s = 0; s < inside_.size(); ++s)
    if (!inside_[s] && !watch_->stays[s].where(inside.at(soon)))
      leave(watch_->stays[s], inside.at(inside.from()));
}

bool EventStays::leaves(const VectorXd& values) {
  for (std::size_t s = 0; s < inside_.size(); ++s) {
    const bool now = watch_->stays[s].where(values);
    if (inside_[s] && !now) return true;
    inside_[s] = now;
  }
  return false;
}

void EventStays::leave_first(const VectorXd& values) {
  for (EventWatch::Stay& stay : watch_->stays)
    if (!stay.where(values)) leave(stay, values);
}

}  // namespace gainsmith::hybrid
