// Elements of an SVG picture.
#pragma once

#include <string>
#include <string_view>

#include "report/thinning.h"

namespace gainsmith::report {

/// Sizes of fonts: of tick labels, legends and names of axes; of raised powers; of the titles of
/// panels and of the figure, both bold.
constexpr double label_size = 12, power_size = 9, panel_title_size = 13, title_size = 15;
constexpr double bold_widening = 1.1;  ///< of a bold text beside a plain one

/// How a curve looks.
struct Style {
  int colour = 0;
  bool dashed = false;
  bool short_lines = false;  ///< dashes that fit between many jumps
};

/// "#0072b2"
std::string_view colour_name(int colour);

/// Attributes of its lines.
std::string stroke(const Style& style);

/// Tenths of a pixel as pixels: "12", "12.3".
std::string pixels(int tenths);
std::string pixels(double pixels);

/// "M12,3.4l1,2 3-4": a move to the first point, then lines by differences.
std::string path(const Polyline& line);

/// A text at its base line. `attributes`, such as a font size or an anchor, begin with a space.
std::string text_at(double x, double y, std::string_view utf8, std::string_view attributes);

}  // namespace gainsmith::report
