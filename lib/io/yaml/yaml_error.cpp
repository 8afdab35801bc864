// Causes of errors of YAML, by what people write who do not know it: tabs, formulas without quotes,
// keys without a colon, brackets that are not closed. Most are sought on the line of the error and
// the two above; what is found first is said.
#include "io/yaml/yaml_error.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

namespace gainsmith::io {

namespace {

constexpr std::string_view kBlank = " \t\r";
constexpr std::string_view kWordCharacters =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";

/// The lines 0 to `last`, as far as they are there.
std::vector<std::string_view> lines_of(std::string_view text, std::size_t last) {
  std::vector<std::string_view> lines;
  while (lines.size() <= last) {
    const std::size_t end = text.find('\n');
    lines.push_back(text.substr(0, end));
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 1);
  }
  return lines;
}

/// The column of a tab in front of a line.
std::optional<std::size_t> find_tab(std::string_view line) {
  const std::size_t begin = std::min(line.find_first_not_of(kBlank), line.size());
  const std::size_t tab = line.substr(0, begin).find('\t');
  return tab == std::string_view::npos ? std::nullopt : std::optional(tab);
}

/// The column of the last value on a line that begins with one of `marks`: behind "key: ", "- " or
/// at the line's beginning.
std::optional<std::size_t> find_value(std::string_view line, std::string_view marks) {
  const std::size_t remark = line.find(" #");
  if (remark != std::string_view::npos) line = line.substr(0, remark);
  for (std::size_t at = line.size(); at-- > 0;) {
    if (marks.find(line[at]) == std::string_view::npos) continue;
    const std::size_t before =
        at == 0 ? std::string_view::npos : line.find_last_not_of(kBlank, at - 1);
    const bool first = before == std::string_view::npos;
    if (first || (before + 1 < at && (line[before] == ':' || line[before] == '-')) ||
        line[before] == '{' || line[before] == ',')
      return at;
  }
  return std::nullopt;
}

/// Whether the text has "key: value" in a value: "a: b: c".
std::optional<std::size_t> find_second_colon(std::string_view line) {
  const std::size_t first = line.find(": ");
  if (first == std::string_view::npos || line.find_first_of("{['\"") != std::string_view::npos)
    return std::nullopt;
  const std::size_t second = line.find(": ", first + 1);
  return second == std::string_view::npos ? std::nullopt : std::optional(second);
}

/// Whether a line is a single word, as a key is that lacks its colon.
bool is_bare(std::string_view line) {
  const std::size_t begin = line.find_first_not_of(kBlank);
  return begin != std::string_view::npos &&
         line.substr(begin).find_first_not_of(kWordCharacters) == std::string_view::npos;
}

/// "data {a: 1}", "problem motor": the end of a word that no colon follows, with more behind it.
std::optional<std::size_t> find_key_without_colon(std::string_view line) {
  const std::size_t begin = std::min(line.find_first_not_of(kBlank), line.size());
  const std::size_t end = line.find_first_not_of(kWordCharacters, begin);
  if (end == std::string_view::npos || end == begin ||
      kBlank.find(line[end]) == std::string_view::npos)
    return std::nullopt;
  const std::size_t next = line.find_first_not_of(kBlank, end);
  if (next == std::string_view::npos || line[next] == '#' || line[next] == ':') return std::nullopt;
  const bool opens = line[next] == '{' || line[next] == '[';
  return opens || line.find(':') == std::string_view::npos ? std::optional(end) : std::nullopt;
}

/// The column behind "key:" where the space is missing that makes it a key: "T1:0.1".
std::optional<std::size_t> find_tight_colon(std::string_view line) {
  const std::size_t begin = std::min(line.find_first_not_of(kBlank), line.size());
  const std::size_t end = line.find_first_not_of(kWordCharacters, begin);
  if (end == std::string_view::npos || end == begin || line[end] != ':' || end + 1 == line.size() ||
      kBlank.find(line[end + 1]) != std::string_view::npos)
    return std::nullopt;
  return end + 1;
}

/// A bracket and where it is.
struct Opened {
  char bracket;
  std::size_t line, column;
};

/// The innermost bracket that is open where the lines end; quoted texts and remarks have none.
std::optional<Opened> find_open_bracket(const std::vector<std::string_view>& lines) {
  std::vector<Opened> open;
  char quote = 0;
  for (std::size_t at = 0; at < lines.size(); ++at)
    for (std::size_t column = 0; column < lines[at].size(); ++column) {
      const char c = lines[at][column];
      const bool begins = column == 0 || (kBlank.find(lines[at][column - 1]) != kBlank.npos) ||
                          std::string_view("[{,:").find(lines[at][column - 1]) != kBlank.npos;
      if (quote != 0) {
        if (c == quote) quote = 0;
      } else if (c == '#' && begins) {
        break;
      } else if ((c == '"' || c == '\'') && begins) {
        quote = c;
      } else if (c == '[' || c == '{') {
        open.push_back({c, at, column});
      } else if ((c == ']' || c == '}') && !open.empty()) {
        open.pop_back();
      }
    }
  return open.empty() ? std::nullopt : std::optional(open.back());
}

/// The column of a function whose argument has a bracket, "diag([1, 0])", in no quotes.
std::optional<std::size_t> find_call(std::string_view line) {
  char quote = 0;
  for (std::size_t at = 0; at < line.size(); ++at) {
    const char c = line[at];
    if (c == quote || (quote == 0 && (c == '"' || c == '\''))) quote = quote == 0 ? c : 0;
    if (quote != 0 || line.substr(at, 2) != "([") continue;
    std::size_t begin = at;
    while (begin > 0 && kWordCharacters.find(line[begin - 1]) != std::string_view::npos) --begin;
    if (begin < at) return begin;
  }
  return std::nullopt;
}

/// Whether it has a sign that lists of numbers and names have not.
bool is_formula(std::string_view text) {
  return text.find_first_of("<>;*+/^") != std::string_view::npos;
}

}  // namespace

