// Certificates on the boundary of the cone, with the solution beside them.
//
// The homogenised inequalities B_k(x) = sum_i x_i B_ki >= 0 have a solution x and multipliers
// Y_k >= 0 with
//   r_i = sum_k <B_ki, Y_k> = 0        c_k = B_k(x) Y_k + Y_k B_k(x) = 0                        (1)
// and, as a rule, rank B_k(x) + rank Y_k = n_k (strict complementarity). Y alone is a root of
// second order of r; the pair is a simple one (Alizadeh, Haeberly & Overton 1998). Newton's step,
// in the basis [U, V] of B_k(x) = U Lambda U' + (nearly 0) and Y_k = V S V' + (nearly 0), has the
// unknowns dx and dS_k:
//   U'dY V = -Lambda^-1 (U'c V + U'B(dx)V S),   V'dY V = dS,   U'dY U = -(U'c U)_ab / (l_a + l_b)
//   [ -H  A' ] [dx]   [f]     H_ij = 2 sum_k tr(S V'B_i U Lambda^-1 U'B_j V),  A dx = V'B(dx)V  (2)
//   [  A  0  ] [dS] = [w]     w_ab = -(V'c V)_ab / (s_a + s_b)
// The solutions are manifolds (the two faces), so (2) is singular and consistent up to second
// order: it is solved with H + d I and d I in place of H and 0. Near the solution d is small and
// the step is refined; further off d is in proportion to the residual, and stays. Matrices of (2)
// are double; residuals (1) and the pair have 100 digits (Carson & Higham 2018): some ten digits a
// step.
//
// Beside the least violation s < 0 of inequalities with constant parts (formulate_violation) the
// same holds of B_k(x) - s I with x_0 fixed: its multiplier has no equation, and s is one more
// unknown, with the equation tr Y = 1.
//
// What comes of it is checked like any other multipliers (refutation.h).
#pragma once

#include <vector>

#include "verdict/exact.h"

namespace gainsmith::verdict {

/// In balanced units, of a size near 1 as far as they are not 0. `blocks` holds those of the
/// inequalities; with a constant part x_0 >= 0 is one of them, with y_0 = v its multiplier.
struct BoundaryPair {
  std::vector<Decimal100> x;  ///< x_0 (0 without a constant part), x_1, ..., x_m
  std::vector<numbers::MatrixOf<Decimal100>> Y;
  bool violated = false;  ///< x_0 is fixed, and s the last of x
};

/// Makes (1) hold to some 90 digits, and Y_k a product V S V' of few columns. False, and `pair` of
/// no use, where complementarity is not strict or the steps do not settle.
bool refine(const std::vector<const ExactBlock<Decimal100>*>& blocks, BoundaryPair& pair);

}  // namespace gainsmith::verdict
