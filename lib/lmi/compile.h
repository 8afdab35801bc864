// From a method's inequalities to affine blocks  B(x) = B_0 + sum_i x_i B_i  that must be >= 0.
//
// "forall k in {..}" gives one block an element. Intervals and polytopes are imposed in one of two
// ways, which the plan names (plan.h):
//   hull      one block a vertex of what contains the functions of the variables (hull.h): B is
//             affine in them, so it is >= 0 on the whole domain if it is so at the vertices
//   exchange  one block a point of the plan, the variables over intervals being numbers there; the
//             plan grows until the worst point of the domain is good enough (worst.h). Polytopes
//             have their vertices as in the hull.
// Inequalities that use unknown functions with one matrix for each vertex: see vertex_gains.h.
#pragma once

#include <vector>

#include "lmi/block.h"
#include "lmi/plan.h"
#include "lmi/unknowns.h"
#include "model/instance.h"

namespace gainsmith::lmi {

struct Lmi {
  explicit Lmi(const model::Instance& instance) : unknowns(instance) {}

  Unknowns unknowns;
  std::vector<Block> blocks;
  bool has_objective = false;
  std::vector<double> objective;  ///< c, m scalars, when has_objective
  double objective_constant = 0;
};

/// Compiles an instance, which comes from with_vertex_gains. Where the plan leaves the way open it
/// is the hull when nothing is lost by it, and otherwise an exchange with its first points; the
/// plan is updated. InputError, with the place, for what is not affine in the unknowns, a
/// difference that is not symmetric or has no rows, an empty interval, what the hull cannot take
/// when it is asked for, or more than 2^12 vertices.
Lmi compile(const model::Instance& instance, Plan& plan);
/// With the first points of the problem's own plan.
Lmi compile(const model::Instance& instance);

}  // namespace gainsmith::lmi
