#include "hybrid/zeno.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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
  sizes_ = sizes_.size() == 0 ? largest(rows_).eval() : sizes_.cwiseMax(largest(rows_)).eval();
  longest_ = std::max(longest_, length);
  const bool has_clock = system_->has_clock(event);
  short_flows_ = length < kHardly * horizon_ && !has_clock ? short_flows_ + 1 : 0;
  lengths_.push_back(length);
  events_.push_back(event);
  states_.emplace_back(values(rows_));
  if (lengths_.size() <= kRatios + longest_period) return;
  states_.erase(states_.begin());
  lengths_.erase(lengths_.begin());
  events_.erase(events_.begin());
}

bool ZenoDetector::settles(std::size_t period) const {
  const Eigen::VectorXd change = states_.back() - states_[states_.size() - 1 - period];
  return (change.array().abs() <= kSteady * sizes_.array()).all();
}

double ZenoDetector::last(std::size_t period) const {
  return std::accumulate(lengths_.end() - static_cast<std::ptrdiff_t>(period), lengths_.end(), 0.0);
}

/// Whether little may be left: a steady factor is no smaller than the last ratio by more than
/// kSteady.
bool ZenoDetector::is_near(std::size_t period) const {
  if (lengths_.size() <= period) return false;
  const double r = lengths_.back() / lengths_[lengths_.size() - 1 - period] - kSteady;
  return r < 1 && last(period) * r <= kLeftOver * t_ * (1 - r);
}

std::optional<double> ZenoDetector::accumulation() const {
  for (std::size_t period = 1; period <= longest_period; ++period) {
    if (!is_near(period)) continue;
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
  if (lengths_.size() < ratios + period) return std::nullopt;
  double smallest = 2;
  double largest = 0;
  for (std::size_t k = lengths_.size() - ratios; k < lengths_.size(); ++k) {
    const double ratio = lengths_[k] / lengths_[k - period];
    smallest = std::min(smallest, ratio);
    largest = std::max(largest, ratio);
  }
  if (!(largest < 1) || largest - smallest > kSteady * (1 - largest)) return std::nullopt;
  // The last ratio errs by rounding most: the mean over all of them.
  const std::size_t periods = ratios / period;
  const double all = lengths_.back() / lengths_[lengths_.size() - 1 - periods * period];
  if (ratios < kRatios && all > kLeftOver) return std::nullopt;
  const double r = std::pow(all, 1 / static_cast<double>(periods));
  return last(period) * r / (1 - r);
}

std::vector<std::size_t> ZenoDetector::events() const {
  std::vector<std::size_t> result;
  for (const std::size_t event : events_)
    if (std::find(result.begin(), result.end(), event) == result.end()) result.push_back(event);
  return result;
}

}  // namespace gainsmith::hybrid
