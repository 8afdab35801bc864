// What the point of a minimum costs, and how it is brought nearer to the least value.
//
// The program of an objective is posed in units of its data (lmi/balance.h), with a margin of
// strict inequalities. Where these are far from the units of the solution, the margin costs much,
// or it is below rounding and the point does not hold. Then the program is solved
//
//   with a weight on the traces of all blocks, which bounds what the objective does not see
//   in units of that solution, with a margin and a weight that cost little of the objective
//   with a finer gap, where the solver's is small beside 1 and large beside the objective
//
// until its point holds and its price is small; the best of all is kept.
#pragma once

#include <vector>

#include "design/attempt.h"

namespace gainsmith::design {

/// A price that is no matter of the solver's digits, and one that ill-conditioned minima of large
/// programs have in the dense solver too.
constexpr double kCheap = 3e-7, kFair = 1e-6;

/// Whether no element is infinite or NaN.
bool is_finite(const std::vector<double>& x);
/// Whether every block is positive definite at x, as far as double tells.
bool is_positive(const Posed& posed, const std::vector<double>& x);

/// How far the objective of a solution is above its lower bound (lmi::objective_lower_bound): (c'x
/// - bound) / |c'x|. The bound is an estimate that nothing shows.
double price_of(const Posed& posed, const lmi::GainBounds& bounds,
                const lmi::Formulation& formulation, const sdp::Solution& solution);

/// On entry `result` has the formulation and the solution of a minimum in units of the data; on
/// return those of the best minimum. Iterations add up.
void refine_minimum(const Posed& posed, const Solve& solve, Attempt& result);

}  // namespace gainsmith::design
