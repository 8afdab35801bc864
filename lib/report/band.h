// What a band leaves on its panel.
#pragma once

#include <string>

#include "report/axis.h"
#include "report/figure.h"
#include "report/trace.h"

namespace gainsmith::report {

/// A shape between the two ends for each flow; of a band with many jumps (single_jumps) one for all
/// samples between two gaps, its jumps upright. What is beyond an end of the value axis lies at
/// that end.
std::string drawn(const Band& band, const Axis& time, const Axis& values, const Box& box);

}  // namespace gainsmith::report
