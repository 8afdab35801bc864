// Axes: which values they show, where, and what is beside them.
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace gainsmith::drawing {

/// The least and the greatest of some values.
struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  bool whole = true;     ///< all are whole numbers
  bool degrees = false;  ///< of an angle: labelled at parts and multiples of a turn

  bool empty() const { return low > high; }
  void add(double value);
};

/// A labelled place on an axis.
struct Tick {
  double share = 0;  ///< of the axis, from its low end
  std::string text;
  std::string power;  ///< raised behind the text
};

/// A scale from low to high, linear or of decimal logarithms, with its labels.
struct Axis {
  bool logarithmic = false;
  double low = 0;  ///< ends; of a logarithmic axis their decimal logarithms
  double high = 1;
  std::vector<Tick> ticks;
  std::vector<double> between;  ///< shares of the lines without label
  int factor = 0;               ///< what the labels say is to be multiplied by 10^factor

  bool shows(double value) const;    ///< is it finite, and positive on a logarithmic axis?
  double share(double value) const;  ///< 0 at the low end, 1 at the high end, of a value shown
};

/// The values and a margin at both ends, as a share of their half; with at most `most` >= 5 ticks.
/// A single value is in the middle, and what differs in its last digits alone appears constant:
/// the ends differ by 1e-10 of their size and by 2e-300 at least. Whole numbers, such as modes, are
/// labelled with whole numbers. Without values: from 0 to 1.
Axis linear_axis(const Extent& values, double margin, int most);

/// The same with a logarithmic axis where it is wanted: its ends are those of the values too, not
/// whole decades. Powers of ten are labelled, or 1, 2 and 5 times them where fewer than three fit.
Axis close_axis(const Extent& values, bool logarithmic, double margin, int most);

/// Whole decades that hold the positive values, labelled with at most `most` >= 5 powers of ten.
Axis logarithmic_axis(const Extent& values, int most);

}  // namespace gainsmith::drawing
