// Level curves of a function in the plane.
#pragma once

#include <functional>
#include <vector>

namespace gainsmith::app {

struct PlanePoint {
  double x = 0;
  double y = 0;
};

/// A rectangle in the plane.
struct Window {
  PlanePoint low, high;
};

struct LevelCurves {
  std::vector<std::vector<PlanePoint>>
      curves;           ///< each at least two points; a closed one ends where it begins
  bool inside = false;  ///< there are some, and none leaves the window
};

/// Where f changes its sign in the window, by straight pieces in the cells of a grid of 160 x 160
/// ("marching squares"): two curves that cross a cell in opposite corners are joined as the value in
/// its middle says. Points where f is not finite have no curve beside them.
LevelCurves zero_curves(const std::function<double(double, double)>& f, const Window& window);

}  // namespace gainsmith::app
