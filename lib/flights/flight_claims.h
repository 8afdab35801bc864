// Claims along flights in closed form, as ClaimLane judges them.
//
//   value   sum_j p_j s^j; its error up to s from sum_j |p_j - q_j| s^j, the difference of both
//           runs
//   below   its largest value on the flight, by its vertex or by coefficients of Bernstein
//   falls   by the differences of these
//
// What that does not decide leaves the flight open.
//
// A polynomial in Bernstein form is not above its largest coefficient. It falls where its
// coefficients do: p' has the coefficients n (b_k - b_{k-1})/length.
#pragma once

#include "claims/claims.h"
#include "flights/flight_graph.h"

namespace gainsmith::flights {

/// Where the fields of a claim are kept; `next`: the first free place, and then the next one.
FlightSystem::Places places_of(const PackClaim& claim, std::size_t& next);

/// Adds the fields of a claim after a flight of this length, in the order of their places.
/// NoFormula (numbers/graph/scalar_rules.h) where its value is no polynomial.
void add_claim(FlightGraph& graph, const claims::Claim& claim, std::size_t number, int length,
               Nodes& fields);

}  // namespace gainsmith::flights
