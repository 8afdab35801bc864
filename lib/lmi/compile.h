// From a method's inequalities to affine blocks  B(x) = B_0 + sum_i x_i B_i  that must be >= 0.
//
// "forall tau in {..}" gives one block a point. "forall tau in [a, b]" gives one block a vertex of
// the box of the ranges of the atoms that stand in the inequality (atoms.h): B is affine in the
// atoms, so it is >= 0 on the whole interval if it is so at the vertices. With one monotone atom
// the vertices are the ends of the interval and nothing is lost.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lmi/affine.h"
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

/// Compiles. InputError, with the place, for what is not affine in the unknowns, a difference that
/// is not symmetric, an empty interval, or more than 2^12 vertices.
Lmi compile(const model::Instance& instance);

/// The affine form of a program, with the unknowns, and tau (if named) as variable of the atoms.
AffineForm evaluate_affine(const expr::Program& program, const Unknowns& unknowns, AtomTable& atoms,
                           const expr::Values& values, const std::string& interval_variable);

/// The block of a symmetric affine form without atoms.
Block block_of(const AffineForm& form, std::string name, std::string point, bool strict,
               const Place& place);

}  // namespace gainsmith::lmi
