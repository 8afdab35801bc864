#include "expr/text/parser_advice.h"

#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "expr/text/foreign_words.h"

namespace gainsmith::expr {

namespace {

/// Whether a bracket is open before the token at `at`.
bool is_open(std::span<const Token> tokens, std::size_t at) {
  int depth = 0;
  for (std::size_t k = 0; k < at; ++k) {
    const TokenKind kind = tokens[k].kind;
    depth += static_cast<int>(kind == TokenKind::open || kind == TokenKind::open_bracket);
    depth -= static_cast<int>(kind == TokenKind::close || kind == TokenKind::close_bracket);
  }
  return depth > 0;
}

/// What a unit is in base units, as it is written behind a number.
/// SI prefixes as decimal powers, so that the number can be written as it is.
std::optional<std::string_view> power_of_unit(std::string_view unit) {
  static constexpr auto kPowers = std::to_array<std::pair<std::string_view, std::string_view>>(
      {{"ms", "e-3"},  {"us", "e-6"},      {"ns", "e-9"},   {"mm", "e-3"}, {"cm", "e-2"},
       {"km", "e3"},   {"mV", "e-3"},      {"mA", "e-3"},   {"mH", "e-3"}, {"mF", "e-3"},
       {"uF", "e-6"},  {"nF", "e-9"},      {"msec", "e-3"}, {"sec", ""},   {"min", "*60"},
       {"h", "*3600"}, {"deg", "*pi/180"}, {"kg", ""},      {"g", "e-3"},  {"s", ""},
       {"m", ""},      {"rad", ""},        {"V", ""},       {"A", ""},     {"N", ""}});
  for (const auto& [name, power] : kPowers)
    if (name == unit) return power;
  return std::nullopt;
}

/// "5ms", with what to write for it.
std::string in_base_units(const std::string& number, const std::string& unit) {
  const bool plain = number.find_first_of("eE") == std::string::npos;
  if (unit.ends_with("Hz"))
    return "; numbers have no units: a frequency in 1/s is a number, a sampling time its inverse "
           "in s";
  const auto power = power_of_unit(unit);
  if (power && (plain || power->empty()))
    return "; numbers have no units: for " + number + " " + unit + " write " + number +
           std::string(*power) + ", or " + number + "*" + unit + " for a product";
  return "; numbers have no units, and a product is written " + number + "*" + unit;
}

}  // namespace

std::string missing_between(std::span<const Token> tokens, std::size_t at) {
  if (at == 0) return {};
  if (tokens[at].kind == TokenKind::end && is_open(tokens, at))
    return "; inside of { } and [ ] of YAML a text with a comma must be quoted, a name such "
           "as f(x, u) too";
  const Token& left = tokens[at - 1];
  const Token& right = tokens[at];
  if (right.kind == TokenKind::semicolon && !is_open(tokens, at))
    return at + 2 == tokens.size() ? "; a formula ends without ';'"
                                   : "; a formula is one expression: 'let' names its parts";
  const bool value = right.kind == TokenKind::number || right.kind == TokenKind::name ||
                     right.kind == TokenKind::open_bracket;
  const bool complete = left.kind == TokenKind::number || left.kind == TokenKind::name ||
                        left.kind == TokenKind::close || left.kind == TokenKind::close_bracket ||
                        left.kind == TokenKind::quote;
  if (!value || !complete) return {};
  const bool touches = left.end == right.begin;
  // Apart, a capital letter is rather a matrix than a unit.
  const bool unit = power_of_unit(right.text) && (right.text.size() > 1 || right.text[0] >= 'a');
  if (left.kind == TokenKind::number && right.kind == TokenKind::name &&
      (touches || unit || right.text.ends_with("Hz")))
    return in_base_units(left.text, right.text);
  if (right.kind == TokenKind::name)
    if (const std::string advice = advice_on(right.text); !advice.empty()) return "; " + advice;
  if (left.kind == TokenKind::name && right.kind == TokenKind::open_bracket && touches)
    return "; an element is written " + left.text + "(1, 2)";
  return "; a comma is missing between elements, or * in a product";
}

std::string decimal_comma(std::span<const Token> tokens, std::size_t at) {
  if (tokens[at].kind != TokenKind::comma || at == 0 || at + 1 >= tokens.size()) return {};
  const Token& left = tokens[at - 1];
  const Token& right = tokens[at + 1];
  if (left.kind != TokenKind::number || right.kind != TokenKind::number ||
      left.end + 1 != right.begin)
    return {};
  return left.text.find('.') == std::string::npos
             ? "unexpected ',': a decimal is written with a point: " + left.text + "." + right.text
             : "unexpected ',': a decimal is written with one point and nothing between its "
               "thousands";
}

}  // namespace gainsmith::expr
