// What a reader of a figure wants otherwise: a part of its axis, jumps side by side, other names.
#pragma once

#include <string>
#include <vector>

#include "drawing/figure.h"

namespace gainsmith::drawing {

/// Of the panels that are no planes, what lies between two places of the axis below; lines that
/// cross them are cut there. Of a figure of planes alone what lies between two places across.
void cut(Figure& figure, double from, double to);

/// Hybrid time t + width*j on the axis below: jump j takes a part of it, where lines lead from the
/// value before to the one after. The marks go.
void spread_jumps(Figure& figure, double width);

/// Gives curves, bands, panels and axes of a name another one; whether there is any.
bool rename(Figure& figure, const std::string& name, const std::string& other);

/// The labels of its curves and bands, the titles of its panels, the names of its axes.
std::vector<std::string> names_in(const Figure& figure);

}  // namespace gainsmith::drawing
