// Eigenvalues of real matrices, and the equations of Riccati, whose solutions are spaces of
// eigenvectors. Results are computed in more digits than they have (numerics/working.h) and rounded
// once.
#pragma once

#include <stdexcept>

#include "numbers/matrix.h"

namespace gainsmith::numbers {

/// Nothing, and why.
struct NoSolution : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Of M, n x n: a row (real part, imaginary part) for each, the largest real part first, of equal
/// ones the smaller imaginary part, of a pair the positive one. A part that is nothing beside
/// |M| in the digits it is computed in is 0. M is balanced first (numerics/balance.h), so that
/// units that are powers of two do not matter.
///
/// NoSolution when the real Schur form (Eigen's) is not found, which no matrix is known for.
template <class Scalar>
MatrixOf<Scalar> real_eigenvalues(const MatrixOf<Scalar>& M);

enum class Riccati { continuous, discrete };

/// A n x n, B n x m, Q n x n, R m x m, S n x m, of Q and R the symmetric part counts. The X, n x n,
/// with
///   continuous   A'X + X A - (X B + S) R^-1 (X B + S)' + Q = 0
///   discrete     A'X A - X - (A'X B + S) (R + B'X B)^-1 (A'X B + S)' + Q = 0
/// for which A - B K is stable, with K = R^-1 (X B + S)', or (R + B'X B)^-1 (A'X B + S)'. X is
/// symmetric. R must be invertible; in the discrete case R or R + c B'B, with c the larger
/// 1-norm of Q and R.
///
/// With A - B R^-1 S', Q - S R^-1 S' and G = B R^-1 B' in the discrete case, and their Cayley
/// transform in the continuous one (Chu, Fan and Lin, Linear Algebra Appl. 396, 2005), by doubling:
///   W = I + G H,  A <- A W^-1 A,  G <- G + A W^-1 G A',  H <- H + A' H W^-1 A,   H -> X
/// which is 2^k steps of X <- A'X (I + G X)^-1 A + H from X = 0; where that does not lead to the
/// solution, from a multiple of I.
/// What is found is checked: its residual is rounding, A - B K is stable. Otherwise NoSolution,
/// with the mode that is not reached or not seen.
template <class Scalar>
MatrixOf<Scalar> stabilising_solution(Riccati equation, const MatrixOf<Scalar>& A,
                                      const MatrixOf<Scalar>& B, const MatrixOf<Scalar>& Q,
                                      const MatrixOf<Scalar>& R, const MatrixOf<Scalar>& S);

}  // namespace gainsmith::numbers
