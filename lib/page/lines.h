// Formulas that break into lines, which browsers do not do in MathML, and that shrink.
#pragma once

#include <string>
#include <string_view>

namespace gainsmith::page {

/// Markup as a formula in a line of text. Where a phone has no room for it, it is several <math>
/// elements. Lines break between them: behind commas, before relations, signs and factors; inside
/// parentheses only if one line has no room for them. An element that is wide all the same, such as
/// a matrix, has its estimated width in em as --w: the style sheet shrinks it.
std::string formula(std::string_view mathml);

}  // namespace gainsmith::page
