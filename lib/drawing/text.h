// Texts of a figure: safe in XML, and how much room they need.
#pragma once

#include <string>
#include <string_view>

namespace gainsmith::drawing {

/// The text as content or quoted attribute of XML 1.0: & < > " escaped, ends of lines and tabs as
/// spaces, and U+FFFD for each byte that is no UTF-8 and for characters that XML does not have.
std::string escaped(std::string_view utf8);

/// About the width in pixels in a sans-serif font of this size, rather too much than too little.
double text_width(std::string_view utf8, double size);

/// The text, or as much of its beginning as fits with an ellipsis into the width.
std::string shortened(std::string_view utf8, double size, double width);

}  // namespace gainsmith::drawing
