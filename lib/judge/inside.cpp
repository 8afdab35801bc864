#include "judge/inside.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "judge/flow.h"

namespace gainsmith::judge {

namespace {

constexpr int points = 16;  ///< inside a step
constexpr int closer = 24;  ///< next to each end of a flow: down to 4^-24 of a step

/// Whether a value that is `here` <= 0 between two others may be above 0 near by: it is an
/// extremum, and 0 is no farther than the lower of the others.
bool may_reach(double before, double here, double after) {
  // A parabola through three points of equal distances rises above `here` by rise/8 at most.
  const double rise = here - std::min(before, after);
  return here >= before && here >= after && rise > 0 && here + rise >= 0;
}

}  // namespace

bool fires(model::Dynamics::EventKind kind, int from, int to) {
  using EventKind = model::Dynamics::EventKind;
  if (kind == EventKind::rises) return from < 0 && to > 0;
  if (kind == EventKind::falls) return from > 0 && to < 0;
  return from * to < 0;
}

bool leaves_zero(model::Dynamics::EventKind kind, int to) { return fires(kind, -to, to); }

int side_of(Text& crossing, const Eigen::VectorXd& x, const Eigen::VectorXd& rounding) {
  const double value = crossing(x)(0, 0);
  const double spread = crossing.spread(x, rounding)(0, 0);
  if (std::abs(value) <= spread) return 0;
  return value > 0 ? 1 : -1;
}

void FlowInside::operator()(std::size_t part, const hybrid::FlowPiece& piece) {
  part_ = part;
  for (std::size_t e = 0; e < memory_.size(); ++e)
    if (memory_[e].clock) watch_clock(piece, e);
  const std::vector<Sample> all = samples(piece);
  for (std::size_t e = 0; e < memory_.size(); ++e) {
    EventTexts& texts = texts_.events[e];
    if (texts.condition)
      watch_condition(piece, all, *texts.condition, e,
                      "becomes due inside a flow: " + texts_.dynamics.events[e].name);
    if (texts.crossing) watch_crossing(piece, all, e);
  }
  for (FlowSetText& flow_set : texts_.flow_sets)
    watch_condition(piece, all, flow_set.left, std::nullopt,
                    "a flow leaves where it may be: " + flow_set.say);
}

/// By the step that holds t; at a joint the later one, except at the end.
FlowInside::Sample FlowInside::sample(const hybrid::FlowPiece& piece, double t) const {
  const auto after =
      std::upper_bound(piece.steps.begin(), piece.steps.end() - 1, t,
                       [](double time, const hybrid::DenseStep& step) { return time < step.to; });
  Sample result{t, (*after)(t), step_sizes(texts_, *after)};
  texts_.settle(piece.start, result.x);
  return result;
}

std::vector<double> FlowInside::sample_times(const hybrid::FlowPiece& piece) {
  std::vector<double> times;
  for (const hybrid::DenseStep& step : piece.steps) {
    times.push_back(step.from);
    for (int k = 0; k < points; ++k) {
      const double z = std::cos(std::numbers::pi * (k + 0.5) / points);
      times.push_back(step.from + (step.to - step.from) * (1 - z) / 2);
    }
  }
  // Ever closer to where the flow begins and ends: what comes too late comes near an end.
  const hybrid::DenseStep& first = piece.steps.front();
  const hybrid::DenseStep& last = piece.steps.back();
  double share = 0.25;
  for (int k = 0; k < closer; ++k, share /= 4) {
    times.push_back(first.from + share * (first.to - first.from));
    times.push_back(last.to - share * (last.to - last.from));
  }
  times.push_back(last.to);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

std::vector<FlowInside::Sample> FlowInside::samples(const hybrid::FlowPiece& piece) const {
  std::vector<Sample> all;
  for (const double t : sample_times(piece)) all.push_back(sample(piece, t));
  return all;
}

bool FlowInside::must_jump(std::size_t event, const Sample& at) {
  auto& only_if = texts_.events[event].only_if;
  return !only_if || truth(*only_if, at) == Truth::yes;
}

Truth FlowInside::truth(Guard& guard, const Sample& at, double times) {
  return guard.truth(at.x, times * rounding_at(texts_, at.t, at.x, at.sizes));
}

double FlowInside::highest(double low, double high, const std::function<double(double)>& value) {
  const double share = (std::sqrt(5.0) - 1) / 2;
  double a = high - share * (high - low);
  double b = low + share * (high - low);
  double at_a = value(a);
  double at_b = value(b);
  // 60 steps shrink the interval by 0.618^60 = 3e-13.
  for (int k = 0; k < 60 && std::max(at_a, at_b) <= 0; ++k) {
    if (at_a > at_b) {
      high = b;
      b = a;
      at_b = at_a;
      a = high - share * (high - low);
      at_a = value(a);
    } else {
      low = a;
      a = b;
      at_a = at_b;
      b = low + share * (high - low);
      at_b = value(b);
    }
  }
  return at_a > at_b ? a : b;
}

double FlowInside::entry(double low, double high, const std::function<bool(double)>& is_there) {
  for (int k = 0; k < 60; ++k) {
    const double middle = low + (high - low) / 2;
    if (!(low < middle && middle < high)) break;
    (is_there(middle) ? high : low) = middle;
  }
  return high;
}

void FlowInside::watch_condition(const hybrid::FlowPiece& piece, const std::vector<Sample>& all,
                                 Guard& guard, std::optional<std::size_t> event,
                                 const std::string& what) {
  bool none = false;  // of what has no `if` nothing is ever spent
  bool& spent = event ? memory_[*event].spent : none;
  const auto holds = [&](double t) { return guard(sample(piece, t).x); };
  const auto depth = [&](double t) { return guard.depth(sample(piece, t).x); };
  std::vector<double> depths;
  for (const Sample& sample : all) depths.push_back(guard.depth(sample.x));
  // Found true at `at`, false or spent at `before`.
  const auto found = [&](double before, const Sample& at) {
    if (truth(guard, at, event ? 1 : hybrid::kPlain) != Truth::yes) return;
    if (event && texts_.events[*event].only_if) {
      if (!must_jump(*event, sample(piece, entry(before, at.t, holds)))) {
        spent = true;
        return;
      }
    }
    faults_.add(part_, at.t, what);
  };
  for (std::size_t k = 1; k + 1 < all.size(); ++k) {
    if (guard(all[k].x)) {
      if (!spent) found(all[k - 1].t, all[k]);
      continue;
    }
    spent = false;
    if (!may_reach(depths[k - 1], depths[k], depths[k + 1])) continue;
    if (guard(all[k - 1].x) || guard(all[k + 1].x)) continue;
    const double top = highest(all[k - 1].t, all[k + 1].t, depth);
    const Sample peak = sample(piece, top);
    if (guard(peak.x)) found(all[k - 1].t, peak);
    spent = false;
  }
}

void FlowInside::watch_crossing(const hybrid::FlowPiece& piece, const std::vector<Sample>& all,
                                std::size_t event) {
  const std::string what = "crosses zero inside a flow: " + texts_.dynamics.events[event].name;
  Text& crossing = *texts_.events[event].crossing;
  const model::Dynamics::EventKind kind = texts_.dynamics.events[event].kind;
  EventMemory& memory = memory_[event];
  int& known = memory.side;
  memory.spent = false;
  const auto side_at = [&](const Sample& at) {
    return side_of(crossing, at.x, rounding_at(texts_, at.t, at.x, at.sizes));
  };
  std::vector<double> values;
  for (const Sample& sample : all) values.push_back(crossing(sample.x)(0, 0));
  // Rounding hides where zero is left: it may be where `if` is false.
  const auto look_at_if = [&](const Sample& at) {
    if (!memory.at_zero || must_jump(event, at)) return;
    memory.at_zero = false;
    memory.near_zero = true;
  };
  look_at_if(all[0]);
  for (std::size_t k = 1; k + 1 < all.size(); ++k) {
    const int now = side_at(all[k]);
    if (now == 0) {
      // It may have crossed 0 in the other direction, or have come back to it.
      if (known * values[k] <= 0) memory.near_zero = true;
      look_at_if(all[k]);
      continue;
    }
    if (fires(kind, known, now) || (memory.at_zero && leaves_zero(kind, now))) {
      const auto is_there = [&](double t) { return now * crossing(sample(piece, t).x)(0, 0) > 0; };
      const double t = entry(all[k - 1].t, all[k].t, is_there);
      if (must_jump(event, sample(piece, t))) faults_.add(part_, t, what);
    }
    known = now;
    memory.at_zero = memory.near_zero = false;
    // The value nearest to 0 between points on one side: a pair of crossings holds one of each
    // direction.
    if (now * values[k - 1] <= 0 || now * values[k + 1] <= 0) continue;
    if (!may_reach(-now * values[k - 1], -now * values[k], -now * values[k + 1])) continue;
    const auto beyond = [&](double t) { return -now * crossing(sample(piece, t).x)(0, 0); };
    const Sample peak = sample(piece, highest(all[k - 1].t, all[k + 1].t, beyond));
    if (side_at(peak) == -now && must_jump(event, peak)) faults_.add(part_, peak.t, what);
  }
}

void FlowInside::watch_clock(const hybrid::FlowPiece& piece, std::size_t event) {
  EventClock& clock = *memory_[event].clock;
  while (clock.next() < piece.to() && !same_time(clock.next(), piece.to())) {
    const double t = clock.next();
    if (t > piece.from() && !same_time(t, piece.from()) && must_jump(event, sample(piece, t)))
      faults_.add(part_, t, "becomes due inside a flow: " + texts_.dynamics.events[event].name);
    clock.spent(t);
    if (!(clock.next() > t)) break;
  }
}

}  // namespace gainsmith::judge
