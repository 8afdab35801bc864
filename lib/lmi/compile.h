// From a method's inequalities to affine blocks  B(x) = B_0 + sum_i x_i B_i  that must be >= 0.
//
// "forall k in {..}" gives one block an element. Intervals and polytopes are imposed by one of two
// methods, which the plan names (forall/plan.h):
//   hull      one block a vertex of what contains the functions of the variables (forall/hull.h): B
//             is affine in them, so it is >= 0 on the whole domain if it is so at the vertices
//   exchange  one block a point of the plan, the variables over intervals being numbers there; the
//             plan grows until the worst point of the domain is good enough (forall/worst.h).
//             Polytopes have their vertices as in the hull.
// Inequalities that use unknown functions with one matrix for each vertex: see vertex_gains.h.
#pragma once

#include <vector>

#include "forall/plan.h"
#include "lmi/block.h"
#include "lmi/inequalities.h"

namespace gainsmith::lmi {

struct Lmi {
  std::vector<Block> blocks;
  int unknowns = 0;  ///< m, the number of scalars
  bool has_objective = false;
  std::vector<double> objective;  ///< c, m scalars, when has_objective
  double objective_constant = 0;

  /// Whether every block represents a point of its domain (Block::where), so that what excludes the
  /// blocks excludes the inequalities.
  bool represents_points() const;
  /// Of all blocks together.
  int rows() const;
  /// Multiplications of one step of a solver, up to a factor: those of the equations for x.
  double multiplications() const;
  /// c'x + c_0, when has_objective.
  double objective_at(const std::vector<double>& x) const;
};

/// Where the plan leaves the method open it is the hull when nothing is lost by it, and otherwise
/// an exchange with its first points; the plan is updated. InputError, with the place, for what is
/// not affine in the unknowns, a difference that is not symmetric or has no rows, what the hull
/// cannot take when it is asked for, or more than 2^12 vertices.
Lmi compile(const Inequalities& inequalities, forall::Plan& plan);
/// With the first points of the problem's own plan.
Lmi compile(const Inequalities& inequalities);

}  // namespace gainsmith::lmi
