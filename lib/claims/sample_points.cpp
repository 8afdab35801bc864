#include "claims/sample_points.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <limits>

#include "claims/smooth_parts.h"
#include "claims/tolerances.h"
#include "hybrid/tolerances.h"
#include "numerics/golden_section.h"

namespace gainsmith::claims {

namespace {

using hybrid::DenseStep;
using hybrid::FlowPiece;

Eigen::VectorXd state_at_time(const FlowPiece& flow, double t) {
  const auto step =
      std::partition_point(flow.steps.begin(), std::prev(flow.steps.end()),
                           [&](const DenseStep& dense_step) { return dense_step.to < t; });
  return (*step)(t);
}

/// Where a value jumps, and where it nearly branches.
struct Breaks {
  std::vector<double> jumps, near;
};

/// Whether nothing breaks on a step.
bool is_whole(const std::vector<SmoothPart>& parts) {
  return parts.size() == 1 && !parts[0].after_jump && !parts[0].before_jump;
}

/// A part on which a value does not jump, without the margins beside jumps, from a time on.
struct Stretch {
  SmoothPart part;
  double from = 0;
  double to = 0;
};

/// In order, with where the value jumps and where it nearly branches.
std::vector<Stretch> stretches_of(const FlowPiece& flow, RunValue& function, double after,
                                  Breaks* breaks = nullptr, double agreement = kAgreement,
                                  bool noise = false) {
  std::vector<Stretch> result;
  bool jumped = false;  // at the end of the part before
  for (const DenseStep& step : flow.steps) {
    if (step.to < after) continue;
    if (step.from >= function.followed_until) break;
    const std::vector<SmoothPart> parts =
        smooth_parts(function, step, breaks != nullptr ? &breaks->near : nullptr, agreement, noise);
    if (!parts.front().followed) {
      function.followed_until = step.from;
      break;
    }
    if (breaks != nullptr && !jumped && is_whole(parts)) continue;
    for (const SmoothPart& part : parts) {
      if (breaks != nullptr && part.after_jump) breaks->jumps.push_back(part.from);
      if (breaks != nullptr && part.before_jump) breaks->jumps.push_back(part.to);
      const double aside = kBesideJump * (part.to - part.from);
      const bool jumps = part.after_jump || jumped;
      jumped = part.before_jump;
      const double from = std::max(jumps ? part.from + aside : part.from, after);
      const double to = jumped ? part.to - aside : part.to;
      if (from <= to) result.push_back({part, from, to});
    }
  }
  return result;
}

/// The ends and middles of the stretches of steps on which the value breaks.
void add_places(const FlowPiece& flow, RunValue& function, Breaks& breaks,
                const std::function<void(double)>& add) {
  for (const Stretch& stretch : stretches_of(flow, function, flow.from(), &breaks))
    for (const double t :
         {stretch.from, stretch.from + (stretch.to - stretch.from) / 2, stretch.to})
      add(t);
}

/// The time of a peak; a value that is no number is one.
double time_of(const SamplePoints::Peak& peak, const FlowPiece& flow, RunValue& function) {
  std::vector<Top> tops;
  for (const Stretch& stretch : stretches_of(flow, function, peak.after)) {
    if (stretch.part.undefined) return *stretch.part.undefined;
    add_tops(stretch.part, stretch.from, stretch.to, peak.sign, tops);
  }
  std::stable_sort(tops.begin(), tops.end(),
                   [](const Top& a, const Top& b) { return a.value > b.value; });
  const auto at = [&](double t) { return peak.sign * function.number(state_at_time(flow, t)); };
  double best = flow.to();
  double most = -std::numeric_limits<double>::infinity();
  for (const Top& top : tops) {
    // A top of the series may lie above its points by the rise beside it at most.
    if (top.value + top.rise <= most) continue;
    const double refined = numerics::peak_between(at, top.before, top.after);
    for (const double t : {top.t, refined})
      if (const double value = at(t); value > most) {
        most = value;
        best = t;
      }
  }
  return best;
}

/// The lows of a value and the tops after them. A rise counts that is larger than its noise and
/// than `noise` of its size, and that leads to a size above `floor`. A low is the lowest so far.
class Rises {
 public:
  Rises(double noise, double floor) : noise_(noise), floor_(floor) {}

  /// Whether no rise between values of such a size counts.
  bool is_drowned(double size) const { return size <= floor_; }

