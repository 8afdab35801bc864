// Multipliers without a residual, near those of a solver.
//
//   r_i(Y) = sum_k <B_ki, Y_k> = 0
//
// by Newton's method on factors Y_k = L_k L_k', with the smallest change of the factors: with
// G lambda = r, G_ij = sum_k tr(B_ki Y_k B_kj),
//   L_k <- L_k - 1/2 sum_i lambda_i B_ki L_k.
// Y_k stays >= 0 and of its rank, and the residual is squared in each step. So a certificate on the
// boundary of the cone, which the solver knows to as many digits as it computed with, is known to
// as many as one likes. What comes of it is checked like any other multipliers (refutation.h).
//
// Where every certificate is singular (a real eigenvalue of an unstable A: Y = v v' alone), what a
// solver leaves beside its range is a root of higher order, to which these steps lead slowly.
// Multipliers of the right rank have more equations than unknowns, which are consistent: G + mu I
// with mu = |r|^1.5 leads to them whether or not they determine the factors (Levenberg & Marquardt;
// Fan & Yuan 2005).
//
// To a double root every step covers half of the distance; every second one is twice as long
// (Decker, Keller & Kelley 1983). Multipliers of full rank have one where every certificate is 0 in
// some direction w of a block: the equation w' Y w = 0 is |L' w|^2 = 0.
#pragma once

#include <vector>

#include "base/scalars.h"
#include "verdict/exact.h"

namespace gainsmith::verdict {

/// A block and a factor of its multiplier L L', in balanced units.
struct FactoredMultiplier {
  const ExactBlock<Decimal100>* block = nullptr;
  numbers::MatrixOf<Decimal100> L;

  numbers::MatrixOf<Decimal100> value() const;
};

/// L with L L' = Y but for what a Cholesky factorisation with pivoting finds not above `least`.
numbers::MatrixOf<Decimal100> factor_above(const numbers::MatrixOf<Decimal100>& Y, double least);

/// Makes r_i = 0 for 1 <= i <= unknowns, and r_0 = 0 where it is not clearly below 0. False, and
/// `multipliers` of no use, when the steps are not small or do not settle.
bool refine(std::vector<FactoredMultiplier>& multipliers, int unknowns);

/// The same with the equations of a step in double, where they determine it to a few digits at
/// least; only the residuals have 100 (Carson & Higham 2018).
bool refine_in_double(std::vector<FactoredMultiplier>& multipliers, int unknowns);

/// The same where the factors have as many columns as a certificate has ranks, and no more.
bool refine_on_range(std::vector<FactoredMultiplier>& multipliers, int unknowns);

}  // namespace gainsmith::verdict
