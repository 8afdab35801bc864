#include "export/identifiers.h"

#include <algorithm>
#include <string_view>

#include "expr/program/operations.h"

namespace gainsmith::exports {

namespace {

/// Words between spaces, to be found with them: keywords of C and C++, then names of headers.
constexpr std::string_view kCWords =
    " auto break case char const continue default do double else enum extern float for goto if "
    "inline int long"
    " register restrict return short signed sizeof static struct switch typedef union unsigned "
    "void volatile"
    " while asm class new delete this template private public protected operator true false bool "
    "catch throw"
    " try namespace using virtual friend export typename and or not xor main errno NULL "
    "pow fabs powf fabsf ";
constexpr std::string_view kMatlabWords =
    " break case catch classdef continue else elseif end for function global if otherwise parfor "
    "persistent"
    " return spmd switch try while until do unwind_protect endfunction endif endfor endwhile pi "
    "eps Inf NaN"
    " ans eye zeros ones expm inv reshape struct min max power choose ";
constexpr std::string_view kPythonWords =
    " False None True and as assert async await break class continue def del elif else except "
    "finally for from"
    " global if import in is lambda nonlocal not or pass raise return try while with yield match "
    "case type"
    " self np math abs min max float int print range ";

std::string_view words_of(Language language) {
  switch (language) {
    case Language::c:
      return kCWords;
    case Language::matlab:
      return kMatlabWords;
    case Language::python:
      break;
  }
  return kPythonWords;
}

/// C and MATLAB have the functions of numbers under the names of the table, C those of floats with
/// an f behind.
bool is_function(Language language, std::string_view word) {
  if (language == Language::python) return false;
  return std::ranges::any_of(expr::kNumberFunctions, [&](const expr::NumberFunction& function) {
    const std::string_view name = expr::operation(function.op).identifier;
    return word == name ||
           (language == Language::c && word.starts_with(name) && word.substr(name.size()) == "f");
  });
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// gs3, gsb3, gsb3_0: values that the code of a map computes on its way (scalar_code.cpp).
bool is_intermediate(std::string_view word) {
  if (!word.starts_with("gs")) return false;
  word.remove_prefix(word.starts_with("gsb") ? 3 : 2);
  return !word.empty() && is_digit(word.back()) &&
         word.find_first_not_of("0123456789_") == std::string_view::npos;
}

}  // namespace

bool is_reserved(Language language, const std::string& word) {
  return words_of(language).find(" " + word + " ") != std::string_view::npos ||
         is_function(language, word) || is_intermediate(word);
}

std::string Identifiers::operator()(const std::string& name) {
  std::string made;
  for (const char c : name) made += is_letter(c) || is_digit(c) ? c : '_';
  while (made.size() > 1 && made.back() == '_' && made[made.size() - 2] == '_') made.pop_back();
  if (made.empty() || !is_letter(made.front())) made = "x" + made;
  while (is_reserved(language_, made) || taken_.contains(made)) made += "_";
  taken_.insert(made);
  return made;
}

}  // namespace gainsmith::exports
