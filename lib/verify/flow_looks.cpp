#include "verify/flow_looks.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>

namespace gainsmith::verify {

namespace {

using hybrid::DenseStep;
using hybrid::FlowPiece;

constexpr int kParts = 32;

Eigen::VectorXd state_at_time(const FlowPiece& flow, double t) {
  const auto step = std::find_if(flow.steps.begin(), std::prev(flow.steps.end()),
                                 [&](const DenseStep& one) { return t <= one.to; });
  return (*step)(t);
}

/// The ends and middles of the steps, from a time on.
std::vector<double> nodes_of(const FlowPiece& flow, double after) {
  std::vector<double> nodes = {std::max(flow.from(), after)};
  for (const DenseStep& step : flow.steps)
    for (const double t : {step.from + (step.to - step.from) / 2, step.to})
      if (t > nodes.back()) nodes.push_back(t);
  return nodes;
}

/// Where a function is largest in [low, high], if it has one peak there.
template <class Function>
double peak_between(const Function& at, double low, double high) {
  constexpr int kSections = 40;
  const double ratio = std::numbers::phi - 1;
  double a = high - ratio * (high - low);
  double b = low + ratio * (high - low);
  double at_a = at(a);
  double at_b = at(b);
  for (int k = 0; k < kSections && low < a && a < b && b < high; ++k) {
    if (at_a >= at_b) {
      high = std::exchange(b, std::exchange(a, b - ratio * (b - low)));
      at_b = std::exchange(at_a, at(a));
    } else {
      low = std::exchange(a, std::exchange(b, a + ratio * (high - a)));
      at_a = std::exchange(at_b, at(b));
    }
  }
  return at_a >= at_b ? a : b;
}

/// The time of a peak; a value that is no number is one.
double time_of(const FlowLooks::Peak& peak, const FlowPiece& flow, RunValue& function) {
  const auto at = [&](double t) {
    const double value = peak.sign * function.number(state_at_time(flow, t));
    return std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
  };
  const std::vector<double> nodes = nodes_of(flow, peak.after);
  std::size_t best = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < nodes.size(); ++k)
    if (const double value = at(nodes[k]); value > most) {
      best = k;
      most = value;
    }
  if (std::isinf(most)) return nodes[best];
  const double low = nodes[best == 0 ? 0 : best - 1];
  const double high = nodes[std::min(best + 1, nodes.size() - 1)];
  const double refined = peak_between(at, low, high);
  return at(refined) > most ? refined : nodes[best];
}

}  // namespace

Eigen::VectorXd state_at(const FlowPiece& flow, double share) {
  if (share >= 1) return flow.end;
  return state_at_time(flow, flow.from() + (flow.to() - flow.from()) * share);
}

std::vector<FlowLook> looks_along(const FlowPiece& flow, const FlowLooks& looks,
                                  std::vector<RunValue>& functions) {
  const double from = flow.from();
  const double length = flow.to() - from;
  std::vector<FlowLook> result;
  for (int part = 1; part <= kParts; ++part) {
    const double share = static_cast<double>(part) / kParts;
    result.push_back({share, from + length * share});
  }
  const auto add = [&](double t) {
    if (t > from && t < flow.to()) result.push_back({(t - from) / length, t});
  };
  for (const double t : looks.times) add(t);
  for (const FlowLooks::Peak& peak : looks.peaks)
    if (peak.after < flow.to()) add(time_of(peak, flow, functions[peak.function]));
  if (result.size() == kParts) return result;
  const auto earlier = [](const FlowLook& a, const FlowLook& b) { return a.t < b.t; };
  const auto same = [](const FlowLook& a, const FlowLook& b) { return a.t == b.t; };
  std::stable_sort(result.begin(), result.end(), earlier);
  result.erase(std::unique(result.begin(), result.end(), same), result.end());
  return result;
}

}  // namespace gainsmith::verify
