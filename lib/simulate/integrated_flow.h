// Flows that are integrated (flow.h).
#pragma once

#include <memory>

#include "simulate/flow.h"

namespace gainsmith::simulate {

/// As make_flow (flow.h), of any system.
std::unique_ptr<Flow> integrated_flow(VectorField& field, const Accuracy& accuracy, double longest);

}  // namespace gainsmith::simulate
