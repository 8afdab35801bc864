#include "simulate/zeno.h"

#include <algorithm>
#include <cmath>

namespace gainsmith::simulate {

namespace {

constexpr std::size_t kLongestPeriod = 3;
constexpr std::size_t kRatios = 12;
constexpr std::size_t kFewestRatios = 4;
constexpr double kManyPowers = 1e-6;  ///< of a length, that fewer ratios have to make
constexpr std::size_t kKept = 101;
constexpr double kSteadyFactor = 3e-3;      ///< of 1 - r
constexpr double kSlowSteadyFactor = 0.02;  ///< of 1 - r^50
constexpr double kLeftOver = 1e-7;          ///< of the time
constexpr double kNothingLeft = 1e-8;
constexpr double kSlowLeftOver = 1e-5;
constexpr double kStillMoving = 1e-4;
constexpr double kShortFlow = 1e-6;  ///< of the horizon
constexpr double kShortestFlow = 1e-10;

}  // namespace

void ZenoDetector::push(double t, double length, std::size_t event, bool has_clock,
                        const Eigen::VectorXd& states, const Eigen::VectorXd& largest) {
  t_ = t;
  sizes_ = sizes_.size() == 0 ? largest : sizes_.cwiseMax(largest).eval();
  longest_ = std::max(longest_, length);
  const auto in_a_row = [&](double part, int before) {
    return length < part * horizon_ && !has_clock ? before + 1 : 0;
  };
  short_flows_ = in_a_row(kShortFlow, short_flows_);
  shortest_flows_ = in_a_row(kShortestFlow, shortest_flows_);
  lengths_.push_back(length);
  events_.push_back(event);
  states_.push_back(states);
  if (lengths_.size() <= kKept) return;
  states_.erase(states_.begin());
  lengths_.erase(lengths_.begin());
  events_.erase(events_.begin());
}

bool ZenoDetector::settles(std::size_t period) const {
  const Eigen::VectorXd change = states_.back() - states_[states_.size() - 1 - period];
  return (change.array().abs() <= kStillMoving * sizes_.array()).all();
}

std::optional<double> ZenoDetector::accumulation() const {
  for (std::size_t period = 1; period <= kLongestPeriod; ++period)
    for (std::size_t ratios = kRatios; ratios >= kFewestRatios; --ratios)
      if (const auto left = steady_rest(period, ratios);
          left && (*left <= kNothingLeft * t_ || (*left <= kLeftOver * t_ && settles(period))))
        return t_ + *left;
  if (!chatters()) return std::nullopt;
  const auto left = slow_rest();
  return left && *left <= kSlowLeftOver * t_ ? std::optional(t_ + *left) : std::nullopt;
}

/// What is left where the last so many ratios agree: twelve, or as many as make a millionth.
std::optional<double> ZenoDetector::steady_rest(std::size_t period, std::size_t ratios) const {
  if (lengths_.size() < ratios + period) return std::nullopt;
  double smallest = 2;
  double largest = 0;
  for (std::size_t k = lengths_.size() - ratios; k < lengths_.size(); ++k) {
    const double ratio = lengths_[k] / lengths_[k - period];
    smallest = std::min(smallest, ratio);
    largest = std::max(largest, ratio);
  }
  if (!(largest < 1) || largest - smallest > kSteadyFactor * (1 - largest)) return std::nullopt;
  // The last ratio errs by rounding most: the mean over all of them.
  const std::size_t turns = ratios / period;
  const double all = lengths_.back() / lengths_[lengths_.size() - 1 - turns * period];
  if (ratios < kRatios && all > kManyPowers) return std::nullopt;
  const double r = std::pow(all, 1 / static_cast<double>(turns));
  double last = 0;
  for (std::size_t k = 1; k <= period; ++k) last += lengths_[lengths_.size() - k];
  return last * r / (1 - r);
}

/// What is left where a hundred lengths shrink so slowly that single ratios do not show it.
std::optional<double> ZenoDetector::slow_rest() const {
  if (lengths_.size() < kKept) return std::nullopt;
  constexpr std::size_t kHalf = (kKept - 1) / 2;
  const double last = lengths_.back();
  const double middle = lengths_[lengths_.size() - 1 - kHalf];
  const double first = lengths_[lengths_.size() - 1 - 2 * kHalf];
  const double early = middle / first;
  const double late = last / middle;
  if (!(early < 1 && late < 1) || std::abs(early - late) > kSlowSteadyFactor * (1 - late))
    return std::nullopt;
  const double r = std::pow(last / first, 1 / static_cast<double>(2 * kHalf));
  return last * r / (1 - r);
}

std::vector<std::size_t> ZenoDetector::events() const {
  std::vector<std::size_t> result;
  for (const std::size_t event : events_)
    if (std::find(result.begin(), result.end(), event) == result.end()) result.push_back(event);
  return result;
}

}  // namespace gainsmith::simulate