  /// `size`, `noise`: of the part around.
  void next(double t, double value, double size, double noise) {
    if (value < low_) {
      end();
      low_ = top_ = value;
      low_at_ = t;
      size_ = size;
      drowned_ = noise;
    } else if (value > top_) {
      top_ = value;
      top_at_ = t;
      size_ = std::max(size_, size);
      drowned_ = std::max(drowned_, noise);
    }
  }

  const std::vector<double>& end() {
    if (top_at_ > low_at_ && top_ - low_ > noise_ * size_ + kErrorOfDifference * drowned_ &&
        size_ > floor_)
      times_.insert(times_.end(), {low_at_, top_at_});
    top_ = low_;
    return times_;
  }

 private:
  double noise_, floor_;
  double low_ = std::numeric_limits<double>::infinity();
  double top_ = low_;
  double low_at_ = 0, top_at_ = 0;
  double size_ = 0;     ///< the largest around
  double drowned_ = 0;  ///< the largest noise around
  std::vector<double> times_;
};

/// The ends of a stretch, and where its series turns.
void add_points(const Stretch& stretch, Rises& rises) {
  const double size = stretch.part.series.cwiseAbs().sum();
  std::vector<double> times;
  if (!rises.is_drowned(size)) times = turns_of(stretch.part);
  times.insert(times.begin(), stretch.from);
  times.push_back(stretch.to);
  for (const double t : times)
    if (stretch.from <= t && t <= stretch.to)
      rises.next(t, stretch.part(t), size, stretch.part.noise);
}

std::vector<double> rises_of(const SamplePoints::Falling& falling, const FlowPiece& flow,
                             RunValue& function, const RiseLimits& limits) {
  std::vector<double> undefined;
  Rises rises(limits.noise, limits.floor(static_cast<Eigen::Index>(falling.function)));
  for (const Stretch& stretch :
       stretches_of(flow, function, falling.after, nullptr, limits.agreement, true)) {
    if (stretch.part.undefined)
      undefined.push_back(*stretch.part.undefined);
    else
      add_points(stretch, rises);
  }
  std::vector<double> times = rises.end();
  times.insert(times.end(), undefined.begin(), undefined.end());
  return times;
}

}  // namespace

Eigen::VectorXd state_at(const FlowPiece& flow, double share) {
  if (share >= 1) return flow.end;
  return state_at_time(flow, flow.from() + (flow.to() - flow.from()) * share);
}

std::vector<SamplePoint> points_along(const FlowPiece& flow, const SamplePoints& wanted,
                                      std::vector<RunValue>& functions, const RiseLimits& rises) {
  const double from = flow.from();
  const double length = flow.to() - from;
  std::vector<SamplePoint> result;
  for (int part = 1; part <= kPartsOfFlow; ++part) {
    const double share = static_cast<double>(part) / kPartsOfFlow;
    result.push_back({share, from + length * share});
  }
  const auto add = [&](double t, int function) {
    if (t > from && t < flow.to()) result.push_back({(t - from) / length, t, function});
  };
  // Next to an end of the flow, whose time is rounded, that end is the sample.
  for (const double t : wanted.times)
    if (t > (1 + hybrid::kAddedUp) * from && t < (1 - hybrid::kAddedUp) * flow.to()) add(t, -1);
  for (const std::size_t function : wanted.along)
    if (!functions[function].is_smooth()) {
      Breaks breaks;
      add_places(flow, functions[function], breaks,
                 [&](double t) { add(t, static_cast<int>(function)); });
      const bool is_bounded =
          std::any_of(wanted.peaks.begin(), wanted.peaks.end(),
                      [&](const SamplePoints::Peak& peak) { return peak.function == function; });
      if (is_bounded)
        for (const double t : breaks.jumps) add(t, static_cast<int>(function));
      for (const double t : breaks.near) add(t, static_cast<int>(function));
    }
  for (const SamplePoints::Peak& peak : wanted.peaks)
    if (peak.after < flow.to())
      add(time_of(peak, flow, functions[peak.function]), static_cast<int>(peak.function));
  for (const SamplePoints::Falling& falling : wanted.falling)
    if (falling.after < flow.to()) {
      for (const double t : rises_of(falling, flow, functions[falling.function], rises))
        add(t, static_cast<int>(falling.function));
    }
  std::stable_sort(result.begin(), result.end(),
                   [](const SamplePoint& a, const SamplePoint& b) { return a.t < b.t; });
  return result;
}

}  // namespace gainsmith::claims
