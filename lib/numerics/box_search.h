// The largest value of a function over a box, as far as a search finds it.
//
//   value = f(point) <= max { f(x) : low <= x <= high }
//
// so it is an estimate from below, and exact at its point. f need not be smooth. What is tried:
//   1. the corners (of at most 12 coordinates that vary), the middle, the middles of the faces and
//      1024 evenly spread points for each coordinate, at most 16384 in all;
//   2. from the best of these that lie apart, on a line from the tops of up to 64 of them, the
//      simplex of Nelder and Mead within the box and steps along rotated axes, first coarsely; then
//      from the best three over lines of 65 points along the axes, and to rounding.
// A peak that is narrower than the points of 1. lie apart may be missed. The same function and box
// give the same bits.
#pragma once

#include <functional>

#include "numerics/matrix.h"

namespace gainsmith::numerics {

struct BoxPoint {
  Vector point;
  double value = 0;  ///< f(point)
};

/// low <= high, element by element. What `f` throws leaves the search.
BoxPoint largest_over_box(const std::function<double(const Vector&)>& f, const Vector& low,
                          const Vector& high);

}  // namespace gainsmith::numerics
