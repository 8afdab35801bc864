// All roots of a function of time on a step: where it comes to be positive or ceases to be.
//
//   side(t) = g(t) > 0,  or g(t) >= 0
//
// g is interpolated at the Chebyshev points of an interval, which is halved until the interpolant
// agrees with g to 1e-13 of the largest |g| on the step or to rounding; across a corner of g the
// halves end at rounding. Of the interpolant every part is left out on which its coefficients
// exclude a root, and the rest is halved until it is monotone or has one extremum. There the sides
// of g itself decide, at the ends and at the extremum: so pairs of roots and touches are found down
// to the rounding of g, and no root is made up.
#pragma once

#include <functional>
#include <vector>

namespace gainsmith::ode {

/// side(left) != side(right), and not more than some units in the last place between them.
struct Root {
  double left = 0;
  double right = 0;
};

/// A turning point of g next to 0: a minimum of |g| without a root, or an extremum between two
/// roots.
struct TurningPoint {
  double t = 0;
  double value = 0;      ///< of g
  bool reached = false;  ///< between two roots, or a root itself
};

struct RootFunction {
  std::function<double(double)> value;  ///< g; deterministic
  bool strict = false;                  ///< side: > 0; otherwise >= 0
  double noise = 0;                     ///< how far rounding may lead g astray
  /// Turning points as near to 0 as that are reported; kTurnsNear of the largest |g| always.
  double near = 0;
};

struct Found {
  /// False: there may be more, for which kPatience points have not sufficed.
  bool whole = true;
  /// False: g was nowhere exactly 0 where it was evaluated, and both sides have these roots.
  bool meets_zero = false;
  std::vector<Root> roots;  ///< in rising order
  std::vector<TurningPoint> turning_points;
};

/// What `value` throws leaves it.
Found find_roots(const RootFunction& function, double from, double to);

/// A place where g is not smooth: it lies between two numbers that are next to each other, or
/// nearly.
struct Break : Root {
  bool jumps = false;  ///< otherwise a kink
};

/// The same of a g that is smooth between breaks, in rising order.
Found find_roots(const RootFunction& function, double from, double to,
                 const std::vector<Break>& breaks);

/// The points of [from, to] at which find_roots evaluates g first, in rising order; for callers
/// that keep values.
std::vector<double> first_points(double from, double to);

}  // namespace gainsmith::ode
