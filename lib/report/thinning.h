// Polylines with no more points than a picture can show.
#pragma once

#include <vector>

namespace gainsmith::report {

/// In tenths of a pixel: x to the right, y downwards.
struct Point {
  int x = 0;
  int y = 0;

  bool operator==(const Point&) const = default;
};

using Polyline = std::vector<Point>;

/// Lines one after the other, with x that does not decrease, thinned: of each column of pixels
/// stay its first, highest, lowest and last point, with up to two lines in it; more are joined.
/// So there are at most eight points a column, and each column keeps its extremes.
std::vector<Polyline> thinned(const std::vector<Polyline>& lines);

/// The line without the points that its others show to within a tenth of a pixel upwards or
/// downwards. Its ends and all local extremes stay.
Polyline straightened(const Polyline& line);

}  // namespace gainsmith::report
