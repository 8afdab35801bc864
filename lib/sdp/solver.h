// The primal-dual interior-point solver for semidefinite programs in the form of problem.h.
//
// With A*(x) = sum_i x_i F_i and A(Y)_i = F_i . Y the optimality conditions are
//   X = A*(x) - F_0 >= 0,   A(Y) = c,   Y >= 0,   X Y = 0.
// Newton's method follows X Y = mu I, mu -> 0, in the HKM direction (newton.h), with Mehrotra's
// predictor and corrector (ipm.h). It works on the problem at a fixed tau first, from a far point.
// The homogeneous self-dual model runs where no solution is in sight. Double comes first; 31 and
// 100 digits follow where they are affordable. A result is called optimal or infeasible only by
// measures that are recomputed from the raw data (report.h).
//
// The files of this room:
//   problem, solution, sdpa_file, solution_file   programs, results and their texts
//   presolve, layout, linalg, data                the working problem, its scaling, A and A*
//   iterate, residuals, ipm                       the point, its errors, the iteration
//   newton, schur, mixed_schur, sparse_schur      Newton's equations and their matrix B
//   factor, extreme, kernels, product, pairs      factors, step lengths, dense linear algebra
//   exposure, face                                programs whose Y have no interior
//   nearby                                        programs that rounding of the data spoiled
//   matrix_*                                      programs whose variables are matrices
//   report, forecast, work                        measures, memory, the count of operations
#pragma once

#include <functional>
#include <string>

#include "sdp/problem.h"
#include "sdp/solution.h"

namespace gainsmith::sdp {

/// One line of the progress table: the point before an iteration, in terms of the problem as given.
/// Infeasibilities and the gap are those of residuals.h.
struct Progress {
  int iteration = 0;
  std::string precision;        ///< the arithmetic of this iteration
  double primal_objective = 0;  ///< c'x
  double dual_objective = 0;    ///< F_0.Y
  double relative_gap = 0;
  double primal_infeasibility = 0;
  double dual_infeasibility = 0;
  double step_primal = 0;  ///< of (x, X), the step that led here, from 0 to 1
  double step_dual = 0;    ///< of Y, the same
};

struct Options {
  double tolerance = 1e-8;              ///< relative gap and DIMACS errors for `optimal`
  double certificate_tolerance = 1e-8;  ///< certificate residual (normalised, see Certificate)
  int iteration_limit = 500;            ///< over all arithmetics together
  unsigned threads = 1;                 ///< 0: one a core; results do not depend on it
  /// "auto": double first, then 31 and 100 digits where double stalls short of the tolerance and
  /// the problem is small enough, by an estimate of its operations; "double";
  /// "quad" (31 digits from the start); or a number of decimal digits, 1 to 100, rounded up to what
  /// there is.
  std::string precision = "auto";
  std::function<void(const Progress&)> progress;  ///< called once an iteration when set
  /// Called with x once an iteration when set, in double: true ends the solve with `undecided` and
  /// the cause `enough`. Whether x satisfies anything is for the caller to check.
  std::function<bool(const std::vector<double>& x)> enough;
  /// A point near the solution to begin with: its x, X and Y, the last two positive definite.
  const Solution* from = nullptr;
};

/// Solves `problem`. Throws std::invalid_argument when the problem is malformed (indices out of
/// range, entries below the diagonal, values that are not finite) or `options.precision` is none of
/// the above; InputError when the memory that there is does not do (forecast.h). When everything is
/// to stop (base/stop.h) it ends within a second, in any arithmetic, with the best point so far and
/// the cause `interrupted`. Its work counts for the allowances of the caller, to whom
/// OutOfAllowance passes. Every other outcome is a Solution.
Solution solve(const Problem& problem, const Options& options = {});

}  // namespace gainsmith::sdp
