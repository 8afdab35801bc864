#include "gainsmith/search_figure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "drawing/figure.h"

namespace gainsmith::app {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// How each verdict styles.
struct VerdictStyle {
  const char* word;
  const char* label;
  drawing::Mark mark;
  int colour;
  const char* fill;
};

constexpr std::array<VerdictStyle, 5> kStyles = {{
    {"yes", "feasible", drawing::Mark::dot, 2, "#8fd0b6"},
    {"no", "infeasible", drawing::Mark::cross, 1, "#e4e4e4"},
    {"undecided", "undecided", drawing::Mark::triangle, 4, "#fbf3df"},
    {"refused", "refused", drawing::Mark::ring, 7, "#ffffff"},
    {"interrupted", "interrupted", drawing::Mark::dot, 7, "#ffffff"},
}};

std::size_t style_of(const std::string& word) {
  return static_cast<std::size_t>(std::find_if(kStyles.begin(), kStyles.end(),
                                               [&](const auto& one) { return word == one.word; }) -
                                  kStyles.begin());
}

std::vector<std::optional<double>> quantities_of(const ScanPicture& picture,
                                                 const design::ScanRow& row) {
  std::vector<std::optional<double>> values;
  if (picture.has_objective) values.push_back(row.objective);
  values.insert(values.end(), row.figures.begin(), row.figures.end());
  values.resize(picture.quantities.size());
  for (auto& value : values)
    if (value && !std::isfinite(*value)) value.reset();
  return values;
}

/// A row for each verdict that occurs, with its marks.
drawing::Panel verdict_panel(const std::vector<double>& at, const std::vector<std::size_t>& styles) {
  drawing::Panel panel;
  panel.title = "verdict";
  for (std::size_t style = 0; style < kStyles.size(); ++style) {
    if (std::find(styles.begin(), styles.end(), style) == styles.end()) continue;
    drawing::Curve marks;
    marks.mark = kStyles[style].mark;
    marks.colour = kStyles[style].colour;
    marks.joined = false;
    for (std::size_t k = 0; k < at.size(); ++k) {
      if (styles[k] != style) continue;
      marks.t.push_back(at[k]);
      marks.value.push_back(static_cast<double>(panel.rows.size()));
    }
    panel.rows.emplace_back(kStyles[style].label);
    panel.curves.push_back(std::move(marks));
  }
  return panel;
}

/// Whether positive values span more than a linear axis shows.
bool is_wide(const std::vector<double>& values) {
  constexpr double kWide = 30;
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    least = std::min(least, value);
    most = std::max(most, value);
  }
  return least > 0 && most > kWide * least;
}

std::string scan_lines(const ScanPicture& picture, const std::vector<design::ScanRow>& rows) {
  drawing::Figure figure;
  figure.title = picture.title;
  figure.axis = picture.axes.front().name;
  figure.logarithmic = picture.axes.front().logarithmic;
  std::vector<double> at;
  std::vector<std::size_t> styles;
  for (const design::ScanRow& row : rows) {
    at.push_back(row.at.front());
    styles.push_back(style_of(verdict_of(row)));
  }
  for (std::size_t k = 0; k < picture.quantities.size(); ++k) {
    drawing::Curve curve;
    curve.t = at;
    curve.mark = drawing::Mark::dot;
    for (const design::ScanRow& row : rows)
      curve.value.push_back(quantities_of(picture, row)[k].value_or(kNone));
    drawing::Panel panel{picture.quantities[k], "", is_wide(curve.value), {std::move(curve)}};
    figure.panels.push_back(std::move(panel));
  }
  figure.panels.push_back(verdict_panel(at, styles));
  return drawing::svg(figure);
}