YamlError explained(const std::string& text, YamlError error) {
  const auto lines = lines_of(text, error.line);
  const std::string said = "YAML: " + error.message;
  // The reader may come to its error only behind the lines that are its cause.
  constexpr std::size_t kBack = 2;
  const std::size_t last = lines.size() - 1;
  const std::size_t least = last < kBack ? 0 : last - kBack;
  for (std::size_t at = last + 1; at-- > least;) {
    const std::string_view line = lines[at];
    if (const auto tab = find_tab(line))
      return {at, *tab, "YAML takes no tab in the indentation: use spaces"};
    if (const auto call = find_call(line); call && line.find_first_of("[{") < *call)
      return {at, *call,
              said + "; in { } and [ ] a formula with a bracket must be quoted, such as \"" +
                  std::string(line.substr(*call, line.find('(', *call) - *call)) + "([1, 2])\""};
    const auto list = find_value(line, "[{");
    // A list with signs of formulas is likely a matrix of the language without its quotes.
    const bool in_list = list && line[*list] == '[' && is_formula(line.substr(*list));
    if (const auto alias = find_value(line, "*&"); alias && at == last && !in_list)
      return {at, *alias,
              "a formula that begins with '" + std::string(1, line[*alias]) +
                  "' must be quoted: YAML takes it for the name of a node"};
    const bool nested = list && line.find_first_of("[{", *list + 1) != std::string_view::npos;
    if (nested && line.find(" in ") != std::string_view::npos)
      return {at, *list,
              said +
                  "; in { } and [ ] a text with a comma or a bracket must be quoted, such as "
                  "\"tau in [0, T]\""};
    if (in_list)
      return {
          at, *list,
          said + "; a formula that begins with '[' must be quoted, such as \"[P, Y; *, I] > 0\""};
    if (const auto quote = line.find("]'"); list && quote != std::string_view::npos)
      return {at, quote + 1, said + "; a formula must be quoted, such as \"[0, 1]'\""};
    if (list && line[*list] == '{' && line.find('[', *list) != std::string_view::npos)
      return {at, *list,
              said +
                  "; in { } a text with a comma or a bracket must be quoted, such as {forall: "
                  "\"tau in [0, T]\"}"};
    if (const auto colon = find_second_colon(line); colon && at == last)
      return {at, *colon, said + "; a text that holds ': ' must be quoted"};
    if (const auto end = find_key_without_colon(line);
        end && line.find_first_not_of(kBlank) == lines[last].find_first_not_of(kBlank))
      return {at, *end, said + "; a ':' is missing behind a key"};
    if (at == last || line.find_first_not_of(kBlank) == std::string_view::npos) continue;
    if (const auto value = find_tight_colon(line))
      return {at, *value, "a space is missing behind the ':' of a key"};
    if (is_bare(line)) return {at, line.size(), said + "; a ':' is missing behind a key"};
    break;
  }
  // The reader names the end of the file; the bracket that lacks its end is said instead.
  if (error.message.find("flow not found") != std::string::npos)
    if (const auto open = find_open_bracket(lines))
      return {open->line, open->column,
              std::string("the '") + open->bracket + "' here is not closed: a '" +
                  (open->bracket == '[' ? ']' : '}') + "' is missing"};
  if (error.message.find("block scalar") != std::string::npos) {
    error.message = "a text that begins with > or | must be quoted, such as \"> 0\"";
    return error;
  }
  const bool map = error.message.find("map") != std::string::npos;
  error.message = said + (map ? "; the keys of a mapping begin in one column" : "");
  return error;
}

}  // namespace gainsmith::io
