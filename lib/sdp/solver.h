// The primal-dual interior-point solver.
#pragma once

#include <functional>
#include <string>

#include "sdp/problem.h"
#include "sdp/solution.h"

namespace gainsmith::sdp {

/// One line of the progress table.
struct Progress {
  int iteration = 0;
  std::string precision;  ///< the arithmetic of this iteration
  double primal_objective = 0;
  double dual_objective = 0;
  double relative_gap = 0;
  double primal_infeasibility = 0;
  double dual_infeasibility = 0;
  double step_primal = 0;
  double step_dual = 0;
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
