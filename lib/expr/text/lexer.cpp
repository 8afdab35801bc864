// Numbers, names and symbols. What other languages write is recognised first, so that the message
// says what to write here.
#include "expr/text/lexer.h"

#include <array>
#include <cctype>
#include <string_view>
#include <utility>

#include "base/utf8.h"

namespace gainsmith::expr {

namespace {

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool is_name_start(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_name_part(char c) { return is_name_start(c) || is_digit(c); }

/// The end of a number that starts at `at`: digits [. digits] [e [+-] digits].
std::size_t number_end(std::string_view text, std::size_t at) {
  const auto digits = [&] {
    while (at < text.size() && is_digit(text[at])) ++at;
  };
  digits();
  // "1..N" is a range, not "1." and ".N"; the point of "2./v" belongs to the operator.
  const bool point = at < text.size() && text[at] == '.';
  if (point && (at + 1 == text.size() ||
                std::string_view(".*/^").find(text[at + 1]) == std::string_view::npos)) {
    ++at;
    digits();
  }
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    std::size_t exponent = at + 1;
    if (exponent < text.size() && (text[exponent] == '+' || text[exponent] == '-')) ++exponent;
    if (exponent < text.size() && is_digit(text[exponent])) {
      at = exponent;
      digits();
    }
  }
  return at;
}

/// The end of a name that starts at `at`: letters, digits and _; of a part of something also with a
/// point, "plant.x".
std::size_t name_end(std::string_view text, std::size_t at) {
  const auto part = [&](std::size_t from) {
    while (from < text.size() && is_name_part(text[from])) ++from;
    return from;
  };
  std::size_t end = part(at);
  while (end + 1 < text.size() && text[end] == '.' && is_name_start(text[end + 1])) {
    end = part(end + 1);
  }
  return end;
}

/// Whether .A, .B, .C or .D of a system in parentheses is here.
bool is_part(std::string_view text, std::size_t at) {
  return at > 0 && text[at - 1] == ')' && text[at] == '.' && at + 1 < text.size() &&
         text[at + 1] >= 'A' && text[at + 1] <= 'D' &&
         (at + 2 == text.size() || !is_name_part(text[at + 2]));
}

#define SYMBOL(token, spelling) Symbol{spelling, TokenKind::token},
using Symbol = std::pair<std::string_view, TokenKind>;
constexpr std::array kSymbols = {
#include "expr/operations.def"
};

/// Spellings of other languages, with what to write here.
using Foreign = std::pair<std::string_view, std::string_view>;
constexpr auto kForeign = std::to_array<Foreign>({
    {"~=", "indices that differ are written i != j"},
    {">>", "write >"},
    {"<<", "write <"},
    {"=>", "did you mean >=?"},
    {"=<", "did you mean <=?"},
    {"=",
     "an equation of a requirement is written ==, an index i in 1..N, and definitions go into "
     "'let'"},
    {".nan", "a number must be finite"},
    {".NaN", "a number must be finite"},
    {".NAN", "a number must be finite"},
    {".inf", "a number must be finite"},
    {".Inf", "a number must be finite"},
    {".INF", "a number must be finite"},
    {".'", "write ' for the transpose"},
    {"\\", "write inv(A)*B"},
    {"**", "write ^ for a power"},
    {"|", "write abs(x) for a number, norm(M) for a matrix"},
    {"%", "a remark begins with #, outside of quotation marks"},
    {"\"", "the quotation mark that begins the formula is missing"},
    {"\xC2\xA0", "this is a non-breaking space; type a plain one"},
    {"{", "matrices are written in [ ], arguments in ( )"},
    {"\xC3\x97", "write * for a product"},
    {"\xC2\xB7", "write * for a product"},
    {"\xC2\xB2", "write ^2"},
    {"\xC2\xB3", "write ^3"},
    {"\xC2\xB5", "numbers have no units; for 5 \xC2\xB5s write 5e-6, with seconds everywhere"},
    {"\xCE\xBC", "names are letters of a to z, digits and _; write mu. Numbers have no units"},
    {"&", "write 'and', or a chain such as 0 < a <= b"},
    {"\xE2\x88\x92", "this is a typographic minus; write -"},
    {"\xE2\x89\xA4", "write <="},
    {"\xE2\x89\xA5", "write >="},
    {"\xE2\x89\xBA", "write <; a matrix inequality is one of the definite order"},
    {"\xE2\x89\xBB", "write >; a matrix inequality is one of the definite order"},
    {"\xE2\x89\xBC", "write <=; a matrix inequality is one of the definite order"},
    {"\xE2\x89\xBD", "write >=; a matrix inequality is one of the definite order"},
    {"\xE2\xAA\xAF", "write <=; a matrix inequality is one of the definite order"},
    {"\xE2\xAA\xB0", "write >=; a matrix inequality is one of the definite order"},
    {"\xE2\x8A\xA4", "write ' for the transpose"},
    {".T", "write ' for the transpose"},
    {"\xE2\x89\xA0", "an inequality has one of < <= > >="},
    {"\xE2\x80\x99", "this is a typographic quote; write '"},
    {"\xE2\x80\x9C", "this is a typographic quote; write \" around the whole formula"},
    {"\xE2\x80\x9D", "this is a typographic quote; write \" around the whole formula"},
});

/// InputError for a character that begins no token. A character of UTF-8 is named as a whole.
[[noreturn]] void refuse(const Text& text, std::size_t at) {
  const std::string_view rest = std::string_view(text.str()).substr(at);
  for (const auto& [spelling, advice] : kForeign)
    if (rest.starts_with(spelling))
      throw InputError(text.place(at),
                       "unexpected '" + std::string(spelling) + "': " + std::string(advice));
  std::size_t length = 1;
  while (length < rest.size() && is_continuation(rest[length])) ++length;
  throw InputError(text.place(at),
                   "unexpected character '" + std::string(rest.substr(0, length)) + "'");
}

}  // namespace

/// The longest symbol that fits is taken, as the table has longer ones first. White space separates
/// tokens and is dropped.
std::vector<Token> tokenize(const Text& text) {
  const std::string_view source = text.str();
  std::vector<Token> tokens;
  std::size_t at = 0;
  const auto push = [&](TokenKind kind, std::size_t end) {
    tokens.push_back({kind, std::string(source.substr(at, end - at)), at, end});
    at = end;
  };
  while (at < source.size()) {
    const char c = source[at];
    if (std::isspace(static_cast<unsigned char>(c)) != 0) {
      ++at;
    } else if (is_digit(c) || (c == '.' && at + 1 < source.size() && is_digit(source[at + 1]))) {
      push(TokenKind::number, number_end(source, at));
    } else if (is_name_start(c)) {
      push(TokenKind::name, name_end(source, at));
    } else if (is_part(source, at)) {
      push(TokenKind::part, at + 2);
    } else {
      const std::string_view rest = source.substr(at);
      for (const auto& [spelling, advice] : kForeign)
        if (rest.starts_with(spelling) && spelling != "**" && !rest.starts_with("=="))
          refuse(text, at);
      bool known = false;
      for (const auto& [spelling, kind] : kSymbols) {
        if (!rest.starts_with(spelling)) continue;
        push(kind, at + spelling.size());
        known = true;
        break;
      }
      if (!known) refuse(text, at);
    }
  }
  push(TokenKind::end, at);
  return tokens;
}

}  // namespace gainsmith::expr
