// Flows of affine systems, exact up to rounding (flow.h).
#pragma once

#include <memory>

#include "simulate/flow.h"

namespace gainsmith::simulate {

/// As make_flow (flow.h), of an affine system.
std::unique_ptr<Flow> exact_flow(VectorField& field, double longest,
                                 const LastPlaces* moved = nullptr);

}  // namespace gainsmith::simulate
