// Flows that are integrated (flow.h).
//
// A step of the integrator has a polynomial of its own, of some degree. Its values at degree + 1
// Chebyshev points give the same polynomial as a Chebyshev series.
#pragma once

#include <memory>

#include "simulate/flow.h"

namespace gainsmith::simulate {

/// As make_flow (flow.h), of any system.
std::unique_ptr<Flow> integrated_flow(VectorField& field, const Accuracy& accuracy, double longest);

}  // namespace gainsmith::simulate
