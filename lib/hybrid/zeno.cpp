#include "hybrid/zeno.h"

#include <algorithm>
#include <cmath>

#include "hybrid/tolerances.h"

namespace gainsmith::hybrid {

ZenoDetector::ZenoDetector(const System& system, double horizon)
    : system_(&system), horizon_(horizon) {
  using Kind = model::Dynamics::VariableKind;
  for (std::size_t k = 0; k < system.dynamics.variables.size(); ++k) {
    const model::Dynamics::Variable& variable = system.dynamics.variables[k];
    if (variable.kind != Kind::state && variable.kind != Kind::mode) continue;
    for (Eigen::Index e = 0; e < variable.shape.size(); ++e)
      rows_.push_back(system.layout.slots[k].offset + e);
  }
}

void ZenoDetector::push(double t, double length, std::size_t event, const Eigen::VectorXd& values,
                        const Eigen::VectorXd& largest) {
  t_ = t;
  if (sizes_.size() == 0) sizes_.setZero(static_cast<Eigen::Index>(rows_.size()));
  sizes_ = sizes_.cwiseMax(largest(rows_));
  longest_ = std::max(longest_, length);
  const bool has_clock = system_->has_clock(event);
  short_flows_ = length < kHardly * horizon_ && !has_clock ? short_flows_ + 1 : 0;
  Flow& last = flows_[next_];
  next_ = (next_ + 1) % kKept;
  count_ = std::min(count_ + 1, kKept);
  last.length = length;
  last.event = event;
  last.state = values(rows_);
}

void ZenoDetector::start_over() {
  t_ = longest_ = 0;
  short_flows_ = count_ = next_ = 0;
  sizes_.setZero();
}

bool ZenoDetector::settles(std::size_t period) const {
  const Eigen::VectorXd change = before(0).state - before(period).state;
  return (change.array().abs() <= kSteady * sizes_.array()).all();
}

double ZenoDetector::last(std::size_t period) const {
  double sum = 0;
  for (std::size_t k = period; k-- > 0;) sum += before(k).length;
  return sum;
}

std::optional<double> ZenoDetector::accumulation() const {
  for (std::size_t period = 1; period <= kLongestPeriod; ++period) {
    if (count_ <= period || !is_near(last(period), before(0).length, before(period).length, t_))
      continue;
    for (std::size_t ratios = kRatios; ratios >= kFewestRatios; --ratios)
      if (const auto left = steady_rest(period, ratios);
          left && (*left <= kNothingLeft * t_ || (*left <= kLeftOver * t_ && settles(period))))
        return t_ + *left;
  }
  return std::nullopt;
}

/// What is left where the last so many ratios agree: twelve, or as many as leave nothing
/// of a length.
std::optional<double> ZenoDetector::steady_rest(std::size_t period, std::size_t ratios) const {
  if (count_ < ratios + period) return std::nullopt;
  double smallest = 2;
  double largest = 0;
  double rounded = 2;  // the smallest, as rounding may have made it smaller
  for (std::size_t k = ratios; k-- > 0;) {
    const double ratio = before(k).length / before(k + period).length;
    smallest = std::min(smallest, ratio);
    largest = std::max(largest, ratio);
    rounded = std::min(rounded, ratio + kOneInstant * t_ / before(k + period).length);
  }
  // Small ones agree in their size as well.
  if (!(largest < 1) || largest - smallest > kSteady * (1 - largest) || largest > 2 * rounded)
    return std::nullopt;
  // The last ratio errs by rounding most: the mean over all of them.
  const std::size_t periods = ratios / period;
  const double all = before(0).length / before(periods * period).length;
  if (ratios < kRatios && all > kLeftOver) return std::nullopt;
  const double r = std::pow(all, 1 / static_cast<double>(periods));
  return last(period) * r / (1 - r);
}

std::vector<std::size_t> ZenoDetector::events() const {
  std::vector<std::size_t> result;
  for (std::size_t k = count_; k-- > 0;)
    if (std::find(result.begin(), result.end(), before(k).event) == result.end())
      result.push_back(before(k).event);
  return result;
}

}  // namespace gainsmith::hybrid
