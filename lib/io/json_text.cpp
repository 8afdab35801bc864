#include "io/json_text.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/error.h"
#include "base/number.h"

namespace gainsmith::io {

namespace {

bool is_flat(const Json& list) {
  return std::none_of(list.begin(), list.end(),
                      [](const Json& item) { return item.is_structured(); });
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
    if (object) out += Json(item.key()).dump() + ": ";
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
    out += decimal17(number);
  } else {
    out += value.dump();
  }
}

Place place_of(const std::string& text, const std::string& file, std::size_t byte) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(byte, text.size()));
  const auto line = 1 + std::count(text.begin(), end, '\n');
  const auto reversed = std::find(std::make_reverse_iterator(end), text.rend(), '\n');
  const auto column = 1 + (std::make_reverse_iterator(end).base() - reversed.base());
  return {file, static_cast<int>(line), static_cast<int>(std::max<std::ptrdiff_t>(column, 1))};
}

}  // namespace

std::string to_text(const Json& document) {
  std::string out;
  write(document, 0, out);
  out += '\n';
  return out;
}

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
  }
}

}  // namespace gainsmith::io
