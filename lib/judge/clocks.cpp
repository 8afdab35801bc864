#include "judge/clocks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gainsmith::judge {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

}  // namespace

EventClock::EventClock(const Texts& texts, std::size_t event, std::vector<double> jumps,
                       const Eigen::VectorXd& start, Faults& faults)
    : all_(texts),
      texts_(texts.events[event]),
      kind_(texts.dynamics.events[event].kind),
      name_(texts.dynamics.events[event].name),
      conditional_(texts.dynamics.events[event].only_if.has_value()),
      left_of_(texts.find(model::Dynamics::VariableKind::left, event)),
      jumps_(std::move(jumps)),
      faults_(faults) {
  if (is_given()) {
    // Times before the start are no occurrences.
    while (occurrences_ < texts_.times.size() && texts_.times[occurrences_] < 0) ++occurrences_;
  } else if (has_one_length() && texts_.first_low == texts_.first_high) {
    base_ = texts_.first_low;
  } else if (left_of_) {
    const double first = left(start);
    const double rounding = time_rounding(texts_.first_high, texts_.first_high);
    if (!(texts_.first_low - rounding <= first && first <= texts_.first_high + rounding))
      faults_.add(0, 0, "the first length of the clock is not in its range: " + name_, first,
                  texts_.first_high);
    if (has_one_length()) base_ = first;
    next_ = first;
    return;
  }
  reset(0);
}

double EventClock::left(const Eigen::VectorXd& x) const { return all_.part(x, *left_of_)(0); }

void EventClock::reset(double t) {
  if (is_given()) {
    next_ = occurrences_ < texts_.times.size() ? texts_.times[occurrences_] : never;
  } else if (base_) {
    next_ = *base_ + static_cast<double>(occurrences_) * texts_.low;
  } else if (left_of_) {
    unseen_ = true;
    next_ = never;
  } else {
    next_ = done_ < jumps_.size() ? std::max(t, jumps_[done_]) : never;
  }
}

void EventClock::check_length(std::size_t part, double t) {
  const bool first = done_ == 0;
  const double low = first ? texts_.first_low : texts_.low;
  const double high = first ? texts_.first_high : texts_.high;
  const double length = t - last_;
  const double rounding = 2 * time_rounding(t, high);
  // With an `if` any number of lengths may lie between two jumps.
  const double most = conditional_ ? never : high + rounding;
  if (length < low - rounding || length > most)
    faults_.add(part, t, "the length of the clock is not in its range: " + name_, length,
                length < low ? low : high);
}

void EventClock::jumped(std::size_t part, double t, const Eigen::VectorXd& after) {
  if (!is_given() && !base_) check_length(part, t);
  if (!is_given() && !base_ && has_one_length()) {
    base_ = t;
    occurrences_ = 0;
  }
  ++done_;
  ++occurrences_;
  last_ = t;
  reset(t);
  if (left_of_ && unseen_) {
    unseen_ = false;
    next_ = t + left(after);
    const double rounding = time_rounding(next_, texts_.high);
    if (!(texts_.low - rounding <= left(after) && left(after) <= texts_.high + rounding))
      faults_.add(part, t, "the length of the clock is not in its range: " + name_, left(after),
                  left(after) < texts_.low ? texts_.low : texts_.high);
  }
}

void EventClock::spent(double t) {
  ++occurrences_;
  reset(t);
}

void EventClock::flow(std::size_t part, double t, const Eigen::VectorXd& x) {
  if (unseen_ && left_of_) {
    unseen_ = false;
    next_ = t + left(x);
  }
  check_left(part, t, x);
}

/// |t + left - next| is rounding of times.
void EventClock::check_left(std::size_t part, double t, const Eigen::VectorXd& x) {
  if (!left_of_ || unseen_ || !std::isfinite(next_)) return;
  faults_.check(part, t, "what is left of the clock is wrong: " + name_,
                std::abs(t + left(x) - next_), 2 * time_rounding(t, next_));
}

void EventClock::end(std::size_t part, double t) {
  if (is_given() || base_ || conditional_) return;
  const double high = done_ == 0 ? texts_.first_high : texts_.high;
  faults_.check(part, t, "the length of the clock is not in its range: " + name_, t - last_,
                high + 2 * time_rounding(t, high));
}

}  // namespace gainsmith::judge
