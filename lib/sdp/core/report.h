// The answer, recomputed from the raw problem.
#pragma once

#include "sdp/core/presolve.h"
#include "sdp/problem.h"
#include "sdp/solution.h"

namespace gainsmith::sdp {

/// Fills objectives, gap and DIMACS errors of `point` on `problem`, computed in T.
template <typename T>
void measure(const Problem& problem, const Point<T>& point, Solution& solution);

/// Rounds `point` to the doubles of `solution`, and what that leaves to `solution.rest`.
template <typename T>
void store(const Point<T>& point, Solution& solution);

/// sum x_i F_i - F_0
template <typename T>
std::vector<std::vector<T>> slack(const Problem& problem, const std::vector<T>& x);

/// Has `matrix` a Cholesky factor in T (nonnegative entries, in a diagonal block)?
template <typename T>
bool in_cone(const Problem& problem, const std::vector<std::vector<T>>& matrix);

/// Normalises Y to F_0.Y = 1, or x to c'x = -1, and checks what Certificate demands on the raw
/// data, in T, with residual at most `tolerance`. Returns what it found; `checked` says whether it
/// holds.
template <typename T>
Certificate check_primal_infeasible(const Problem& problem, Point<T>& point, double tolerance);
template <typename T>
Certificate check_dual_infeasible(const Problem& problem, Point<T>& point, double tolerance);

}  // namespace gainsmith::sdp
