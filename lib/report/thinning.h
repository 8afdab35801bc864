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
/// stay its first, highest, lowest and last point. Of several lines in it the first and the last
/// are thinned so, those between become short lines from their lowest to their highest point,
/// those within two pixels of each other one. At most 16 points stay of a column, 4 of one line.
std::vector<Polyline> thinned(const std::vector<Polyline>& lines);

/// The line without the points that its others show to within a tenth of a pixel upwards or
/// downwards. Its ends and all local extremes stay.
Polyline straightened(const Polyline& line);

}  // namespace gainsmith::report
