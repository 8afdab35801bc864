// Whether a symmetric matrix that is known within bounds is positive definite, in any units.
//
// The proof of M > 0 is a floating-point Cholesky factorisation of a slightly smaller matrix, whose
// rounding is bounded beforehand. The proof of the opposite is one vector v, with v'Mv <= 0 in ball
// arithmetic. Both are theorems on every matrix within the bounds.
#pragma once

#include "numbers/types/enclosed.h"

namespace gainsmith::numbers {

/// What holds for every matrix M within the bounds.
enum class Sign {
  positive,      ///< v'Mv > 0 for all v != 0
  not_positive,  ///< v'Mv <= 0 for some v != 0: M > 0 is false
  negative,      ///< v'Mv < 0 for some v: M >= 0 is false too
  open           ///< not known: more digits, or a smaller piece
};

struct Definite {
  Sign sign = Sign::open;
  Vector direction;  ///< v, where the sign is not_positive or negative
};

/// Of the symmetric part of M. With D = diag(4^k) near diag(M) and rho the largest row sum of
/// D^-1/2 rad D^-1/2: when the Cholesky factorisation of
///   D^-1/2 M D^-1/2 - (rho + 2 (n+2)^2 u) I
/// runs to its end, M > 0 (Demmel 1989; Rump, Verification of positive definiteness, 2006). Other
/// units that are powers of two give the same answer. An empty matrix is positive.
template <class S>
Definite definite(const Enclosed<S>& M);

/// The same of M + F for every |F| <= `more` element by element: whether all of them are positive
/// definite.
template <class S>
bool is_positive_definite(const Enclosed<S>& M, const Matrix& more);

/// The smallest eigenvalue of D^-1/2 M D^-1/2, D = diag(M): in (0, 1] when M > 0, the same in all
/// units, and 1 for 1 x 1. With a diagonal element that is not > 0: 0 when the least is 0, else -1.
/// NaN for a matrix that is not finite; 1 for an empty one.
double margin(const Matrix& M);

}  // namespace gainsmith::numbers
