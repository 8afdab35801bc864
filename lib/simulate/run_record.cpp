#include "simulate/run_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/number.h"
#include "simulate/jump_maps.h"

namespace gainsmith::simulate {

RunRecord::RunRecord(const hybrid::System& system, double horizon, const RecordLimits& limits)
    : system_(&system), limits_(limits), jumps_(system.dynamics.events.size(), 0) {
  result_.horizon = horizon;
}

void RunRecord::flow_begins(std::int64_t j, const Eigen::VectorXd& variables) {
  if (!piece_.steps.empty()) return;
  piece_.j = j;
  piece_.start = variables;
}

void RunRecord::add(const hybrid::DenseStep& step, const Eigen::VectorXd& end) {
  keep(static_cast<std::size_t>(step.coefficients.size()));
  piece_.steps.push_back(step);
  end_ = end;
}

void RunRecord::flow_ends() {
  if (piece_.steps.empty()) return;
  piece_.end = end_;
  result_.parts.emplace_back(std::move(piece_));
  piece_ = {};
}

void RunRecord::add(hybrid::JumpPoint jump) {
  if (all_jumps_ >= limits_.jumps) is_full(fmt::format("{} jumps", limits_.jumps));
  keep(static_cast<std::size_t>(jump.before.size() + jump.after.size()));
  ++all_jumps_;
  ++jumps_[jump.event];
  result_.parts.emplace_back(std::move(jump));
}

void RunRecord::shorten_chain(std::int64_t count) {
  result_.parts.resize(result_.parts.size() - static_cast<std::size_t>(count) + kept_of_chain);
}

std::string RunRecord::last_events() const {
  std::vector<std::size_t> events;
  const std::size_t kept = std::min(hybrid::kInARow, result_.parts.size());
  for (std::size_t k = result_.parts.size() - kept; k < result_.parts.size(); ++k)
    if (const auto* jump = std::get_if<hybrid::JumpPoint>(&result_.parts[k]))
      if (std::find(events.begin(), events.end(), jump->event) == events.end())
        events.push_back(jump->event);
  std::string names;
  for (const std::size_t event : events)
    names += (names.empty() ? "" : ", ") + system_->dynamics.events[event].name;
  return names;
}

void RunRecord::keep(std::size_t numbers) {
  if (numbers_ + numbers > limits_.numbers)
    is_full(fmt::format("a record of {} numbers", limits_.numbers));
  numbers_ += numbers;
}

void RunRecord::is_full(const std::string& of) const {
  std::string events;
  for (std::size_t k = 0; k < jumps_.size(); ++k)
    if (jumps_[k] > 0)
      events += fmt::format("{}{} of {}", events.empty() ? "" : ", ", jumps_[k],
                            system_->dynamics.events[k].name);
  throw RunEnd(hybrid::Ending::full,
               fmt::format("{} are the most that a run may have{}{}; a shorter horizon ends before",
                           of, events.empty() ? "" : ", with jumps ", events));
}

void RunRecord::note(const std::string& text) {
  if (result_.notes.size() < hybrid::kInARow) result_.notes.push_back(text);
}

void RunRecord::ends(hybrid::Ending ending, const std::string& why, double t, std::int64_t j) {
  result_.ending = ending;
  result_.message = fmt::format("t = {}, j = {}: {}", brief(t, 17), j, why);
}

hybrid::Trajectory RunRecord::take(double end) {
  flow_ends();
  result_.end = end;
  return std::move(result_);
}

}  // namespace gainsmith::simulate
