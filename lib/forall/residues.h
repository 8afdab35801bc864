// The matrix exponential as a combination of scalar functions of tau.
//
// Source: G. Q. B. Tran, P. Bernard, L. Marconi, equation (42):
//   expm(F tau) = sum over real l, j of  R_lj e^{l tau} tau^j / j!
//     + sum over complex pairs l, j of  2 e^{Re l tau} (Re R_lj cos(Im l tau)
//                                                     - Im R_lj sin(Im l tau)) tau^j / j!
// with R_lj the residue of (s - l)^j inv(sI - F) at the eigenvalue l, j = 0, 1, ... below the
// multiplicity of l in the minimal polynomial.
//
// R_l0 is the spectral projector, found as a contour integral around l, and
// R_lj = (F - l I) R_l,j-1. Eigenvalues that rounding alone may have split are taken as one, their
// mean.
#pragma once

#include <utility>
#include <vector>

#include "forall/atoms.h"
#include "numbers/matrix.h"

namespace gainsmith::forall {

/// The functions and their coefficient matrices, which have the shape of F (square). Elements that
/// are rounding noise are 0. EvaluationError when the sum differs from expm(F tau) by more than
/// 1e-10 of its size at one of seven points of [low, high]: eigenvalues that are close but not
/// equal.
/// `low` and `high`: the interval of tau, in the unit of 1/F.
std::vector<std::pair<Atom, numbers::Matrix>> residue_expansion(const numbers::Matrix& F,
                                                                double low, double high);

}  // namespace gainsmith::forall
