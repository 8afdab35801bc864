#include "report/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "report/axis.h"
#include "report/drawing.h"
#include "report/legend.h"
#include "report/marks.h"
#include "report/panel.h"
#include "report/text.h"

namespace gainsmith::report {

namespace {

constexpr double figure_width = 900, margin = 12, right_margin = 24;
constexpr double title_height = 28, axis_name = 18;

void check(const Figure& figure) {
  for (const Panel& panel : figure.panels)
    for (const Curve& curve : panel.curves)
      if (curve.t.size() != curve.value.size())
        throw std::logic_error(
            fmt::format("a curve with {} times and {} values", curve.t.size(), curve.value.size()));
}

double height_of_panels(std::size_t panels) {
  constexpr double heights[] = {320, 220, 180, 150};
  return heights[std::clamp<std::size_t>(panels, 1, 4) - 1];
}

/// With fewer ticks where labels of all would not fit side by side.
Axis time_axis(const Figure& figure, double room) {
  Extent times;
  times.whole = false;  // a duration may begin and end at whole numbers
  for (const Panel& panel : figure.panels)
    for (const Curve& curve : panel.curves)
      for (const double t : curve.t)
        if (Axis().shows(t)) times.add(t);
  for (int most = 10;; --most) {
    Axis axis = linear_axis(times, 0, most);
    if (most == 5 || static_cast<double>(axis.ticks.size()) * (label_width(axis) + 12) <= room)
      return axis;
  }
}

Axis value_axis(const Panel& panel, double height) {
  Axis shown;
  shown.logarithmic = panel.logarithmic;
  Extent values;
  for (const Curve& curve : panel.curves)
    for (std::size_t k = 0; k < curve.value.size(); ++k)
      if (shown.shows(curve.value[k]) && Axis().shows(curve.t[k])) values.add(curve.value[k]);
  const int most = std::clamp(static_cast<int>(height / 22), 5, 10);
  return panel.logarithmic ? logarithmic_axis(values, most) : linear_axis(values, 0.1, most);
}

std::string head(const Figure& figure, double height) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
      "{1}\" "
      "font-family=\"Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif\" "
      "font-size=\"{2}\" "
      "fill=\"#202020\" role=\"img\" aria-label=\"{3}\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n",
      figure_width, pixels(height), label_size, escaped(figure.title));
}

}  // namespace

std::string svg(const Figure& figure) {
  check(figure);
  const double height = height_of_panels(figure.panels.size());
  std::vector<Axis> values;
  double beside = 30;
  bool named = false;
  for (const Panel& panel : figure.panels) {
    values.push_back(value_axis(panel, height));
    beside = std::max(beside, label_width(values.back()));
    named = named || !panel.axis.empty();
  }
  Box box{margin + beside + (named ? axis_name : 0), margin, 0, height};
  box.width = figure_width - right_margin - box.left;
  const Axis time = time_axis(figure, box.width);

  std::string text;
  double y = margin;
  if (!figure.title.empty()) {
    text += text_at(margin, y + title_size,
                    shortened(figure.title, bold_widening * title_size, figure_width - 2 * margin),
                    fmt::format(R"( font-size="{}" font-weight="bold")", title_size));
    y += title_height;
  }
  for (std::size_t k = 0; k < figure.panels.size(); ++k) {
    const Legend above = legend(figure.panels[k], box.width);
    text += drawn(above, box.left, y);
    box.top = y + above.height;
    text += drawn(figure.panels[k], time, values[k], box) + marks(figure.marks, time, box);
    y = box.bottom() + margin;
  }
  if (!figure.panels.empty()) {
    text += drawn_below(time, figure.axis, box);
    y = box.bottom() + (figure.axis.empty() && time.factor == 0 ? 26 : 46);
  }
  return head(figure, y) + text + "</svg>\n";
}

}  // namespace gainsmith::report
