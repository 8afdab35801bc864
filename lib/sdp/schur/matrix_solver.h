// An interior-point method for programs in matrices, as far as it goes without the Schur
// complement. It serves programs with thousands of scalars in matrices. It decides nothing: the
// caller has to check its point.
//
// Nesterov and Todd's direction: with W S W = X the step in x solves
//   M dx = L*(X + R) - c,   M(v) = L*(W L(v) W),
// by conjugate gradients on products of matrices (Toh & Kojima 2002, Toh 2004), preconditioned in
// a basis of each unknown (matrix_preconditioner.h). S = C + L(x) holds to rounding whatever the
// conjugate gradients leave; only L*(X) = c is inexact. For a minimum, M is formed and factored
// (matrix_schur.h) from where its conjugate gradients would cost more.
#pragma once

#include <functional>
#include <vector>

#include "sdp/schur/matrix_program.h"
#include "sdp/solution.h"

namespace gainsmith::sdp {

struct MatrixOptions {
  /// Where to begin: S(start) > 0. Empty: from S = X, a multiple of I, which need not satisfy the
  /// equations.
  std::vector<double> start;
  /// Called with points that satisfy all inequalities strictly: true ends the solve.
  std::function<bool(const std::vector<double>& x)> enough;
  double tolerance = 1e-8;  ///< of X.S / (1 + |c'x|)
  int iteration_limit = 60;
};

/// The last point, with S in X and the multipliers in Y, blocks first and then each row as a block
/// of one element: `undecided` always, with the cause `enough`; `converged` when the gap is below
/// its tolerance, as far as L*(X) = c holds; or `stalled`. relative_gap is the gap; x may violate
/// inequalities only where the cause is `stalled`. Throws what base/stop.h says.
Solution solve(const MatrixProgram& program, const MatrixOptions& options);

}  // namespace gainsmith::sdp
