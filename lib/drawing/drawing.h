// Elements of an SVG picture.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "drawing/figure.h"
#include "drawing/thinning.h"

namespace gainsmith::drawing {

/// Sizes of fonts: of tick labels, legends and names of axes; of raised powers; of the titles of
/// panels and of the figure, both bold.
constexpr double label_size = 12, power_size = 9, panel_title_size = 13, title_size = 15;
constexpr double bold_widening = 1.1;  ///< of a bold text beside a plain one

/// Of a figure, and what is left free at its sides, below its title and for the name of an axis.
constexpr double figure_width = 900, figure_margin = 12, right_margin = 24, title_height = 28,
                 axis_name_width = 18;

/// The first elements of a figure of this size: the picture with its white ground.
std::string head(const std::string& title, double height, double width = figure_width);
/// The title at its top; nothing for an empty one.
std::string heading(const std::string& title, double width = figure_width);

/// How a curve looks.
struct Style {
  int colour = 0;
  bool dashed = false;
  bool short_lines = false;  ///< dashes that fit between many jumps
  bool beneath = false;      ///< wide and pale, under dashed ones
  bool limit = false;        ///< thin, in short dashes
  int turn = 0;              ///< of the dashed ones in a panel: where they agree, each is seen
  int turns = 1;
};

/// "#0072b2": the first eight as in figure.h, then others, no two alike; the first of a negative
/// number.
std::string colour_name(int colour);

/// Attributes of its lines.
std::string stroke(const Style& style);

/// Attributes of a band.
std::string shade(int colour);

/// How each curve of a panel looks.
std::vector<Style> styles_of(const Panel& panel);

/// A mark with its middle at a place; nothing for Mark::none.
std::string mark_at(Mark mark, double x, double y, int colour);

/// Tenths of a pixel as pixels: "12", "12.3".
std::string pixels(int tenths);
std::string pixels(double pixels);

/// "M12,3.4l1,2 3-4": a move to the first point, then lines by differences.
std::string path(const Polyline& line);

/// A text at its base line. `attributes`, such as a font size or an anchor, begin with a space.
std::string text_at(double x, double y, std::string_view utf8, std::string_view attributes);

}  // namespace gainsmith::drawing
