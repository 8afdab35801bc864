// Figures of signals over hybrid time, over a scalar, and in planes, as SVG pictures, alone or
// inside of a page.
//
// Hybrid time is (t, j): at a jump j grows while t stays, so a signal has two values at one t. A
// curve lists its samples in order and says between which of them a jump lies. A value v is at the
// share (v - low) / (high - low) of its axis, of logarithms on a logarithmic one. Places on the
// picture are in pixels, y downwards, rounded to tenths.
//
// figure lays out panels; panel, legend, band, marks and map draw their parts. axis and ticks
// choose ends and round numbers. trace and thinning make few points of many samples. arrange
// changes a figure before it is drawn; drawing and text hold elements of SVG, styles and widths.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gainsmith::drawing {

/// What is drawn at each sample.
enum class Mark { none, dot, ring, cross, triangle };

/// A signal: value[k] at the time t[k]. The times do not decrease. From sample k to k + 1 leads a
/// flow, drawn as a line, or a jump, drawn as a thin dotted vertical.
struct Curve {
  std::string label;  ///< in the legend; a curve without one is not in it
  std::vector<double> t;
  std::vector<double> value;       ///< as many as times; what is not finite leaves a gap
  std::vector<std::size_t> jumps;  ///< ascending; k says that a jump leads from sample k to k + 1
  bool dashed = false;             ///< an estimate, in the colour of what it estimates
  int colour = 0;  ///< blue, vermilion, green, purple, orange, sky blue, black, grey; then others
  Mark mark = Mark::none;
  bool joined = true;  ///< false: marks alone, without lines between the samples
  bool limit = false;  ///< what the curve of its colour must not pass: thin, in short dashes
};

/// What lies between two signals of the same times, such as x - 2 sigma and x + 2 sigma, shaded.
struct Band {
  std::string label;
  std::vector<double> t;
  std::vector<double> low, high;   ///< what is not finite leaves a gap
  std::vector<std::size_t> jumps;  ///< as of a curve
  int colour = 0;
};

/// One frame with its axes. Curves and bands share the value axis at the left.
struct Panel {
  std::string title;         ///< above the panel
  std::string axis;          ///< beside it: quantity and unit
  bool logarithmic = false;  ///< values that are not positive leave gaps then
  std::vector<Curve> curves;
  /// Behind the curves. The axis grows for them by the extent of the curves at most; what is beyond
  /// is cut off.
  std::vector<Band> bands{};
  /// Words instead of numbers at the axis, from the top: value k is in row k.
  std::vector<std::string> rows{};
  /// A plane: t of its curves is another quantity of this name, in any order, with an axis of its
  /// own. A dot is at the start of each joined curve, a ring at its end.
  std::optional<std::string> across{};
  /// Of a plane: at a place in it the rates of both quantities, drawn as arrows behind the curves.
  std::function<std::pair<double, double>(double across, double up)> field{};
  bool equal = false;    ///< of a plane: a unit is as long on both axes
  bool degrees = false;  ///< the values are, of a plane those across
  bool bars =
      false;  ///< a plane whose curves are outlines of bars: as high as other panels, no ends
};

/// Panels one above the other. Those that are no planes come first and share one axis.
struct Figure {
  std::string title;
  std::string axis;  ///< below: the time and its unit
  std::vector<Panel> panels;
  std::vector<double> marks{};  ///< moments with a tick in each panel; they do not decrease
  bool logarithmic = false;     ///< the axis below
  double width = 900;
  std::optional<double> height{};  ///< none: as the panels need
};

/// The figure in colours that colour-blind people tell apart (Okabe and Ito), on white. All texts
/// are UTF-8 and become well-formed XML, whatever they hold. The same figure gives the same bytes.
/// Curves are drawn to a tenth of a pixel: of dense ones each column of pixels shows the first,
/// least, greatest and last value, a few thousand points in all. Where estimates agree with the
/// only curve that is none, it shows below them as a wider line, and dashes of several take turns.
/// No ids and no style sheets, so that several figures fit in one page. std::logic_error for a
/// curve or band with as many values as times not.
std::string svg(const Figure& figure);

}  // namespace gainsmith::drawing
