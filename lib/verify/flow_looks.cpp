#include "verify/flow_looks.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "numbers/golden_section.h"
#include "verify/smooth_parts.h"

namespace gainsmith::verify {

namespace {

using hybrid::DenseStep;
using hybrid::FlowPiece;

constexpr int kParts = 32;
constexpr int kSections = 40;
/// Of a part beside a jump of a value: two runs to two accuracies jump at times that differ less.
constexpr double kMargin = 1e-5;

Eigen::VectorXd state_at_time(const FlowPiece& flow, double t) {
  const auto step = std::find_if(flow.steps.begin(), std::prev(flow.steps.end()),
                                 [&](const DenseStep& one) { return t <= one.to; });
  return (*step)(t);
}

/// A place where a value is looked at first. The value does not jump within a run of places.
struct Place {
  double t = 0;
  int run = 0;
};

/// Where a value jumps, and where it nearly branches.
struct Borders {
  std::vector<double> jumps, near;
};

/// Whether nothing breaks on a step.
bool is_whole(const std::vector<SmoothPart>& parts) {
  return parts.size() == 1 && !parts[0].after_jump && !parts[0].before_jump;
}

/// The ends and middles of the parts of the steps on which a value is smooth, from a time on; where
/// its borders are asked for, only of the steps that have some.
std::vector<Place> places_of(const FlowPiece& flow, RunValue& function, double after,
                             Borders* borders = nullptr) {
  std::vector<Place> places;
  int run = 0;
  bool jumped = false;  // at the end of the part before
  for (const DenseStep& step : flow.steps) {
    if (step.to < after) continue;
    const std::vector<SmoothPart> parts =
        smooth_parts(function, step, borders != nullptr ? &borders->near : nullptr);
    if (borders != nullptr && !jumped && is_whole(parts)) continue;
    for (const SmoothPart& part : parts) {
      if (borders != nullptr && part.after_jump) borders->jumps.push_back(part.from);
      if (borders != nullptr && part.before_jump) borders->jumps.push_back(part.to);
      const double aside = kMargin * (part.to - part.from);
      const bool jumps = part.after_jump || jumped;
      run += jumps ? 1 : 0;
      jumped = part.before_jump;
      const double from = std::max(jumps ? part.from + aside : part.from, after);
      const double to = jumped ? part.to - aside : part.to;
      for (const double t : {from, from + (to - from) / 2, to})
        if (t >= from && (places.empty() || t > places.back().t)) places.push_back({t, run});
    }
  }
  return places;
}

/// The time of a peak; a value that is no number is one.
double time_of(const FlowLooks::Peak& peak, const FlowPiece& flow, RunValue& function) {
  const auto at = [&](double t) {
    const double value = peak.sign * function.number(state_at_time(flow, t));
    return std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
  };
  const std::vector<Place> places = places_of(flow, function, peak.after);
  std::size_t best = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < places.size(); ++k)
    if (const double value = at(places[k].t); value > most) {
      best = k;
      most = value;
    }
  if (std::isinf(most)) return places[best].t;
  const auto beside = [&](std::size_t k) {
    return k < places.size() && places[k].run == places[best].run ? places[k].t : places[best].t;
  };
  const double refined = numbers::peak_between(at, beside(best - 1), beside(best + 1), kSections);
  return at(refined) > most ? refined : places[best].t;
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
  const auto add = [&](double t, int function) {
    if (t > from && t < flow.to()) result.push_back({(t - from) / length, t, function});
  };
  for (const double t : looks.times) add(t, -1);
  for (const std::size_t function : looks.along)
    if (!functions[function].is_smooth()) {
      Borders borders;
      for (const Place& place : places_of(flow, functions[function], from, &borders))
        add(place.t, static_cast<int>(function));
      const bool is_bounded =
          std::any_of(looks.peaks.begin(), looks.peaks.end(),
                      [&](const FlowLooks::Peak& peak) { return peak.function == function; });
      if (is_bounded)
        for (const double t : borders.jumps) add(t, static_cast<int>(function));
      for (const double t : borders.near) add(t, static_cast<int>(function));
    }
  for (const FlowLooks::Peak& peak : looks.peaks)
    if (peak.after < flow.to())
      add(time_of(peak, flow, functions[peak.function]), static_cast<int>(peak.function));
  std::stable_sort(result.begin(), result.end(),
                   [](const FlowLook& a, const FlowLook& b) { return a.t < b.t; });
  return result;
}

}  // namespace gainsmith::verify
