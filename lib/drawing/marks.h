// Moments that all panels of a figure share, such as samples.
#pragma once

#include <string>
#include <vector>

#include "drawing/axis.h"
#include "drawing/trace.h"

namespace gainsmith::drawing {

/// A short tick at the lower edge of the box for each time that the axis shows; of ticks that would
/// be closer than 3 pixels together the first. The times do not decrease. Empty without any.
std::string marks(const std::vector<double>& times, const Axis& time, const Box& box);

}  // namespace gainsmith::drawing
