#include "claims/run_figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "claims/smooth_parts.h"
#include "claims/tolerances.h"
#include "hybrid/scenario.h"
#include "numerics/golden_section.h"

namespace gainsmith::claims {

namespace {

using hybrid::DenseStep;
using hybrid::FlowPiece;
using hybrid::JumpPoint;
using hybrid::Trajectory;

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

void Squares::add(double square) {
  if (!(square >= 0 && std::isfinite(square))) {
    ++improper;
    return;
  }
  ++count;
  sum += square;
}

FigureOf::FigureOf(model::FigureKind kind, std::optional<RunValue> value,
                   std::vector<double> numbers, std::size_t event, std::int64_t count, bool after,
                   std::optional<Eigen::Index> passes)
    : kind_(kind),
      value_(std::move(value)),
      numbers_(std::move(numbers)),
      event_(event),
      count_(count),
      after_(after),
      passes_(passes) {}

std::optional<double> FigureOf::operator()(const Trajectory& run) {
  using Kind = model::FigureKind;
  const auto finite = [](std::optional<double> value) {
    return value && std::isnan(*value) ? std::nullopt : value;
  };
  squares_ = {};
  until_ = run.end;
  moment_.resize(0);
  switch (kind_) {
    case Kind::at_event:
      return finite(counted(at_event(run)));
    case Kind::at_time:
      return finite(counted(at_time(run)));
    case Kind::peak:
      return finite(extreme(run, 1));
    case Kind::least:
      return finite(extreme(run, -1));
    case Kind::settles: {
      const double time = settled(run, numbers_.front());
      return std::isinf(time) && !is_complete(run.ending) ? std::nullopt : finite(time);
    }
    case Kind::rms: {
      const auto squares = integral(run, [](double value) { return value * value; });
      if (!squares) return std::nullopt;
      return finite(std::sqrt(*squares / (numbers_.back() - numbers_.front())));
    }
    case Kind::integral:
      return finite(integral(run, [](double value) { return value; }));
    case Kind::nis:
      return finite(mean_before(run));
    case Kind::count:
    case Kind::passes:
    case Kind::lost:
      // Of a chain without an end only some jumps are kept.
      return run.ending == hybrid::Ending::stuck ? std::nullopt : std::optional(number_of(run));
    case Kind::ended:
      break;
  }
  return std::nullopt;
}

std::optional<double> FigureOf::counted(std::optional<double> square) {
  if (square) squares_.add(*square);
  return square;
}

std::optional<double> FigureOf::at_event(const Trajectory& run) {
  std::int64_t found = 0;
  for (const auto& part : run.parts) {
    const auto* jump = std::get_if<JumpPoint>(&part);
    if (jump == nullptr || jump->event != event_ || ++found < count_) continue;
    until_ = jump->t;
    moment_ = after_ ? jump->after : jump->before;
    return value_->number(moment_);
  }
  return std::nullopt;
}

std::optional<double> FigureOf::at_time(const Trajectory& run) {
  const double t = numbers_.front();
  if (!(t >= 0 && hybrid::has_come(t, run.end))) return std::nullopt;
  until_ = t;
  moment_ = run.start;
  for (const auto& part : run.parts) {
    if (const auto* jump = std::get_if<JumpPoint>(&part)) {
      if (!hybrid::has_come(jump->t, t)) break;
      moment_ = jump->after;
      continue;
    }
    const auto& flow = std::get<FlowPiece>(part);
    if (flow.from() > t) break;
    const auto step =
        std::partition_point(flow.steps.begin(), flow.steps.end(),
                             [&](const DenseStep& dense_step) { return dense_step.to < t; });
    moment_ = step == flow.steps.end() ? flow.end : (*step)(t);
  }
  return value_->number(moment_);
}

/// The largest of `most` and the values of a step times `sign`: where a top of a series may lie
/// above it, by golden section.
double FigureOf::extreme(const DenseStep& step, double sign, double most) {
  value_->follow(step);
  if (const auto range = value_->range(); range && (sign > 0 ? range->high : -range->low) <= most)
    return most;
  const auto at = [&](double t) { return sign * value_->at(t); };
  std::vector<Top> tops;
  for (const SmoothPart& part : smooth_parts(*value_, step)) {
    if (part.undefined) return std::numeric_limits<double>::quiet_NaN();
    add_tops(part, part.from, part.to, sign, tops);
  }
  for (const Top& top : tops) {
    if (top.value + top.rise <= most) continue;
    most = std::max({most, at(top.t), at(numerics::peak_between(at, top.before, top.after))});
  }
  return most;
}

double FigureOf::extreme(const Trajectory& run, double sign) {
  double most = sign * value_->number(run.start);
  for (const auto& part : run.parts) {
    if (const auto* jump = std::get_if<JumpPoint>(&part)) {
      most = std::max(most, sign * value_->number(jump->after));
      continue;
    }
    for (const DenseStep& step : std::get<FlowPiece>(part).steps) {
      most = extreme(step, sign, most);
      if (std::isnan(most)) return most;
    }
  }
  return sign * most;
}

/// The last time of a step at which the value is not below a level; minus infinity: never.
double FigureOf::last_above(const DenseStep& step, double level) {
  value_->follow(step);
  if (const auto range = value_->range(); range && range->high < level) return -infinity;
  const auto above = [&](double t) { return !(value_->at(t) < level); };
  const auto last_between = [&](double high, double below) {
    while (true) {
      const double middle = high + (below - high) / 2;
      if (middle == high || middle == below) return high;
      (above(middle) ? high : below) = middle;
    }
  };
  const auto at = [&](double t) { return value_->at(t); };
  std::vector<SmoothPart> parts = smooth_parts(*value_, step);
  for (; !parts.empty(); parts.pop_back()) {
    const SmoothPart& part = parts.back();
    const int last = part.points() - 1;
    std::vector<double> values;
    for (int k = 0; k <= last; ++k) values.push_back(at(part.time(k)));
    const auto value = [&](int k) { return values[static_cast<std::size_t>(k)]; };
    for (int k = last; k >= 0; --k) {
      const int before = std::max(k - 1, 0);
      const int after = std::min(k + 1, last);
      if (!(value(k) < level))
        return k == last ? part.to : last_between(part.time(k), part.time(after));
      // A peak between points at which the value is below the level.
      const double beside = std::min(value(before), value(after));
      const bool is_top = value(k) >= value(before) && value(k) >= value(after);
      if (!is_top || value(k) + (value(k) - beside) < level) continue;
      const double top = numerics::peak_between(at, part.time(before), part.time(after));
      if (above(top)) return last_between(top, part.time(top > part.time(k) ? after : k));
    }
  }
  return -infinity;
}

double FigureOf::settled(const Trajectory& run, double level) {
  bool last = true;
  for (std::size_t k = run.parts.size(); k-- > 0; last = false) {
    if (const auto* jump = std::get_if<JumpPoint>(&run.parts[k])) {
      if (!(value_->number(jump->after) < level)) return last ? infinity : jump->t;
      continue;
    }
    const auto& flow = std::get<FlowPiece>(run.parts[k]);
    if (last && !(value_->number(flow.end) < level)) return infinity;
    for (std::size_t i = flow.steps.size(); i-- > 0;)
      if (const double t = last_above(flow.steps[i], level); t >= 0) return t;
  }
  return value_->number(run.start) < level ? 0 : (run.parts.empty() ? infinity : 0);
}

/// The mean of the values just before the jumps that are not lost.
std::optional<double> FigureOf::mean_before(const Trajectory& run) {
  double sum = 0;
  for (const auto& part : run.parts) {
    const auto* jump = std::get_if<JumpPoint>(&part);
    if (jump == nullptr || jump->event != event_ || jump->lost) continue;
    const double square = value_->number(jump->before);
    sum += square;
    squares_.add(square);
  }
  const std::uint64_t terms = squares_.count + squares_.improper;
  if (terms == 0) return std::nullopt;
  return sum / static_cast<double>(terms);
}

/// The integral of a function of the value: Gauss' rule with five nodes on pieces of the series of
/// each part.
template <class Rate>
std::optional<double> FigureOf::integral(const Trajectory& run, const Rate& rate) {
  // Nodes and weights on [-1, 1]; exact for polynomials of degree 9.
  constexpr std::array<std::pair<double, double>, 5> rule = {
      {{-0.90617984593866399, 0.23692688505618909},
       {-0.53846931010568309, 0.47862867049936647},
       {0, 0.56888888888888889},
       {0.53846931010568309, 0.47862867049936647},
       {0.90617984593866399, 0.23692688505618909}}};
  const double from = numbers_.front();
  const double to = numbers_.back();
  if (!(0 <= from && from < to && to <= run.end * (1 + kValueRounding))) return std::nullopt;
  double sum = 0;
  size_ = 0;
  visit_steps(run, [&](const DenseStep& step) {
    if (!(std::max(from, step.from) < std::min(to, step.to))) return;
    for (const SmoothPart& part : smooth_parts(*value_, step, nullptr, kExactAgreement)) {
      const double low = std::max(from, part.from);
      const auto pieces = static_cast<int>(part.series.size());
      const double half = (std::min(to, part.to) - low) / (2 * pieces);
      if (part.undefined) sum = std::numeric_limits<double>::quiet_NaN();
      std::array<double, rule.size()> at{};
      for (int piece = 0; half > 0 && piece < pieces; ++piece) {
        for (std::size_t k = 0; k < at.size(); ++k)
          at[k] = low + half * (2 * piece + 1 + rule[k].first);
        at = part(at);
        for (std::size_t k = 0; k < at.size(); ++k) {
          const double term = half * rule[k].second * rate(at[k]);
          sum += term;
          size_ += std::abs(term);
        }
      }
    }
  });
  return sum;
}

double FigureOf::own_error(const Trajectory& run) {
  // Both runs make the same series of the same flow; an interpolant is off by its last terms twice.
  constexpr double kOfSeries = 2 * hybrid::kSeriesRounding;
  if (kind_ == model::FigureKind::integral) return kOfSeries * size_;
  if (kind_ == model::FigureKind::rms)
    return kOfSeries * std::sqrt(size_ / (numbers_.back() - numbers_.front()));
  if (kind_ != model::FigureKind::settles) return 0;
  const double level = numbers_.front();
  const double low = settled(run, level * (1 + kExactAgreement));
  const double high = settled(run, level * (1 - kExactAgreement));
  return low == high ? 0 : high - low;
}

double FigureOf::number_of(const Trajectory& run) const {
  using Kind = model::FigureKind;
  double count = 0;
  for (const auto& part : run.parts) {
    const auto* jump = std::get_if<JumpPoint>(&part);
    if (jump == nullptr || jump->event != event_) continue;
    if (kind_ == Kind::passes)
      count += passes_ ? jump->after(*passes_) : 0;
    else
      count += kind_ == Kind::count || jump->lost ? 1 : 0;
  }
  return count;
}

}  // namespace gainsmith::claims
