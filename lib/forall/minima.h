// Minima of a scalar function on an interval or a box: all of them that can be detected, not the
// best of a grid.
#pragma once

#include <functional>
#include <vector>

namespace gainsmith::forall {

/// f on an interval, with its derivative where it has one. f may have kinks as a smallest
/// eigenvalue has them: a minimum of smooth functions. Its local minima are then smooth points.
struct Curve {
  std::function<double(double)> value;
  std::function<double(double)> slope;
};

struct CurveMinimum {
  double at = 0;
  double value = 0;
};

/// The local minima on [low, high] from the left, ends included. The interval is halved until the
/// bend of each piece suggests that no minimum below the smallest value found hides in it; each
/// bracketed minimum is then refined to a root of the derivative. A search: what turns many times
/// between the first 49 points, which have different distances, can be missed (proof.h does not
/// miss it).
std::vector<CurveMinimum> local_minima(const Curve& curve, double low, double high);

struct BoxMinimum {
  std::vector<double> at;
  double value = 0;
};

/// Local minima on the box low_i <= t_i <= high_i, at least two variables, by descent from the
/// lowest 32 local minima of a grid, coordinate by coordinate; the smallest first. A search, not a
/// proof: a minimum between the points of the grid can be missed.
std::vector<BoxMinimum> local_minima(const std::function<double(const std::vector<double>&)>& value,
                                     const std::vector<double>& low,
                                     const std::vector<double>& high);

}  // namespace gainsmith::forall
