// JSON as text: numbers with 17 digits, matrices one row a line; reading with places.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace gainsmith::io {

using Json = nlohmann::ordered_json;

/// The text of a document, ending in a newline. Floating-point numbers have 17 significant digits;
/// lists of scalars stand on one line. std::invalid_argument when a number is not finite (JSON has
/// no spelling for it).
std::string to_text(const Json& document);

/// The number, or null when it is not finite: JSON has no infinity and no NaN.
Json finite_or_null(double value);

/// Parses. InputError with file:line:column when the text is no JSON.
Json parse_json(const std::string& text, const std::string& file);

}  // namespace gainsmith::io
