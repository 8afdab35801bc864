// The layout of a figure: heights of panels, their axes, and what is drawn where.
//
// All panels have one left end, behind the widest labels. Those that are no planes share the axis
// below, whose labels are under the last of them.
#include "drawing/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "drawing/axis.h"
#include "drawing/drawing.h"
#include "drawing/legend.h"
#include "drawing/marks.h"
#include "drawing/panel.h"

namespace gainsmith::drawing {

namespace {

void check(const std::vector<double>& t, std::size_t values) {
  if (t.size() != values)
    throw std::logic_error(fmt::format("a curve with {} times and {} values", t.size(), values));
}

/// std::logic_error where a curve or a band has not one value for each time.
void check(const Figure& figure) {
  for (const Panel& panel : figure.panels) {
    for (const Curve& curve : panel.curves) check(curve.t, curve.value.size());
    for (const Band& band : panel.bands) {
      check(band.t, band.low.size());
      check(band.t, band.high.size());
    }
  }
}

/// Whether both axes are of quantities; bars are none in this sense.
bool is_plane(const Panel& panel) { return panel.across && !panel.bars; }

/// In pixels: lower the more panels there are, 24 a row of words, 440 for a plane.
double height_of(const Panel& panel, std::size_t panels) {
  constexpr double heights[] = {320, 220, 180, 150}, of_row = 24, of_plane = 440;
  if (!panel.rows.empty()) return of_row * static_cast<double>(panel.rows.size());
  return is_plane(panel) ? of_plane : heights[std::clamp<std::size_t>(panels, 1, 4) - 1];
}

bool has_marks(const Panel& panel) {
  return std::any_of(panel.curves.begin(), panel.curves.end(),
                     [](const Curve& curve) { return curve.mark != Mark::none; });
}

/// With fewer ticks where labels of all would not fit side by side.
Axis axis_below(const Extent& values, bool logarithmic, double margin, double room) {
  for (int most = 10;; --most) {
    Axis axis = close_axis(values, logarithmic, margin, most);
    if (most == 5 || static_cast<double>(axis.ticks.size()) * (label_width(axis) + 12) <= room)
      return axis;
  }
}

/// That of all panels but planes; marks at its ends are whole.
Axis time_axis(const Figure& figure, double room) {
  constexpr double margin_of_marks = 0.03;
  Axis shown;
  shown.logarithmic = figure.logarithmic;
  Extent times;
  times.whole = false;  // a duration may begin and end at whole numbers
  double margin_at_ends = 0;
  for (const Panel& panel : figure.panels) {
    if (panel.across) continue;
    if (has_marks(panel)) margin_at_ends = margin_of_marks;
    for (const Curve& curve : panel.curves)
      for (const double t : curve.t)
        if (shown.shows(t)) times.add(t);
    for (const Band& band : panel.bands)
      for (const double t : band.t)
        if (shown.shows(t)) times.add(t);
  }
  return axis_below(times, figure.logarithmic, margin_at_ends, room);
}

constexpr double kMarginAcross = 0.05, kMarginUp = 0.1;

/// What a plane shows of both quantities.
std::pair<Extent, Extent> extents_of(const Panel& plane) {
  std::pair<Extent, Extent> values;
  for (const Curve& curve : plane.curves)
    for (std::size_t k = 0; k < curve.t.size(); ++k)
      if (Axis().shows(curve.t[k]) && Axis().shows(curve.value[k])) {
        values.first.add(curve.t[k]);
        values.second.add(curve.value[k]);
      }
  return values;
}

/// As wide as `half` to both sides.
Extent widened(const Extent& values, double half) {
  if (values.empty()) return values;
  const double middle = (values.low + values.high) / 2;
  return {middle - half, middle + half, false};
}

/// Half the width of an axis that shows the values with this margin, in their unit.
double half_of(const Extent& values, double margin) {
  return (values.high - values.low) / 2 * (1 + margin);
}

/// Of a plane with equal units in a box of this form, what is shown of the vertical axis.
Extent equal_up(const Panel& plane, double height, double width) {
  const auto [across, up] = extents_of(plane);
  const double half =
      std::max(half_of(up, kMarginUp), half_of(across, kMarginAcross) * height / width);
  return widened(up, half / (1 + kMarginUp));
}

/// The horizontal axis of a plane. With equal units its half is that of the vertical one times
/// width / height.
Axis across_axis(const Panel& plane, const Axis& up, const Box& box) {
  Extent values = extents_of(plane).first;
  values.degrees = plane.degrees;
  if (plane.equal) {
    const double half = (up.high - up.low) / 2 * box.width / box.height;
    values = widened(values, half / (1 + kMarginAcross));
  }
  return axis_below(values, false, kMarginAcross, box.width);
}

/// With the bands, as far as they do not make the curves small.
Extent with_bands(const Panel& panel, const Axis& shown, const Extent& curves) {
  Extent all = curves;
  for (const Band& band : panel.bands)
    for (const std::vector<double>* ends : {&band.low, &band.high})
      for (const double value : *ends)
        if (shown.shows(value)) all.add(value);
  const double extent = curves.high - curves.low;
  if (curves.empty() || panel.logarithmic || !(extent > 0)) return all;
  all.low = std::max(all.low, curves.low - extent);
  all.high = std::min(all.high, curves.high + extent);
  return all;
}

/// The axis beside a panel, with a tick for about 22 pixels of its height, 5 to 10 in all.
Axis value_axis(const Panel& panel, double height, double width) {
  if (!panel.rows.empty()) return axis_of_rows(panel.rows);
  Axis shown;
  shown.logarithmic = panel.logarithmic;
  Extent values;
  for (const Curve& curve : panel.curves)
    for (std::size_t k = 0; k < curve.value.size(); ++k)
      if (shown.shows(curve.value[k]) && Axis().shows(curve.t[k])) values.add(curve.value[k]);
  if (!panel.bands.empty()) values = with_bands(panel, shown, values);
  if (panel.equal) values = equal_up(panel, height, width - 4 * right_margin);
  values.degrees = panel.degrees && !panel.across;
  const int most = std::clamp(static_cast<int>(height / 22), 5, 10);
  return panel.logarithmic ? logarithmic_axis(values, most) : linear_axis(values, kMarginUp, most);
}

/// The elements below the heading, and where they end, with panels of these heights.
std::pair<std::string, double> drawn_panels(const Figure& figure,
                                            const std::vector<double>& heights) {
  std::vector<Axis> values;
  // Pixels for labels, at least.
  double beside = 30;
  bool named = false;
  for (std::size_t k = 0; k < figure.panels.size(); ++k) {
    values.push_back(value_axis(figure.panels[k], heights[k], figure.width));
    beside = std::max(beside, label_width(values.back()));
    named = named || !figure.panels[k].axis.empty();
  }
  Box box{figure_margin + beside + (named ? axis_name_width : 0), figure_margin, 0, 0};
  box.width = figure.width - right_margin - box.left;
  const Axis time = time_axis(figure, box.width);
  std::string text;
  double y = figure_margin + (figure.title.empty() ? 0 : title_height);
  for (std::size_t k = 0; k < figure.panels.size(); ++k) {
    const Panel& panel = figure.panels[k];
    const Legend above = legend(panel, box.width);
    text += drawn(above, box.left, y);
    box.top = y + above.height;
    box.height = heights[k];
    const Axis below = panel.across ? across_axis(panel, values[k], box) : time;
    text += drawn(panel, below, values[k], box);
    if (!panel.across) text += marks(figure.marks, time, box);
    y = box.bottom() + figure_margin;
    const bool last = k + 1 == figure.panels.size();
    if (!panel.across && !last && !figure.panels[k + 1].across) continue;
    const std::string& name = panel.across ? *panel.across : figure.axis;
    text += drawn_below(below, name, box);
    y = box.bottom() + (name.empty() && below.factor == 0 ? 26 : 46);
  }
  return {std::move(text), y};
}

/// So that the figure has its height, but each panel 40 at least.
void fit(std::vector<double>& heights, double more) {
  constexpr double least = 40;
  double sum = 0;
  for (const double height : heights) sum += height;
  for (double& height : heights)
    if (sum > 0) height = std::max(least, height * (sum + more) / sum);
}

}  // namespace

std::string svg(const Figure& figure) {
  check(figure);
  const auto planes = static_cast<std::size_t>(
      std::count_if(figure.panels.begin(), figure.panels.end(),
                    [](const Panel& panel) { return is_plane(panel) || !panel.rows.empty(); }));
  std::vector<double> heights;
  for (const Panel& panel : figure.panels)
    heights.push_back(height_of(panel, figure.panels.size() - planes));
  // What is not panels has a height that is known only when it is drawn.
  auto [text, end] = drawn_panels(figure, heights);
  if (figure.height) {
    fit(heights, *figure.height - end);
    std::tie(text, end) = drawn_panels(figure, heights);
  }
  return head(figure.title, end, figure.width) + heading(figure.title, figure.width) + text +
         "</svg>\n";
}

}  // namespace gainsmith::drawing
