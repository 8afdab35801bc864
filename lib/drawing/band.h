// What a band leaves on its panel.
#pragma once

#include <string>

#include "drawing/axis.h"
#include "drawing/figure.h"
#include "drawing/trace.h"

namespace gainsmith::drawing {

/// A shape between the two ends for each flow; of a band with many jumps (single_jumps) one for all
/// samples between two gaps, its jumps upright. What is beyond an end of the value axis lies at
/// that end.
std::string drawn(const Band& band, const Axis& time, const Axis& values, const Box& box);

}  // namespace gainsmith::drawing
