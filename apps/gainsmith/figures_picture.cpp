#include "gainsmith/figures_picture.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "drawing/figure.h"

namespace gainsmith::app {

namespace {

using statistics::FigureSummary;
using Summaries = std::vector<const FigureSummary*>;  ///< of a figure, by observer

/// Bars of one width, next to each other.
struct Bins {
  double low = 0;
  double width = 1;
  std::size_t count = 1;

  double edge(std::size_t k) const { return low + static_cast<double>(k) * width; }
  std::size_t of(double value) const {
    const double place = std::floor((value - low) / width);
    return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(count - 1)));
  }
};

/// The least and the greatest finite value.
struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;

  void add(const Range& more) {
    low = std::min(low, more.low);
    high = std::max(high, more.high);
  }
  double width() const { return high > low ? high - low : 0; }
};

Range range_of(const FigureSummary& figure) {
  Range range;
  for (const auto& part : figure.values.parts()) {
    const double value = part.values.middle();
    if (std::isfinite(value)) range.add({value, value});
  }
  return range;
}

/// Rice's rule, for the observer with most runs. Bars of whole numbers have these in their middles.
Bins bins_of(const Summaries& figures) {
  constexpr double kMost = 60;
  Range range;
  double runs = 0;
  for (const FigureSummary* figure : figures) {
    range.add(range_of(*figure));
    runs = std::max(runs, static_cast<double>(figure->values.count()));
  }
  if (range.low > range.high) return {};
  const double wanted = std::clamp(std::ceil(2 * std::cbrt(runs)), 1.0, kMost);
  if (figures.front()->whole) {
    const double span = range.high - range.low + 1;
    const double width = std::max(1.0, std::ceil(span / wanted));
    return {range.low - 0.5, width, static_cast<std::size_t>(std::ceil(span / width))};
  }
  const double width = range.width() / wanted;
  const double size = std::max(std::abs(range.low), std::abs(range.high));
  // What differs in its last places alone is one bar.
  if (!(width > 1e-12 * size) || !std::isfinite(width)) {
    const double half = size == 0 ? 0.5 : 0.05 * size;
    return {range.low - half, range.width() + 2 * half, 1};
  }
  return {range.low, width, static_cast<std::size_t>(wanted)};
}

drawing::Curve outline(const FigureSummary& figure, const Bins& bins, int colour) {
  std::vector<std::uint64_t> runs(bins.count, 0);
  std::uint64_t others = figure.without + figure.unknown.count;
  for (const auto& part : figure.values.parts()) {
    const double value = part.values.middle();
    if (std::isfinite(value))
      runs[bins.of(value)] += part.count;
    else
      others += part.count;
  }
  drawing::Curve curve;
  curve.label = figure.observer;
  if (others > 0)
    curve.label +=
        fmt::format("{}{} of {} runs have no finite value", figure.observer.empty() ? "" : ": ",
                    others, figure.values.count() + figure.without + figure.unknown.count);
  curve.colour = colour;
  const auto add = [&](double at, double value) {
    curve.t.push_back(at);
    curve.value.push_back(value);
  };
  add(bins.edge(0), 0);
  for (std::size_t k = 0; k < bins.count; ++k) {
    add(bins.edge(k), static_cast<double>(runs[k]));
    add(bins.edge(k + 1), static_cast<double>(runs[k]));
  }
  add(bins.edge(bins.count), 0);
  return curve;
}

/// Observers whose values spread alike share a panel: in that of others they would be one bar.
std::vector<Summaries> grouped(const Summaries& figures) {
  constexpr double kAlike = 5;
  std::vector<Summaries> groups;
  for (const FigureSummary* figure : figures) {
    const double width = range_of(*figure).width();
    const auto found = std::find_if(groups.begin(), groups.end(), [&](const Summaries& group) {
      const double other = range_of(*group.front()).width();
      return std::max(width, other) <= kAlike * std::min(width, other);
    });
    if (found == groups.end())
      groups.push_back({figure});
    else
      found->push_back(figure);
  }
  return groups;
}

drawing::Panel panel_of(const Summaries& figures) {
  drawing::Panel panel;
  panel.across = figures.front()->title;
  panel.axis = "runs";
  panel.bars = true;
  const Bins bins = bins_of(figures);
  for (std::size_t k = 0; k < figures.size(); ++k) {
    panel.curves.push_back(outline(*figures[k], bins, static_cast<int>(k)));
    panel.curves.back().dashed = k > 0;  // so that each is seen where they agree
  }
  return panel;
}

}  // namespace

drawing::Figure histograms(const std::string& title, const statistics::FigureSurvey& survey) {
  drawing::Figure picture;
  picture.title = title;
  for (std::size_t k = 0; k < survey.figures.size();) {
    Summaries same;
    for (const std::string& name = survey.figures[k].title;
         k < survey.figures.size() && survey.figures[k].title == name; ++k)
      same.push_back(&survey.figures[k]);
    for (const Summaries& group : grouped(same)) picture.panels.push_back(panel_of(group));
  }
  return picture;
}

}  // namespace gainsmith::app
