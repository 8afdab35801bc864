// Maps of a quantity over a grid: a cell for each point, coloured by its value or filled by its
// kind.
//
// The border of two neighbours is midway between them on the scale of the axis: at their geometric
// mean on a logarithmic one. The outer cells reach as far beyond their points.
#include "drawing/map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "drawing/axis.h"
#include "drawing/drawing.h"
#include "drawing/panel.h"
#include "drawing/text.h"
#include "drawing/trace.h"

namespace gainsmith::drawing {

namespace {

/// In pixels: a map, the scale of colours beside it and its distance, the head above the map.
constexpr double map_height = 340, bar_width = 16, to_bar = 16, head_of_map = 26;
/// Of a scalar; a map of more has cells below two pixels.
constexpr std::size_t most_values = 400;

/// Of viridis (Smith and van der Walt 2015): its lightness grows evenly.
constexpr std::array<std::array<double, 3>, 6> ramp = {
    {{68, 1, 84}, {65, 68, 135}, {42, 120, 142}, {34, 168, 132}, {122, 209, 81}, {253, 231, 37}}};

/// Linear between the six colours of the ramp; a share outside [0, 1] has the colour of its end.
std::string colour_at(double share) {
  const double at = std::clamp(share, 0.0, 1.0) * (ramp.size() - 1);
  const std::size_t k = std::min(static_cast<std::size_t>(at), ramp.size() - 2);
  const double rest = at - static_cast<double>(k);
  std::string text = "#";
  for (std::size_t c = 0; c < 3; ++c)
    text += fmt::format(
        "{:02x}", static_cast<int>(std::lround((1 - rest) * ramp[k][c] + rest * ramp[k + 1][c])));
  return text;
}

/// The values that are shown, and the boundaries between them as shares of the axis.
struct Columns {
  std::vector<std::size_t> shown;
  std::vector<double> borders;  ///< one more
  Axis axis;
};

Columns columns_of(const GridAxis& grid) {
  Columns columns;
  const std::size_t stride = (grid.values.size() + most_values - 1) / most_values;
  std::vector<double> at;  // on the scale of the axis
  for (std::size_t k = 0; k < grid.values.size(); k += stride) {
    columns.shown.push_back(k);
    at.push_back(grid.logarithmic ? std::log10(grid.values[k]) : grid.values[k]);
  }
  const auto value = [&](double place) { return grid.logarithmic ? std::pow(10, place) : place; };
  constexpr int most_ticks = 9;
  Extent ends;
  ends.whole = false;
  if (at.size() == 1) {
    ends.add(grid.values.front());
    columns.axis = close_axis(ends, grid.logarithmic, 0, most_ticks);
    columns.borders = {0, 1};
    return columns;
  }
  std::vector<double> borders = {at[0] - (at[1] - at[0]) / 2};
  for (std::size_t k = 1; k < at.size(); ++k) borders.push_back((at[k - 1] + at[k]) / 2);
  borders.push_back(at.back() + (at.back() - at[at.size() - 2]) / 2);
  ends.add(value(borders.front()));
  ends.add(value(borders.back()));
  columns.axis = close_axis(ends, grid.logarithmic, 0, most_ticks);
  for (const double border : borders)
    columns.borders.push_back((border - columns.axis.low) / (columns.axis.high - columns.axis.low));
  return columns;
}

/// The colours of the values of a map.
std::optional<Axis> scale_of(const Map& map) {
  // The ratio from which positive values are shown on a logarithmic scale.
  constexpr double wide = 30;
  constexpr int most_ticks = 8;
  Extent values;
  for (const Cell& cell : map.cells)
    if (cell.value) values.add(*cell.value);
  if (values.empty()) return std::nullopt;
  return close_axis(values, values.low > 0 && values.high > wide * values.low, 0, most_ticks);
}

/// Rectangles, neighbours in a row of one colour in one, and marks where cells have room for them.
std::string cells_of(const MapFigure& figure, const Map& map, const Columns& across,
                     const Columns& up, const std::optional<Axis>& scale, const Box& box) {
  // Pixels that a mark needs in both directions.
  constexpr double room = 12;
  std::string text, marks;
  const auto x = [&](std::size_t k) { return box.left + across.borders[k] * box.width; };
  const auto y = [&](std::size_t k) { return box.bottom() - up.borders[k] * box.height; };
  for (std::size_t row = 0; row < up.shown.size(); ++row) {
    std::string fill;
    std::size_t first = 0;
    const auto flush = [&](std::size_t end) {
      if (end > first && fill != "white")
        text += fmt::format("<path fill=\"{}\" d=\"M{},{}H{}V{}H{}z\"/>\n", fill, pixels(x(first)),
                            pixels(y(row)), pixels(x(end)), pixels(y(row + 1)), pixels(x(first)));
      first = end;
    };
    for (std::size_t k = 0; k < across.shown.size(); ++k) {
      const Cell& cell = map.cells[up.shown[row] * figure.across.values.size() + across.shown[k]];
      const CellKind& kind = figure.kinds.at(cell.kind);
      const std::string own = cell.value ? colour_at(scale->share(*cell.value)) : kind.fill;
      if (own != fill) flush(k);
      fill = own;
      if (!cell.value && x(k + 1) - x(k) >= room && y(row) - y(row + 1) >= room)
        marks += mark_at(kind.mark, (x(k) + x(k + 1)) / 2, (y(row) + y(row + 1)) / 2, 7);
    }
    flush(across.shown.size());
  }
  return "<g shape-rendering=\"crispEdges\">\n" + text + "</g>\n" + marks;
}

/// The scale of colours in 64 steps, the least value at the bottom.
std::string bar(const Axis& scale, const Box& box) {
  constexpr int steps = 64;
  std::string text = "<g shape-rendering=\"crispEdges\">\n";
  const double step = box.height / steps;
  for (int k = 0; k < steps; ++k)
    text += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n",
                        pixels(box.left), pixels(box.bottom() - (k + 1) * step), pixels(box.width),
                        pixels(step + 0.5), colour_at((k + 0.5) / steps));
  return text + "</g>\n" + drawn_beside(scale, box);
}

/// Title, and the kinds of the cells without a value.
std::string head_of(const MapFigure& figure, const Map& map, double left, double right, double y) {
  constexpr double swatch = 14, gap = 18;
  std::string text;
  std::vector<char> occurs(figure.kinds.size(), 0);
  for (const Cell& cell : map.cells)
    if (!cell.value) occurs.at(cell.kind) = 1;
  double x = right;
  for (std::size_t k = figure.kinds.size(); k-- > 0;) {
    if (occurs[k] == 0) continue;
    const CellKind& kind = figure.kinds[k];
    x -= text_width(kind.label, label_size);
    text += text_at(x, y + 13, kind.label, "");
    x -= swatch + 6;
    text += fmt::format(
        "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\" stroke=\"#b0b0b0\"/>\n",
        pixels(x), pixels(y + 2), pixels(swatch), pixels(swatch), kind.fill);
    text += mark_at(kind.mark, x + swatch / 2, y + 2 + swatch / 2, 7);
    x -= gap;
  }
  return text + text_at(left, y + 13.5,
                        shortened(map.title, panel_title_size * bold_widening, x - left),
                        fmt::format(R"( font-size="{}" font-weight="bold")", panel_title_size));
}

void check(const MapFigure& figure) {
  const std::size_t points = figure.across.values.size() * figure.up.values.size();
  for (const Map& map : figure.maps)
    if (points == 0 || map.cells.size() != points)
      throw std::logic_error(
          fmt::format("a map of {} points with {} cells", points, map.cells.size()));
}

}  // namespace

