// Points of large programs by the solver for programs in matrices (sdp/schur/matrix_solver.h),
// which keeps B_k(x) as sums of products of matrices and solves its linear systems by conjugate
// gradients. Its points start the dense interior-point method or make it superfluous.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "design/attempt.h"

namespace gainsmith::design {

/// Whether a point inside with the variables x of the program has all that is asked of it.
using Enough = std::function<bool(const std::vector<double>& x)>;

/// A point inside: its margin is as large as asked for, and an iteration no longer doubles it.
/// Where the largest margin itself, or a multiplier, is what is asked for: none.
Enough enough_for(const Posed& posed, const Question& asked, const lmi::Formulation& formulation,
                  const lmi::Round& round);

/// The point of a large program of which the matrices are known: `enough`, or near the solution, to
/// go on from. None for other programs.
std::optional<sdp::Solution> solve_in_matrices(const Posed& posed, const Question& asked,
                                               const lmi::Formulation& formulation,
                                               const lmi::Round& round, const Enough& enough);

}  // namespace gainsmith::design
