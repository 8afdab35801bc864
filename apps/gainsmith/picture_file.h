// Pictures in files: SVG, and PDF or PNG by librsvg.
#pragma once

#include <string>

namespace gainsmith::app {

/// Before the work that the picture shows: InputError, with the option as its place, unless the name
/// ends with .svg, .pdf or .png, and for the last two where rsvg-convert is not installed.
void check_picture_name(const std::string& path, const std::string& option = "--plot");

/// Writes the picture whole or not at all: the same bytes for the same SVG. PNG has two dots a pixel of
/// the SVG. InputError where that cannot be done. Nothing for an empty path.
void write_picture(const std::string& path, const std::string& svg);

}  // namespace gainsmith::app
