// JSON as text: numbers with up to 17 digits, matrices one row a line; reading with places.
//
// A number that was written with other digits keeps its decimal: it is then a binary value that
// holds the text, the one kind of value that JSON itself has no spelling for.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace gainsmith::io {

using Json = nlohmann::ordered_json;

/// The text of a document, ending in a newline. Floating-point numbers have 17 significant digits,
/// or the digits that they were read with; lists of scalars are on one line.
/// std::invalid_argument when a number is not finite (JSON has no spelling for it).
std::string to_text(const Json& document);

/// The number, or null when it is not finite: JSON has no infinity and no NaN.
Json finite_or_null(double value);

/// A number that is written as `text`, a decimal that is finite in double.
Json decimal_json(const std::string& text);

/// Whether it is a number of JSON, or a decimal of decimal_json().
bool is_number(const Json& value);

/// The double nearest to a number.
double number_of(const Json& number);

/// The decimal of a number, as to_text writes it.
std::string decimal_of(const Json& number);

/// A list of what `write_item` makes of each item.
template <class Item, class Write>
Json list_json(const std::vector<Item>& items, Write write_item) {
  Json list = Json::array();
  for (const Item& item : items) list.push_back(write_item(item));
  return list;
}

/// Parses. Numbers with a point or an exponent that to_text would write otherwise keep their
/// decimal. InputError with file:line:column when the text is no JSON or a key occurs twice.
Json parse_json(const std::string& text, const std::string& file);

}  // namespace gainsmith::io