std::string scan_map(const ScanPicture& picture, const std::vector<design::ScanRow>& rows) {
  drawing::MapFigure figure{picture.title, picture.axes[0], picture.axes[1], {}, {}};
  for (const VerdictStyle& style : kStyles)
    figure.kinds.push_back({style.label, style.fill,
                            style.mark == drawing::Mark::dot ? drawing::Mark::none : style.mark});
  const std::size_t width = figure.across.values.size(), height = figure.up.values.size();
  const std::size_t maps = std::max<std::size_t>(1, picture.quantities.size());
  for (std::size_t k = 0; k < maps; ++k) {
    drawing::Map map;
    map.title = picture.quantities.empty() ? "verdict" : picture.quantities[k];
    for (std::size_t up = 0; up < height; ++up)
      for (std::size_t across = 0; across < width; ++across) {
        const design::ScanRow& row = rows[across * height + up];
        drawing::Cell cell{style_of(verdict_of(row)), std::nullopt};
        if (!picture.quantities.empty()) cell.value = quantities_of(picture, row)[k];
        map.cells.push_back(cell);
      }
    figure.maps.push_back(std::move(map));
  }
  return drawing::svg(figure);
}

/// From the outermost yes so far to the nearest no beyond it, a step a value tried.
drawing::Band bracket_of(const std::vector<search::Sample>& asked, bool largest) {
  const double sign = largest ? 1 : -1;
  drawing::Band band;
  band.label = "bracket so far";
  band.colour = 0;
  for (std::size_t k = 0; k < asked.size(); ++k) {
    double yes = -std::numeric_limits<double>::infinity();
    double no = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i <= k; ++i)
      if (asked[i].answer == search::Answer::yes) yes = std::max(yes, sign * asked[i].value);
    for (std::size_t i = 0; i <= k; ++i)
      if (asked[i].answer == search::Answer::no && sign * asked[i].value > yes)
        no = std::min(no, sign * asked[i].value);
    for (const std::size_t until : {k + 1, std::min(k + 2, asked.size())}) {
      band.t.push_back(static_cast<double>(until));
      band.low.push_back(largest ? yes : -no);
      band.high.push_back(largest ? no : -yes);
    }
  }
  return band;
}

/// The values that were tried, a curve of marks for each verdict.
void add_tried(const std::vector<search::Sample>& asked, const std::optional<double>& from,
               drawing::Panel& panel) {
  for (const VerdictStyle& style : kStyles) {
    drawing::Curve marks;
    marks.label = style.label;
    marks.mark = style.mark;
    marks.colour = style.colour;
    marks.joined = false;
    for (const search::Sample& sample : asked) {
      if (std::string(word_of(sample.answer)) != style.word) continue;
      marks.t.push_back(sample.order + 1);
      marks.value.push_back(from ? std::abs(sample.value - *from) : sample.value);
    }
    if (from) marks.label.clear();
    if (!marks.t.empty()) panel.curves.push_back(std::move(marks));
  }
}

}  // namespace

const char* word_of(search::Answer answer) {
  switch (answer) {
    case search::Answer::yes:
      return "yes";
    case search::Answer::no:
      return "no";
    case search::Answer::refused:
      return "refused";
    case search::Answer::undecided:
      break;
  }
  return "undecided";
}

std::string verdict_of(const design::ScanRow& row) {
  if (row.interrupted) return "interrupted";
  return row.refused.empty() ? to_string(row.verdict) : "refused";
}

std::string scan_figure(const ScanPicture& picture, const std::vector<design::ScanRow>& rows) {
  return picture.axes.size() == 1 ? scan_lines(picture, rows) : scan_map(picture, rows);
}

std::string bisect_figure(const std::string& title, const std::string& name,
                          const search::Bisection& found, const design::BisectChoices& choices) {
  std::vector<search::Sample> asked = found.samples;
  std::sort(asked.begin(), asked.end(),
            [](const auto& a, const auto& b) { return a.order < b.order; });
  drawing::Figure figure;
  figure.title = title;
  figure.axis = "value tried";
  drawing::Panel values;
  values.title = name;
  values.logarithmic = choices.scalar.axis.logarithmic;
  add_tried(asked, std::nullopt, values);
  values.bands.push_back(bracket_of(asked, choices.largest));
  figure.panels.push_back(std::move(values));
  if (found.yes) {
    drawing::Panel distances;
    distances.title = std::string("distance from the ") +
                      (choices.largest ? "largest" : "smallest") + " feasible value";
    distances.logarithmic = true;
    add_tried(asked, found.yes, distances);
    figure.panels.push_back(std::move(distances));
  }
  return drawing::svg(figure);
}

}  // namespace gainsmith::app
