// Pictures with fewer points, for pages of many.
#pragma once

#include <string>
#include <string_view>

namespace gainsmith::page {

/// The picture, its lines with as few of their points as show them to within `tolerance` pixels
/// (Douglas and Peucker). Lines are the paths of moves and lines by differences, as report/drawing.h
/// writes them; all else stays as it is.
std::string coarse(std::string_view svg, double tolerance);

}  // namespace gainsmith::page
