#include "report/drawing.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>

#include "report/text.h"

namespace gainsmith::report {

namespace {

/// Okabe and Ito, the yellow left out: on white it is too light for a line.
constexpr std::array<std::string_view, 8> palette = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                     "#e69f00", "#56b4e9", "#000000", "#8a8a8a"};

}  // namespace

std::string_view colour_name(int colour) {
  constexpr int size = static_cast<int>(palette.size());
  return palette[static_cast<std::size_t>((colour % size + size) % size)];
}

std::string stroke(const Style& style) {
  std::string text =
      fmt::format(R"(fill="none" stroke="{}" stroke-width="1.6")", colour_name(style.colour));
  if (style.dashed)
    text += style.short_lines ? R"( stroke-dasharray="3 2")" : R"( stroke-dasharray="6 3")";
  return text;
}

std::string pixels(int tenths) {
  const int size = std::abs(tenths);
  std::string text = (tenths < 0 ? "-" : "") + std::to_string(size / 10);
  if (size % 10 != 0) text += '.' + std::to_string(size % 10);
  return text;
}

std::string pixels(double pixels) {
  return report::pixels(static_cast<int>(std::lround(10 * pixels)));
}

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

}  // namespace gainsmith::report
