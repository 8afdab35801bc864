#include "io/json_text.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "base/error.h"
#include "base/number.h"

namespace gainsmith::io {

namespace {

bool is_flat(const Json& list) {
  return std::none_of(list.begin(), list.end(),
                      [](const Json& item) { return item.is_structured(); });
}

/// Bytes that are no UTF-8 (in the name of a file) are replaced: JSON has no spelling for them.
std::string dumped(const Json& text) {
  return text.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void write(const Json& value, std::size_t indent, std::string& out);

void write_items(const Json& value, std::size_t indent, std::string& out) {
  const bool object = value.is_object();
  const bool one_line = value.empty() || (!object && is_flat(value));
  const std::string inner = one_line ? "" : "\n" + std::string(indent + 2, ' ');
  out += object ? '{' : '[';
  bool first = true;
  for (const auto& item : value.items()) {
    if (!first) out += one_line ? ", " : ",";
    first = false;
    out += inner;
    if (object) out += dumped(item.key()) + ": ";
    write(item.value(), indent + 2, out);
  }
  if (!one_line) out += "\n" + std::string(indent, ' ');
  out += object ? '}' : ']';
}

void write(const Json& value, std::size_t indent, std::string& out) {
  if (value.is_structured()) {
    write_items(value, indent, out);
  } else if (value.is_number_float()) {
    const double number = value.get<double>();
    if (!std::isfinite(number))
      throw std::invalid_argument("JSON has no spelling for " + decimal17(number));
    // "-0" would be read back as the whole number 0.
    out += number == 0 && std::signbit(number) ? "-0.0" : decimal17(number);
  } else {
    out += dumped(value);
  }
}

Place place_of(const std::string& text, const std::string& file, std::size_t byte) {
  const std::string_view before = std::string_view(text).substr(0, std::min(byte, text.size()));
  const std::size_t start = before.rfind('\n') + 1;  // npos + 1 is 0
  const auto is_first_byte = [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  };
  return {file, 1 + static_cast<int>(std::ranges::count(before, '\n')),
          1 + static_cast<int>(std::ranges::count_if(before.substr(start), is_first_byte))};
}

}  // namespace

std::string to_text(const Json& document) {
  std::string out;
  write(document, 0, out);
  out += '\n';
  return out;
}

Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json parse_json(const std::string& text, const std::string& file) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    if (text.find_first_not_of(" \t\r\n") == std::string::npos)
      throw InputError({file}, "the file is empty; expected a JSON document");
    const std::string message = error.what();
    const std::size_t colon = message.rfind(": ");
    throw InputError(place_of(text, file, error.byte > 0 ? error.byte - 1 : 0),
                     "this is no complete JSON document: " +
                         (colon == std::string::npos
                              ? message
                              : message.substr(message.find("syntax error") != std::string::npos
                                                   ? message.find("syntax error")
                                                   : colon + 2)));
  } catch (const Json::out_of_range& error) {
    // "...: number overflow parsing '1e999'" does not say where.
    const std::string message = error.what();
    const std::size_t open = message.find('\'');
    const std::size_t close = message.rfind('\'');
    if (open == close) throw InputError({file}, message);
    const std::string number = message.substr(open + 1, close - open - 1);
    throw InputError(place_of(text, file, text.find(number)),
                     "the number " + number + " is beyond the range of double");
  }
}

}  // namespace gainsmith::io
