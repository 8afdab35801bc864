#include "gainsmith/range_option.h"

#include <cmath>
#include <vector>

#include "base/error.h"
#include "base/nearest.h"
#include "expr/text/parser.h"
#include "gainsmith/whole_number.h"

namespace gainsmith::app {

namespace {

std::vector<std::string> split(const std::string& text, char mark) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, begin)) {
    parts.push_back(text.substr(begin, at - begin));
    begin = at + 1;
  }
  parts.push_back(text.substr(begin));
  return parts;
}

int count_of(const std::string& text, const std::string& option) {
  constexpr int kMost = 1000000;
  const auto count = parse_whole(text);
  if (!count || *count < 1 || *count > kMost)
    throw InputError({option}, "expected a number of points from 1 to 1000000, not '" + text + "'");
  return static_cast<int>(*count);
}

bool scale_of(const std::string& text, const std::string& option) {
  if (text != "log" && text != "lin")
    throw InputError({option}, "unknown scale '" + text + "'" + suggestion(text, {"log", "lin"}));
  return text == "log";
}

}  // namespace

RangeOption parse_range(const std::string& text, const std::string& option) {
  const std::size_t equals = text.find('=');
  const auto parts = split(equals == std::string::npos ? "" : text.substr(equals + 1), ':');
  // A comma within parentheses is one of a formula.
  const bool list = text.find(',') != std::string::npos && text.find('(') == std::string::npos;
  if (equals == 0 || parts[0].empty() || parts.size() > 4 || list ||
      text.find("..") != std::string::npos)
    throw InputError(
        {option},
        "expected NAME=LOW:HIGH, NAME=LOW:HIGH:COUNT[:log] or NAME=VALUE, not '" + text + "'");
  RangeOption result;
  result.is_value = parts.size() == 1;
  result.range = {text.substr(0, equals),
                  parse_expression(parts[0], option),
                  parse_expression(parts.size() > 1 ? parts[1] : parts[0], option),
                  {option}};
  if (result.is_value) result.count = 1;
  if (parts.size() > 2) result.count = count_of(parts[2], option);
  if (parts.size() > 3) result.logarithmic = scale_of(parts[3], option);
  return result;
}

void check_positive(const std::optional<double>& number, const std::string& option) {
  if (number && !(*number > 0 && std::isfinite(*number)))
    throw InputError({option}, "expected a positive number");
}

expr::Expression parse_expression(const std::string& text, const std::string& option) {
  return expr::parse(expr::Text(text, option));
}

}  // namespace gainsmith::app
