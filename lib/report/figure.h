// Figures of signals over hybrid time, as SVG pictures that stand alone or inside of a page.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace gainsmith::report {

/// A signal: value[k] at the time t[k]. The times do not decrease. From sample k to k + 1 leads a
/// flow, drawn as a line, or a jump, drawn as a thin dotted vertical.
struct Curve {
  std::string label;  ///< in the legend; a curve without one is not in it
  std::vector<double> t;
  std::vector<double> value;       ///< as many as times; what is not finite leaves a gap
  std::vector<std::size_t> jumps;  ///< ascending; k says that a jump leads from sample k to k + 1
  bool dashed = false;             ///< an estimate, in the colour of what it estimates
  int colour =
      0;  ///< 0 to 7: blue, vermilion, green, purple, orange, sky blue, black, grey; they repeat
};

struct Panel {
  std::string title;         ///< above the panel
  std::string axis;          ///< beside it: quantity and unit
  bool logarithmic = false;  ///< values that are not positive leave gaps then
  std::vector<Curve> curves;
};

/// Panels one above the other with one time axis.
struct Figure {
  std::string title;
  std::string axis;  ///< below: the time and its unit
  std::vector<Panel> panels;
  std::vector<double> marks{};  ///< moments with a tick in each panel; they do not decrease
};

/// The figure, 900 wide and as high as its panels need, in colours that colour-blind people tell
/// apart (Okabe and Ito), on white. All texts are UTF-8 and become well-formed XML, whatever they
/// hold. The same figure gives the same bytes. Curves are drawn to a tenth of a pixel: of dense
/// ones each column of pixels shows the first, least, greatest and last value, a few thousand
/// points in all. No ids and no style sheets, so that several figures fit in one page.
/// std::logic_error for a curve with as many values as times not.
std::string svg(const Figure& figure);

}  // namespace gainsmith::report
