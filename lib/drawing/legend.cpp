#include "drawing/legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "drawing/drawing.h"
#include "drawing/text.h"

namespace gainsmith::drawing {

namespace {

/// In pixels: a row, the line of an entry, from it to its label, from there to the next entry.
constexpr double row_height = 18, sample_width = 24, to_label = 6, to_next = 18;

/// Line and label, in pixels.
double width_of(const LegendEntry& entry) {
  return sample_width + to_label + text_width(entry.label, label_size);
}

/// Whether no line joins two of its samples.
bool is_dotted(const Curve& curve) {
  for (std::size_t k = 0; k + 1 < curve.t.size(); ++k)
    if (std::isfinite(curve.value[k]) && std::isfinite(curve.value[k + 1]) &&
        !std::ranges::binary_search(curve.jumps, k))
      return false;
  return true;
}

/// What the entry looks like on the panel.
std::string sample_of(const LegendEntry& entry, double x, double y) {
  if (entry.curve == nullptr)
    return fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"10\" {}/>\n", pixels(x),
                       pixels(y - 5), pixels(sample_width), shade(entry.style.colour));
  std::string text;
  if (entry.curve->joined && is_dotted(*entry.curve))
    text += mark_at(Mark::dot, x + sample_width / 2, y, entry.style.colour);
  else if (entry.curve->joined)
    text += fmt::format("<path {} d=\"M{},{}h{}\"/>\n", stroke(entry.style), pixels(x), pixels(y),
                        pixels(sample_width));
  return text + mark_at(entry.curve->mark, x + sample_width / 2, y, entry.curve->colour);
}

/// Entries into rows from left to right; the middle of the first row at y. The last row_height's
/// middle.
double fill_rows(double y, double width, std::vector<LegendEntry>& entries) {
  double x = 0;
  for (LegendEntry& entry : entries) {
    if (x > 0 && x + width_of(entry) > width) {
      x = 0;
      y += row_height;
    }
    entry.x = x;
    entry.y = y;
    x += width_of(entry) + to_next;
  }
  return y;
}

}  // namespace

Legend legend(const Panel& panel, double width) {
  Legend made;
  made.title = shortened(panel.title, panel_title_size * bold_widening, width);
  double total = 0;
  const auto add = [&](const std::string& label, const Curve* curve, const Style& style) {
    if (label.empty()) return;
    const double room = width - sample_width - to_label;
    made.entries.push_back({0, 0, shortened(label, label_size, room), curve, style});
    total += width_of(made.entries.back()) + to_next;
  };
  const std::vector<Style> styles = styles_of(panel);
  for (std::size_t k = 0; k < panel.curves.size(); ++k) {
    Style style = styles[k];
    style.short_lines = false;
    style.turn = 0;
    style.turns = 1;
    add(panel.curves[k].label, &panel.curves[k], style);
  }
  for (const Band& band : panel.bands) add(band.label, nullptr, {band.colour});
  const double beside =
      made.title.empty() ? 0 : text_width(made.title, panel_title_size * bold_widening) + to_next;
  // Behind the last entry no distance is needed.
  const bool one_row = total - to_next + beside <= width;
  double last = fill_rows(row_height / 2 + (one_row || made.title.empty() ? 0 : row_height), width,
                          made.entries);
  if (one_row)
    for (LegendEntry& entry : made.entries) entry.x += width - total + to_next;
  if (made.entries.empty()) last = row_height / 2;
  made.height = last + row_height / 2 + 4;
  return made;
}

std::string drawn(const Legend& legend, double left, double top) {
  std::string text;
  if (!legend.title.empty())
    text += text_at(left, top + row_height / 2 + 4.5, legend.title,
                    fmt::format(R"( font-size="{}" font-weight="bold")", panel_title_size));
  for (const LegendEntry& entry : legend.entries) {
    const double x = left + entry.x, y = top + entry.y;
    text += sample_of(entry, x, y);
    text += text_at(x + sample_width + to_label, y + 4, entry.label, "");
  }
  return text;
}

}  // namespace gainsmith::drawing
