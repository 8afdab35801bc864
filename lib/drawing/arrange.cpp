// Changes of a figure before it is drawn. Cuts interpolate linearly between the samples beside an
// end.
#include "drawing/arrange.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>

namespace gainsmith::drawing {

namespace {

/// Values over times, with jumps between them: of a curve, or of both ends of a band.
struct Series {
  std::vector<double>* t;
  std::vector<std::size_t>* jumps;
  std::vector<std::vector<double>*> values;
};

Series series_of(Curve& curve) { return {&curve.t, &curve.jumps, {&curve.value}}; }
Series series_of(Band& band) { return {&band.t, &band.jumps, {&band.low, &band.high}}; }

bool is_jump(const Series& series, std::size_t k) {
  return std::binary_search(series.jumps->begin(), series.jumps->end(), k);
}

/// Samples within [from, to], and one at an end that a line crosses. No line leads across a jump.
void cut(const Series& series, double from, double to) {
  const std::vector<double> t = *series.t;
  std::vector<double> times;
  std::vector<std::size_t> jumps;
  std::vector<std::vector<double>> values(series.values.size());
  const auto add = [&](std::size_t k, double share) {
    times.push_back(share == 0 ? t[k] : t[k] + share * (t[k + 1] - t[k]));
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::vector<double>& of = *series.values[i];
      values[i].push_back(share == 0 ? of[k] : (1 - share) * of[k] + share * of[k + 1]);
    }
  };
  for (std::size_t k = 0; k < t.size(); ++k) {
    const bool inside = from <= t[k] && t[k] <= to;
    if (inside) {
      if (k > 0 && from <= t[k - 1] && is_jump(series, k - 1)) jumps.push_back(times.size() - 1);
      add(k, 0);
    }
    if (k + 1 == t.size() || is_jump(series, k)) continue;
    for (const double end : {from, to})
      if (t[k] < end && end < t[k + 1]) add(k, (end - t[k]) / (t[k + 1] - t[k]));
  }
  *series.t = std::move(times);
  *series.jumps = std::move(jumps);
  for (std::size_t i = 0; i < values.size(); ++i) *series.values[i] = std::move(values[i]);
}

/// `moments`: those of all jumps. What has none of its own, such as a bound, takes them by the
/// time.
void spread(const Series& series, double width, const std::vector<double>& moments) {
  const bool own = !series.jumps->empty();
  std::ptrdiff_t jumps = 0;
  for (std::size_t k = 0; k < series.t->size(); ++k) {
    double& t = (*series.t)[k];
    if (!own) jumps = std::ranges::upper_bound(moments, t) - moments.begin();
    t += width * static_cast<double>(jumps);
    if (own && is_jump(series, k)) ++jumps;
  }
}

/// The part of a plane between two places across, with gaps where lines leave it.
void cut_across(Curve& curve, double from, double to) {
  Curve part = curve;
  part.t.clear();
  part.value.clear();
  const auto add = [&](double t, double value) {
    part.t.push_back(t);
    part.value.push_back(value);
  };
  for (std::size_t k = 0; k < curve.t.size(); ++k) {
    const double t = curve.t[k], value = curve.value[k];
    if (from <= t && t <= to) add(t, value);
    if (k + 1 == curve.t.size() || !curve.joined) continue;
    const double next = curve.t[k + 1];
    const bool rises = next > t;
    for (const double end : {rises ? from : to, rises ? to : from}) {
      if (!(std::min(t, next) < end && end < std::max(t, next))) continue;
      add(end, value + (end - t) / (next - t) * (curve.value[k + 1] - value));
      if (end == (rises ? to : from)) add(end, std::numeric_limits<double>::quiet_NaN());
    }
  }
  curve = std::move(part);
}

/// All curves and bands over the axis below: those of planes have other quantities there.
void for_each_series(Figure& figure, const std::function<void(const Series&)>& act) {
  for (Panel& panel : figure.panels) {
    if (panel.across) continue;
    for (Curve& curve : panel.curves) act(series_of(curve));
    for (Band& band : panel.bands) act(series_of(band));
  }
}

/// All texts of a figure but its title.
void for_each_name(Figure& figure, const std::function<void(std::string&)>& act) {
  act(figure.axis);
  for (Panel& panel : figure.panels) {
    act(panel.title);
    act(panel.axis);
    if (panel.across) act(*panel.across);
    for (Curve& curve : panel.curves) act(curve.label);
    for (Band& band : panel.bands) act(band.label);
  }
}

}  // namespace

void cut(Figure& figure, double from, double to) {
  const auto is_plane = [](const Panel& panel) { return panel.across.has_value(); };
  if (std::ranges::all_of(figure.panels, is_plane))
    for (Panel& panel : figure.panels)
      for (Curve& curve : panel.curves) cut_across(curve, from, to);
  for_each_series(figure, [&](const Series& series) { cut(series, from, to); });
  std::erase_if(figure.marks, [&](double t) { return t < from || t > to; });
}

void spread_jumps(Figure& figure, double width) {
  std::vector<double> moments;
  for_each_series(figure, [&](const Series& series) {
    if (series.jumps->size() <= moments.size()) return;
    moments.clear();
    for (const std::size_t k : *series.jumps) moments.push_back((*series.t)[k]);
  });
  for_each_series(figure, [&](const Series& series) { spread(series, width, moments); });
  figure.marks.clear();
}

bool rename(Figure& figure, const std::string& name, const std::string& other) {
  bool found = false;
  for_each_name(figure, [&](std::string& own) {
    if (own != name) return;
    own = other;
    found = true;
  });
  return found;
}

std::vector<std::string> names_in(const Figure& figure) {
  Figure copy = figure;
  std::vector<std::string> names;
  for_each_name(copy, [&](const std::string& name) {
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  });
  return names;
}

}  // namespace gainsmith::drawing
