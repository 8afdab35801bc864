// Polylines with no more points than a picture can show.
#pragma once

#include <vector>

namespace gainsmith::drawing {

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

/// What a picture may be off, in tenths of a pixel.
constexpr double kShown = 2;

/// The line with few of its points that show it to within `tolerance` tenths of a pixel (Douglas
/// and Peucker 1973), in pieces of 1,000: the time grows with the square of a piece. Its ends stay.
Polyline coarser(const Polyline& line, double tolerance = kShown);

/// Of a line in any direction the points without which the others would not show it to within 0.3
/// pixels, its ends always: those nearer than 0.2 pixels to the one before are left out first, then
/// those within 0.1 of what the others show. Where more than 20,000 are left, those nearer than a
/// pixel to the one before are left out, and what passes where it has passed before: parts of
/// 50,000 points at most are left.
std::vector<Polyline> simplified(const Polyline& line);

}  // namespace gainsmith::drawing
