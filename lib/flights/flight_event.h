// When a flight ends, and by which event: the first root of a watch after which one is due.
//
// A watch has degree 2 at most. At each of its roots the conditions of all events are evaluated,
// with the sides of all watches just after it; what is not certain there is left open.
//
//   degree 1   s = -c_0/c_1
//   degree 2   q = -(c_1 + sign(c_1) sqrt(c_1^2 - 4 c_0 c_2))/2,   s = q/c_2 and s = c_0/q
//
// The second form of the quadratic has no cancellation. A side is certain where |w(s)| exceeds its
// error and what w changes by between the roots of both runs.
#pragma once

#include "flights/flight_graph.h"

namespace gainsmith::flights {

/// As nodes.
struct FlightEnd {
  int length = 0;
  int other_length = 0;  ///< of the second run, from the start of the first on
  int event = 0;         ///< -1: the horizon
  Nodes sides;           ///< of the watches, just after the event
};

/// NoFormula (numbers/graph/scalar_rules.h) where a watch has another degree, and where they have
/// many roots.
FlightEnd find_end(FlightGraph& graph);

}  // namespace gainsmith::flights
