#include "gainsmith/envelope_figure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "statistics/quantiles.h"

namespace gainsmith::app {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kBuckets = 512;   // of each line and time: quantiles of fewer runs are exact
constexpr std::size_t kMostFresh = 64;  // runs

/// After the jumps at a time; on the line between the points of a flow. None beyond its end.
double value_at(const drawing::Curve& curve, double t) {
  const auto next = std::upper_bound(curve.t.begin(), curve.t.end(), t);
  if (next == curve.t.begin()) return kNone;
  const auto k = static_cast<std::size_t>(next - curve.t.begin()) - 1;
  if (next == curve.t.end()) return curve.t[k] == t ? curve.value[k] : kNone;
  const double share = (t - curve.t[k]) / (curve.t[k + 1] - curve.t[k]);
  return share == 0 ? curve.value[k]
                    : curve.value[k] + share * (curve.value[k + 1] - curve.value[k]);
}

double quantile(const statistics::ValueSketch& values, double probability) {
  if (values.count() == 0) return kNone;
  return statistics::quantile_of(values, probability, 0.5).value.value_or(kNone);
}

}  // namespace

EnvelopeFigure::EnvelopeFigure(double horizon, RunView view)
    : step_(horizon / static_cast<double>(kTimes - 1)), view_(std::move(view)) {}

void EnvelopeFigure::add(const verify::Replay& run) {
  if (panels_.empty()) {
    const std::string unit = unit_of(view_, run.columns.front());
    axis_ = unit.empty() ? "t" : "t [" + unit + "]";
    panels_ = planned_panels(run, view_);
    std::erase_if(panels_, [](const PlannedPanel& panel) { return !panel.claims.empty(); });
    for (const PlannedPanel& panel : panels_)
      for (std::size_t k = 0; k < panel.lines.size(); ++k)
        lines_.push_back(
            {std::vector<std::vector<double>>(kTimes),
             std::vector<statistics::ValueSketch>(kTimes, statistics::ValueSketch(kBuckets))});
  }
  std::size_t line = 0;
  for (const PlannedPanel& panel : panels_)
    for (const PlannedLine& planned : panel.lines) {
      const drawing::Curve curve = curve_of(run, planned);
      // The last time is that of the horizon, whatever the rounding of the step.
      for (std::size_t k = 0; k < kTimes; ++k) {
        const bool last = k + 1 == kTimes && is_complete(run.run.ending);
        const double value =
            last ? curve.value.back() : value_at(curve, static_cast<double>(k) * step_);
        if (!std::isnan(value)) lines_[line].fresh[k].push_back(value);
      }
      ++line;
    }
  if (++fresh_ == kMostFresh) settle();
}

void EnvelopeFigure::settle() {
  for (Spread& line : lines_)
    for (std::size_t k = 0; k < kTimes; ++k) line.values[k].add(std::exchange(line.fresh[k], {}));
  fresh_ = 0;
}

drawing::Panel EnvelopeFigure::panel_of(const PlannedPanel& planned, std::size_t first) const {
  drawing::Panel panel;
  panel.title = planned.title;
  panel.axis = planned.unit;
  panel.logarithmic = planned.logarithmic;
  for (std::size_t k = 0; k < planned.lines.size(); ++k) {
    const PlannedLine& line = planned.lines[k];
    drawing::Curve median, least, largest;
    drawing::Band band;
    for (std::size_t at = 0; at < kTimes; ++at) {
      const statistics::ValueSketch& values = lines_[first + k].values[at];
      const bool none = values.count() == 0;
      median.t.push_back(static_cast<double>(at) * step_);
      median.value.push_back(quantile(values, 0.5));
      least.value.push_back(none ? kNone : values.ranked(1).low);
      largest.value.push_back(none ? kNone : values.ranked(values.count()).high);
      band.low.push_back(quantile(values, 0.05));
      band.high.push_back(quantile(values, 0.95));
    }
    band.t = least.t = largest.t = median.t;
    median.label = line.label + ": median";
    if (k == 0) band.label = "5 to 95 % of the runs";
    if (k == 0) least.label = "least, largest";
    median.dashed = line.dashed;
    least.limit = largest.limit = true;
    median.colour = least.colour = largest.colour = band.colour = line.colour;
    panel.bands.push_back(std::move(band));
    for (drawing::Curve* curve : {&median, &least, &largest})
      panel.curves.push_back(std::move(*curve));
  }
  return panel;
}

drawing::Figure EnvelopeFigure::figure(const std::string& title) {
  settle();
  drawing::Figure figure;
  figure.title = title;
  figure.axis = axis_;
  std::size_t line = 0;
  for (const PlannedPanel& panel : panels_) {
    figure.panels.push_back(panel_of(panel, line));
    line += panel.lines.size();
  }
  return figure;
}

}  // namespace gainsmith::app