std::string svg(const MapFigure& figure) {
  check(figure);
  const Columns across = columns_of(figure.across), up = columns_of(figure.up);
  std::vector<std::optional<Axis>> scales;
  double beside_bar = 0;
  for (const Map& map : figure.maps) {
    scales.push_back(scale_of(map));
    if (scales.back()) beside_bar = std::max(beside_bar, label_width(*scales.back()));
  }
  Box box{figure_margin + axis_name_width + std::max(30.0, label_width(up.axis)), 0, 0, map_height};
  box.width = figure_width - right_margin - box.left -
              (beside_bar > 0 ? to_bar + bar_width + beside_bar : 0);
  std::string text = heading(figure.title);
  double y = figure_margin + (figure.title.empty() ? 0 : title_height);
  for (std::size_t k = 0; k < figure.maps.size(); ++k) {
    text += head_of(figure, figure.maps[k], box.left, box.right(), y);
    box.top = y + head_of_map;
    text += cells_of(figure, figure.maps[k], across, up, scales[k], box);
    text += framed(figure.up.name, up.axis, box);
    text += drawn_below(across.axis, figure.across.name, box);
    if (scales[k]) text += bar(*scales[k], {box.right() + to_bar, box.top, bar_width, box.height});
    y = box.bottom() + 50;
  }
  return head(figure.title, y) + text + "</svg>\n";
}

}  // namespace gainsmith::drawing
