// One panel of a figure.
#pragma once

#include <string>

#include "drawing/axis.h"
#include "drawing/figure.h"
#include "drawing/trace.h"

namespace gainsmith::drawing {

/// The room that the labels beside this axis need.
double label_width(const Axis& axis);

/// Grid, frame, labels at the left, bands and curves, the frame around the box.
std::string drawn(const Panel& panel, const Axis& time, const Axis& values, const Box& box);

/// Rows instead of numbers, from the top.
Axis axis_of_rows(const std::vector<std::string>& rows);

/// The frame of the box, labels and the name of the axis at its left.
std::string framed(const std::string& name, const Axis& values, const Box& box);

/// The frame of a scale of colours and its labels at the right.
std::string drawn_beside(const Axis& scale, const Box& box);

/// The labels of the time axis and its name, below a box.
std::string drawn_below(const Axis& time, const std::string& name, const Box& box);

}  // namespace gainsmith::drawing
