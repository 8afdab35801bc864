// Flows of affine systems, exact up to rounding (flow.h).
//
//   z = (y, inputs, their rates, 1),   z' = G z,   z(t + s) = expm(s G) z(t)
//
// expm(s_0 G) is the Taylor series of degree 24 in 31 digits, with |s_0 G| <= 1/2 in balanced
// units. expm of 2^k s_0 follows by squaring (scaling and squaring, Moler & Van Loan 2003). The
// maps of each length are made once, at the 13 Chebyshev points, and serve all flows with the same
// parameters. y on a step is the polynomial of degree 12 through these points. A step is halved,
// down to s_0, until its last two coefficients are rounding.
#pragma once

#include <memory>

#include "simulate/flow.h"

namespace gainsmith::simulate {

/// As make_flow (flow.h), of an affine system.
std::unique_ptr<Flow> exact_flow(VectorField& field, double longest,
                                 const LastPlaces* moved = nullptr);

}  // namespace gainsmith::simulate
