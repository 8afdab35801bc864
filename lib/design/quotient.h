// minimize: lambda_max(M, N), the smallest l with M <= l*N where N > 0: a generalised eigenvalue
// problem, quasiconvex in the unknowns.
//
// From a point x_k with N_k = N(x_k) > 0 and l_k the largest eigenvalue of the pair (M(x_k), N_k),
//   minimise t  subject to  M(x) - l_k N(x) <= t N_k,   N(x) <= 100 N_k,   and the inequalities
// gives t < 0 and a point with a smaller l, or shows that l_k is the least. Near the end each step
// squares the distance (Dinkelbach; Crouzeix, Ferland and Schaible 1985, for matrices). The value
// is settled from both sides by the ordinary check of decimals: a yes for "M <= l N", and a
// certificate that nothing satisfies it a little below.
#pragma once

#include "design/synthesize.h"

namespace gainsmith::design {

/// The gains of the point with the smallest l that was found, `objective` its l. The objective's
/// lower bound is a value that a certificate excludes; absent, with a message, when none was found.
/// When the inequalities with N > 0 have no solution, what synthesize() says of them.
/// A verdict no is that of the inequalities with N > 0 alone.
model::Gains smallest_quotient(const model::Instance& instance, const sdp::Options& options,
                               Depth depth);

}  // namespace gainsmith::design
