// Whether a value falls along every flow and at every jump, shown once for all states.
//
//   v(x, tau) = sum_m g_m(tau) x'Q_m x
//   flow   x' = A x, tau' = -1:           v' = x'S(tau) x,  S = sum_m g_m (A'Q_m + Q_m A) - g_m' Q_m
//   jump   x+ = J x, from tau = 0 to any: v+ - v = x'S(tau) x,  S = sum_m g_m J'Q_m J - g_m(0) Q_m
//
// S(tau) <= 0 on a range is shown on pieces: with S = S_0 + sum_k S_k t^k, |t| <= 1, on one of them
// and -S_0 = L L', it is enough that sum_k |inv(L) S_k inv(L)'| < 1 in the norm of Frobenius. That
// does not depend on the units of x.
//
// Proof of the test: -S = L (I - sum_k t^k X_k) L' with X_k = inv(L) S_k inv(L)'. The bracket is
// positive definite where the norms of the X_k sum to less than 1. A piece that fails is halved,
// eight times at most.
#pragma once

#include <optional>
#include <vector>

#include "linear/flow.h"
#include "linear/length_table.h"

namespace gainsmith::linear {

/// One term: the matrix, and the number of its factor in the table of factors.
struct FallingTerm {
  Wide Q;
  std::size_t factor = 0;
};

/// Over the range of the table. False where it is not shown.
bool falls_along_flows(const std::vector<FallingTerm>& terms, const Wide& A,
                       const WideTable& factors);
/// `at_0`: the factors at tau = 0.
bool falls_at_jumps(const std::vector<FallingTerm>& terms, const Wide& J, const WideTable& factors,
                    const std::vector<Decimal100>& at_0);

/// kappa >= 0, near the least, with v' <= kappa v along x' = A x for v = x'Q x: then v(s) is at most
/// e^(kappa s) v(0), or v(0) where that is negative. None up to kappa length = 32.
std::optional<double> growth_along_flows(const Wide& Q, const Wide& A, double length);

}  // namespace gainsmith::linear
