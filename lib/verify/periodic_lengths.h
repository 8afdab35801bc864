// Lengths of flows that, repeated in turn, make linear errors grow.
//
// In the coordinates of the claims (linear/coordinates.h), from just after a jump to just after the
// next one:
//
//   x+ = J expm(s M) x + ...,  s in [low, high]
//
// Products of these matrices over a grid of lengths are searched by branch and bound
// (numerics/matrix_products.h); then the lengths of the best are moved within [low, high] (NLopt).
// A spectral radius above 1 shows that the period makes errors grow; the sampling law that repeats
// it is unstable. That none was found shows nothing.
//
// The growth a jump is rho(product)^(1/m) over m lengths; its supremum over all products is the
// joint spectral radius of the matrices (Rota & Strang 1960), of which each product is a lower
// bound.
#pragma once

#include <optional>
#include <vector>

#include "verify/setup.h"

namespace gainsmith::verify {

struct PeriodicLengths {
  std::vector<double> lengths;
  double growth = 0;  ///< of the errors, a jump: rho^(1/number of lengths)
};

/// The sequence that grows fastest, of those that were tried. None when flow or jump is not linear
/// with constant coefficients, or all lengths are the same.
std::optional<PeriodicLengths> fastest_lengths(const Setup& setup);

}  // namespace gainsmith::verify
