// From a method's inequalities to affine blocks  B(x) = B_0 + sum_i x_i B_i  that must be >= 0.
//
// "forall k in {..}" gives one block an element. Intervals and polytopes are imposed in one of two
// ways, which the plan names (plan.h):
//   hull      one block a vertex of what contains the functions of the variables (hull.h): B is
//             affine in them, so it is >= 0 on the whole domain if it is so at the vertices
//   exchange  one block a point of the plan, the variables over intervals being numbers there; the
//             plan grows until the worst point of the domain is good enough (worst.h). Polytopes
//             have their vertices as in the hull.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lmi/affine.h"
#include "lmi/plan.h"
#include "lmi/unknowns.h"
#include "model/instance.h"

namespace gainsmith::lmi {

/// One symmetric block. `terms` are (i, B_i) in the order of i, with i = 0 the constant.
struct Block {
  std::string name;   ///< of the requirement, "name.2" for the second comparison of a chain
  std::string point;  ///< "tau = 0.7", "cos(2*tau) = 1"; empty without forall
  bool strict = true;
  int size = 0;
  std::vector<std::pair<int, Sparse>> terms;
  /// b: largest |element| of B_0; c: largest |element| of the other B_i.
  double constant_size = 0;
  double coefficient_size = 0;

  /// B(x), for m scalars x.
  expr::Matrix value(const std::vector<double>& x) const;
};

/// The smallest eigenvalue of the symmetric part.
double smallest_eigenvalue(const expr::Matrix& matrix);

struct Lmi {
  explicit Lmi(const model::Instance& instance) : unknowns(instance) {}

  Unknowns unknowns;
  std::vector<Block> blocks;
  bool has_objective = false;
  std::vector<double> objective;  ///< c, m scalars, when has_objective
  double objective_constant = 0;
};

/// Whether no block has a constant term: then x = 0 satisfies every inequality but for strictness.
bool is_homogeneous(const std::vector<Block>& blocks);

/// Compiles. Where the plan leaves the way open it is the hull when nothing is lost by it, and
/// otherwise an exchange with its first points; the plan is updated. InputError, with the place,
/// for what is not affine in the unknowns, a difference that is not symmetric, an empty interval,
/// what the hull cannot take when it is asked for, or more than 2^12 vertices.
Lmi compile(const model::Instance& instance, Plan& plan);
/// With the first points of the problem's own plan.
Lmi compile(const model::Instance& instance);

/// The affine form of a program, with the unknowns and the variables of the table.
AffineForm evaluate_affine(const expr::Program& program, const Unknowns& unknowns,
                           MonomialTable& monomials, const expr::Values& values);

/// The block of a symmetric affine form without monomials.
Block block_of(const AffineForm& form, std::string name, std::string point, bool strict,
               const Place& place);

}  // namespace gainsmith::lmi
