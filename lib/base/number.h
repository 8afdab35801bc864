// Numbers as text: what is written can be read back to the same bits.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace gainsmith {

/// The decimal with 17 significant digits ("%.17g"): reading it back gives the same double, and
/// writing that again gives the same text. Infinity and NaN print as "inf", "-inf", "nan".
std::string decimal17(double value);

/// The shortest decimal that is read back as the same double: 0.3, not 0.29999999999999999. In the
/// style of "%.15g", or of as many digits as it has.
std::string shortest(double value);

/// For people: `digits` significant digits, no trailing zeros ("%.*g").
std::string brief(double value, int digits = 6);
/// The same, rounded down or up where it is a bound.
std::string brief_below(double value, int digits = 6);
std::string brief_above(double value, int digits = 6);

/// The double nearest to a whole decimal text (sign allowed; no spaces, nothing after it; an
/// exponent may follow "e" or "E"). Empty when the text is no finite decimal number, is beyond the
/// range of double, or is not 0 and has an exponent beyond 1000. What is below the range is rounded
/// to zero.
std::optional<double> parse_decimal(std::string_view text);

}  // namespace gainsmith
