#include "drawing/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "drawing/text.h"
#include "drawing/trace.h"

namespace gainsmith::drawing {

namespace {

/// Okabe and Ito, the yellow left out: on white it is too light for a line.
constexpr std::array<std::string_view, 8> palette = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                     "#e69f00", "#56b4e9", "#000000", "#8a8a8a"};

/// The intensities of red, green and blue of a hue from 0 to 1, each from `low` to `high`.
std::string colour_of(double hue, double low, double high) {
  std::string text = "#";
  for (const double third : {0.0, 1.0, 2.0}) {
    const double turn = hue + third / 3;
    const double away = 6 * std::abs(turn - std::floor(turn) - 0.5);  // 3: its own hue
    const double share = std::clamp(away - 1, 0.0, 1.0);
    text += fmt::format("{:02x}", std::lround(255 * (low + share * (high - low))));
  }
  return text;
}

/// The length of a dash, in pixels.
constexpr int dash = 6;

/// Where the dashes of the next curve begin, and when dashes repeat: what is drawn later covers
/// half of those before at most.
struct Steps {
  int step = 0;
  int period = 0;
};

/// One: 6 on, 4 off. Two: each fills the gaps of the other. More: each begins 4 behind the one
/// before.
Steps steps_of(int turns) {
  if (turns < 2) return {0, dash + 4};
  return turns == 2 ? Steps{dash, 2 * dash} : Steps{4, 4 * turns};
}

}  // namespace

std::string head(const std::string& title, double height, double width) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
      "{1}\" "
      "font-family=\"Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif\" "
      "font-size=\"{2}\" "
      "fill=\"#202020\" role=\"img\" aria-label=\"{3}\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n",
      pixels(width), pixels(height), label_size, escaped(title));
}

std::string heading(const std::string& title, double width) {
  if (title.empty()) return {};
  return text_at(figure_margin, figure_margin + title_size,
                 shortened(title, bold_widening * title_size, width - 2 * figure_margin),
                 fmt::format(R"( font-size="{}" font-weight="bold")", title_size));
}

std::string colour_name(int colour) {
  constexpr int size = static_cast<int>(palette.size());
  if (colour < size) return std::string(palette[static_cast<std::size_t>(std::max(colour, 0))]);
  // Neighbours lie far apart in hue, by the golden section of the circle, and are dark, medium and
  // light in turn.
  constexpr double golden = 0.381966;
  constexpr std::array<std::pair<double, double>, 3> shades = {
      {{0.05, 0.55}, {0.25, 0.8}, {0.45, 0.85}}};
  const auto [low, high] = shades[static_cast<std::size_t>(colour % 3)];
  return colour_of(golden * (colour - size) + 0.9, low, high);
}

std::string stroke(const Style& style) {
  const char* width = style.beneath ? "3.4" : style.limit ? "1.1" : "1.6";
  std::string text =
      fmt::format(R"(fill="none" stroke="{}" stroke-width="{}")", colour_name(style.colour), width);
  if (style.beneath) text += R"( stroke-opacity="0.5")";
  if (style.limit || (style.dashed && style.short_lines)) {
    text += R"( stroke-dasharray="3 2")";
  } else if (style.dashed) {
    const auto [step, period] = steps_of(style.turns);
    text += fmt::format(R"( stroke-dasharray="{} {}")", dash, period - dash);
    if (style.turn > 0)
      text += fmt::format(R"( stroke-dashoffset="{}")", period - step * style.turn);
  }
  return text;
}

std::string shade(int colour) {
  return fmt::format(R"(fill="{}" fill-opacity="0.18")", colour_name(colour));
}

std::vector<Style> styles_of(const Panel& panel) {
  constexpr std::ptrdiff_t most_turns = 4;  // the gaps of more were too long
  const auto is_estimate = [](const Curve& curve) { return curve.dashed && !curve.limit; };
  const auto is_solid = [](const Curve& curve) { return !curve.dashed && !curve.limit; };
  const auto estimates = std::count_if(panel.curves.begin(), panel.curves.end(), is_estimate);
  const bool of_one = std::count_if(panel.curves.begin(), panel.curves.end(), is_solid) == 1;
  const int turns = !of_one || panel.across
                        ? 1
                        : static_cast<int>(std::clamp<std::ptrdiff_t>(estimates, 1, most_turns));
  std::vector<Style> styles;
  int turn = 0;
  for (const Curve& curve : panel.curves) {
    Style style{curve.colour, is_estimate(curve), curve.jumps.size() > single_jumps};
    style.limit = curve.limit;
    style.beneath = of_one && estimates > 0 && is_solid(curve);
    style.turns = turns;
    if (style.dashed) style.turn = turn++ % turns;
    styles.push_back(style);
  }
  return styles;
}

std::string mark_at(Mark mark, double x, double y, int colour) {
  const std::string name = colour_name(colour);
  const std::string at = pixels(x) + "," + pixels(y);
  switch (mark) {
    case Mark::dot:
      return fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"2.6\" fill=\"{}\"/>\n", pixels(x),
                         pixels(y), name);
    case Mark::ring:
      return fmt::format(
          "<circle cx=\"{}\" cy=\"{}\" r=\"3\" fill=\"white\" stroke=\"{}\" "
          "stroke-width=\"1.4\"/>\n",
          pixels(x), pixels(y), name);
    case Mark::cross:
      return fmt::format(
          "<path stroke=\"{}\" stroke-width=\"1.6\" d=\"M{}m-3,-3l6,6m0-6l-6,6\"/>\n", name, at);
    case Mark::triangle:
      return fmt::format(
          "<path fill=\"white\" stroke=\"{}\" stroke-width=\"1.4\" d=\"M{}m0-3.6l3.4,6h-6.8z\"/>\n",
          name, at);
    case Mark::none:
      break;
  }
  return {};
}

std::string pixels(int tenths) {
  const int size = std::abs(tenths);
  std::string text = (tenths < 0 ? "-" : "") + std::to_string(size / 10);
  if (size % 10 != 0) text += '.' + std::to_string(size % 10);
  return text;
}

std::string pixels(double pixels) {
  return drawing::pixels(static_cast<int>(std::lround(10 * pixels)));
}

/// Differences need fewer characters than places; a minus sign separates numbers by itself.
std::string path(const Polyline& line) {
  std::string text = "M" + pixels(line.front().x) + "," + pixels(line.front().y) + "l";
  for (std::size_t k = 1; k < line.size(); ++k) {
    const std::string across = pixels(line[k].x - line[k - 1].x);
    const std::string down = pixels(line[k].y - line[k - 1].y);
    if (k > 1 && across.front() != '-') text += ' ';
    text += across;
    if (down.front() != '-') text += ',';
    text += down;
  }
  return text;
}

std::string text_at(double x, double y, std::string_view utf8, std::string_view attributes) {
  return fmt::format("<text x=\"{}\" y=\"{}\"{}>{}</text>\n", pixels(x), pixels(y), attributes,
                     escaped(utf8));
}

}  // namespace gainsmith::drawing
