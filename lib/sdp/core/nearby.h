// Programs whose equations lost their solutions Y to the rounding of their data.
#pragma once

#include "sdp/core/presolve.h"
#include "sdp/solution.h"
#include "sdp/solver.h"

namespace gainsmith::sdp {

/// Where F_i.Y = c_i holds for Y >= 0 only up to the rounding of the data, x of the primal runs
/// away to an optimum that has nothing to do with that before rounding, and no number of digits
/// helps. The tolerance leaves room for more. With a feasible centre x^, a weight w and S >= 0,
///   minimise c'x + w |x - a x^|_1  over x and a,   sum x_i F_i - F_0 - S >= 0,
/// has the dual
///   maximise (F_0 + S).Y,   |F_i.Y - c_i| <= w,   sum_i x^_i (F_i.Y - c_i) = 0,   Y >= 0,
/// both with interior points, and c'x - F_0.Y = S.Y - w |x - a x^|_1 at its optimum: with w and S
/// within the tolerance, a multiple S of a Y closes the gap, and all six errors of (x, Y) are
/// within the tolerance, unless x is too far from the ray of x^. A centre nearer to the runaway has
/// its x nearer, until rounding of the data shows.
///
/// That shows: x is feasible, and c'x' >= F_0.Y - w |x' - a x^|_1 for every feasible x' and any a.
///
/// Optimal by all six errors, or undecided with the cause; `iterations` go on.
Solution solve_nearby(const Problem& problem, const Presolved& presolved, const Options& options,
                      int& iterations);

/// From a `point` of the central path, about, whose x is feasible and the centre.
Solution solve_around(const Problem& problem, const Options& options, Point<DoubleDouble> point,
                      int& iterations);

}  // namespace gainsmith::sdp
