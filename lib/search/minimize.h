// The smallest value of a function of a few scalars over a box, without derivatives.
//
// First the cells of a deterministic grid are tried at their middles; then local searches start
// from the best cells. A point where the function has no value (the design is infeasible there) is
// worse than every point where it has one. Where no cell has a value, the violation, when it is
// given, is minimised until a point has one.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "search/axis.h"
#include "search/optimizers.h"

namespace gainsmith::search {

using Point = std::vector<double>;

/// The value at a point; none where it is infeasible. Called from several threads at once.
using Figure = std::function<std::optional<double>(const Point&)>;

struct MinimizeOptions {
  int evaluations = 200;      ///< of the figure, at most
  double tolerance = 1e-5;    ///< of the point, in fractions of the axes
  unsigned threads = 1;       ///< of the grid; the result does not depend on it
  std::vector<Point> starts;  ///< tried besides the grid
  /// The figure as the local searches ask for it, one point after the other: the best value so far
  /// may make it cheaper. Without it they use the figure itself.
  std::function<std::optional<double>(const Point&, double best)> warm;
  /// How far a point is from feasible, >= 0, infinite when that is not known; called from several
  /// threads at once, but not unless the grid has no feasible point.
  std::function<double(const Point&)> violation;
};

struct Minimum {
  std::optional<Point> point;  ///< none when no point was feasible
  double value = 0;            ///< at `point`
  int evaluations = 0;
  int feasible = 0;       ///< of the evaluations
  bool finished = false;  ///< not stopped
};

/// Minimises over the box of the axes. `local` is the local search. Deterministic for any number of
/// threads. A stop (base/stop.h) ends it with what was found.
Minimum minimize(const Figure& figure, const std::vector<Axis>& axes, const LocalSearch& local,
                 const MinimizeOptions& options);

}  // namespace gainsmith::search
