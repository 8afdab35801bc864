// YAML with places. yaml-cpp counts lines and bytes from 0, and has no place of what is left out or
// within a scalar; both are found from the text here.
//
// All files of a problem are one text, one below the other, so that a mark of a node says its file
// too.
#include "io/yaml/yaml.h"

#include <yaml-cpp/depthguard.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <iterator>
#include <map>
#include <sstream>
#include <string_view>
#include <utility>

#include "base/nearest.h"
#include "base/number.h"
#include "base/stop.h"
#include "base/utf8.h"
#include "base/visible.h"
#include "expr/text/parser.h"
#include "io/json/json_place.h"
#include "io/sources.h"
#include "io/yaml/survey.h"
#include "io/yaml/yaml_error.h"

namespace gainsmith::io {

namespace {

bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

/// The byte at which each line begins.
std::vector<std::size_t> starts_of_lines(const std::string& text) {
  std::vector<std::size_t> starts = {0};
  for (std::size_t at = 0; at < text.size(); ++at)
    if (text[at] == '\n') starts.push_back(at + 1);
  return starts;
}

/// The length of the UTF-8 character at `at`; 0 when there is none.
std::size_t character_length(const std::string& text, std::size_t at) {
  const auto first = static_cast<unsigned char>(text[at]);
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xC2 ? 0
                             : first < 0xE0 ? 2
                             : first < 0xF0 ? 3
                             : first < 0xF5 ? 4
                                            : 0;
  if (at + length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if (!is_continuation(text[at + i])) return 0;
  return length;
}

int count_characters(std::string_view bytes) {
  return static_cast<int>(std::ranges::count_if(bytes, [](char c) { return !is_continuation(c); }));
}

/// InputError for control characters and for bytes that are no UTF-8, with line and column.
void refuse_non_text(const std::string& text, const std::string& file) {
  const auto refuse = [&](std::size_t at, const std::string& message) {
    throw InputError(place_of(text, file, at), message);
  };
  for (std::size_t at = 0; at < text.size();) {
    const auto byte = static_cast<unsigned char>(text[at]);
    if (byte < 0x20 && !is_space(text[at]))
      refuse(at, "this is no text file: it holds control characters");
    const std::size_t length = character_length(text, at);
    if (length == 0) refuse(at, "this is no UTF-8 text");
    at += length;
  }
}

/// Names become lines of other files and of a terminal.
void refuse_control(const std::string& text, std::string_view allowed, const std::string& what,
                    const Place& place) {
  if (control_character(text, allowed) != std::string::npos)
    throw InputError(place, what + ": control characters are no part of a " +
                                (allowed.empty() ? "name: '" : "text: '") + visible(text, allowed) +
                                "'");
}

std::string without_byte_order_mark(std::string text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (text.starts_with(kMark)) text.erase(0, kMark.size());
  return text;
}

/// Walks along the text of a file, counting lines and characters.
class Cursor {
 public:
  Cursor(std::string_view text, std::size_t at, expr::Position position)
      : text_(text), at_(at), position_(position) {}

  /// The byte here or further on; 0 past the end.
  char peek(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }
  bool at_end() const { return at_ >= text_.size(); }
  expr::Position position() const { return position_; }

  void advance(std::size_t characters = 1) {
    for (; characters > 0 && !at_end(); --characters) {
      ++position_.column;
      if (text_[at_] == '\n') position_ = {position_.line + 1, 1};
      ++at_;
      while (!at_end() && is_continuation(text_[at_])) ++at_;
    }
  }
  void skip_spaces() {
    while (!at_end() && is_space(peek())) advance();
  }

 private:
  std::string_view text_;
  std::size_t at_;
  expr::Position position_;
};

/// The number of characters of the escape at the cursor in a double-quoted scalar.
std::size_t escape_length(const Cursor& cursor) {
  switch (cursor.peek(1)) {
    case 'x':
      return 4;
    case 'u':
      return 6;
    case 'U':
      return 10;
    default:
      return 2;
  }
}

}  // namespace

YamlFile::YamlFile(std::string text, std::string file, Sources* sources)
    : sources_(sources), root_(add(std::move(text), file, "")) {}

/// Adds the text below those that are there. Its nodes are parsed from a text with as many empty
/// lines in front, which makes their marks those of the whole.
YAML::Node YamlFile::add(std::string text, const std::string& file, const std::string& name) {
  refuse_control(file, "", "the name of the file", {file});
  text = without_byte_order_mark(std::move(text));
  refuse_non_text(text, file);
  // A value that is left out at the end of a file is placed before the next one.
  if (!parts_.empty()) text_ += '\n';
  const std::size_t first_line = parts_.empty() ? 0 : starts_of_lines(text_).size() - 1;
  parts_.push_back({file, name, first_line, text_.size()});
  text_ += text;
  line_starts_ = starts_of_lines(text_);
  characters_.clear();
  for (std::size_t at = 0; at <= text_.size(); at += kStep) {
    const auto before =
        std::string_view(text_).substr(at < kStep ? 0 : at - kStep, std::min(at, kStep));
    characters_.push_back(count_characters(before) +
                          (characters_.empty() ? 0 : characters_.back()));
  }
  // So its marks are those in the text of all.
  text.insert(0, first_line, '\n');
  // YAML::LoadAll never ends on some broken files, so at most two documents are inspected.
  Survey survey([&](const YAML::Mark& mark, const std::string& message) {
    throw InputError(place(mark), "YAML: " + message);
  });
  YAML::Node root;
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    while (survey.starts.size() < 2 && parser.HandleNextDocument(survey)) {
    }
    root.reset(YAML::Load(text));
  } catch (const YAML::DeepRecursion& error) {
    throw InputError(place(error.mark), "YAML: lists or mappings are nested too deeply");
  } catch (const YAML::Exception& error) {
    if (error.mark.line < 0) throw InputError({file}, "YAML: " + error.msg);
    const auto line = static_cast<std::size_t>(error.mark.line);
    const YamlError cause =
        explained(text, {line, static_cast<std::size_t>(error.mark.column), error.msg});
    throw InputError(place(offset(cause.line, cause.column)), cause.message);
  }
  if (survey.starts.size() > 1)
    throw InputError(place(survey.starts[1]), "expected one YAML document, found a second one");
  if (survey.starts.empty() || root.IsNull())
    throw InputError({file}, "the file is empty; expected a mapping such as 'problem: NAME'");
  return root;
}

/// yaml-cpp gives a node that is made no mark: its place is kept beside it.
YAML::Node YamlFile::mapping(const std::vector<std::pair<YAML::Node, YAML::Node>>& entries,
                             const Place& place) {
  YAML::Node result(YAML::NodeType::Map);
  for (const auto& [key, value] : entries) result.force_insert(key, value);
  mappings_.emplace_back(result, place);
  return result;
}

const YamlFile::Part& YamlFile::part_at(std::size_t offset) const {
  const auto next = std::ranges::upper_bound(parts_, offset, {}, &Part::begin);
  return next == parts_.begin() ? parts_.front() : *std::prev(next);
}

const YamlFile::Part& YamlFile::part(const YAML::Node& node) const {
  return node.Mark().line < 0 ? parts_.front() : part_at(offset(node.Mark()));
}

std::size_t YamlFile::end_of(const Part& part) const {
  const auto next = static_cast<std::size_t>(&part - parts_.data()) + 1;
  return next < parts_.size() ? parts_[next].begin : text_.size();
}

std::string YamlFile::named_by(const YAML::Node& node, const std::string& path) const {
  if (path.empty()) throw InputError(place(node), "expected the name of a file");
  return Sources::name_of(path, part(node).name);
}

Sources& YamlFile::sources(const YAML::Node& node) const {
  if (sources_ == nullptr)
    throw InputError(place(node), "a file may be named in a problem, not here");
  return *sources_;
}

std::size_t YamlFile::offset(std::size_t line, std::size_t column) const {
  if (line >= line_starts_.size()) return text_.size();
  return std::min(line_starts_[line] + column, text_.size());
}

std::size_t YamlFile::offset(const YAML::Mark& mark) const {
  if (mark.line < 0) return text_.size();
  return offset(static_cast<std::size_t>(mark.line), static_cast<std::size_t>(mark.column));
}

Place YamlFile::place(const YAML::Mark& mark) const {
  if (mark.line < 0) return {file()};
  return place(offset(mark));
}

/// Characters before a byte: a table of every kStep-th one, and the rest counted.
int YamlFile::characters_to(std::size_t offset) const {
  const std::size_t step = offset / kStep;
  return characters_[step] +
         count_characters(std::string_view(text_).substr(step * kStep, offset - step * kStep));
}

Place YamlFile::place(std::size_t offset) const {
  const auto next = std::ranges::upper_bound(line_starts_, offset);
  const std::size_t start = *std::prev(next);
  const Part& part = part_at(offset);
  return {part.file,
          static_cast<int>(next - line_starts_.begin()) - static_cast<int>(part.first_line),
          1 + characters_to(offset) - characters_to(start)};
}

Place YamlFile::place(const YAML::Node& node) const {
  const YAML::Mark mark = node.Mark();
  if (mark.line < 0)
    for (const auto& [mapping, place] : mappings_)
      if (mapping.is(node)) return place;
  if (!node.IsNull() || mark.line < 0) return place(mark);
  // The mark of a value that is left out is at what comes next; show where it is missing.
  std::size_t at = offset(mark);
  if (is_written(node)) return place(at);
  while (at > 0 && is_space(text_[at - 1])) --at;
  return place(at);
}

/// Whether the null is "~" or a word that begins with n, and not a value that is left out.
bool YamlFile::is_written(const YAML::Node& null) const {
  if (null.Mark().line < 0) return false;
  const std::size_t at = offset(null.Mark());
  return at < text_.size() && (text_[at] == '~' || text_[at] == 'n' || text_[at] == 'N');
}

/// A scalar as it is, whatever YAML takes it for.
std::string YamlFile::string(const YAML::Node& node, const std::string& what,
                             std::string_view allowed) const {
  if (!node.IsScalar()) {
    const std::string found = node.IsMap()        ? "a mapping"
                              : node.IsSequence() ? "a list"
                              : is_written(node)  ? "nothing, as YAML reads null and ~"
                                                  : "nothing";
    throw InputError(place(node), what + ": expected a text, found " + found);
  }
  refuse_control(node.Scalar(), allowed, what, place(node));
  return node.Scalar();
}

/// The place of each byte of a value. YAML folds lines, joins spaces and reads escapes, so the
/// value is another text than the file's: both are walked along side by side.
expr::Text YamlFile::scalar(const YAML::Node& node, const std::string& what) const {
  const std::string value = string(node, what);
  const Place start = place(node.Mark());
  const Part& part = this->part(node);
  const std::string_view text = std::string_view(text_).substr(0, end_of(part));
  Cursor cursor(text, offset(node.Mark()), {start.line, start.column});
  // Properties: !!str and &anchor.
  while (cursor.peek() == '!' || cursor.peek() == '&') {
    while (!cursor.at_end() && !is_space(cursor.peek())) cursor.advance();
    cursor.skip_spaces();
  }
  const char first = cursor.peek();
  const char quote = first == '"' || first == '\'' ? first : '\0';
  if (quote != '\0') cursor.advance();
  if (first == '|' || first == '>')
    while (!cursor.at_end() && cursor.peek() != '\n') cursor.advance();
  // YAML changes only white space and escapes: walk along both texts and match the characters.
  std::vector<expr::Position> positions;
  for (const char c : value) {
    if (is_continuation(c)) {
      positions.push_back(positions.empty() ? cursor.position() : positions.back());
      continue;
    }
    if (!is_space(c)) cursor.skip_spaces();
    while (quote == '"' && cursor.peek() == '\\' && is_space(cursor.peek(1)) && !is_space(c)) {
      cursor.advance();  // a backslash that joins lines
      cursor.skip_spaces();
    }
    if (quote == '\'' && c == '\'' && cursor.peek(1) == '\'') cursor.advance();
    positions.push_back(cursor.position());
    if (quote == '"' && cursor.peek() == '\\') {
      cursor.advance(escape_length(cursor));
    } else if (cursor.peek() == c) {
      cursor.advance();
    }
  }
  // yaml-cpp takes the end of the file for the closing quote.
  if (quote != '\0') {
    while (cursor.peek() == '\\' || is_space(cursor.peek())) cursor.advance();
    if (cursor.at_end()) throw InputError(start, what + ": the quotation mark is not closed");
  }
  positions.push_back(cursor.position());
  return {value, part.file, std::move(positions)};
}

expr::Expression YamlFile::expression(const YAML::Node& node, const std::string& what) const {
  const bool is_number = !what.empty() && what.find_first_not_of("0123456789") == what.npos;
  if (node.IsNull())
    throw InputError(place(node),
                     what + ": the formula is missing" +
                         (is_written(node) ? "; YAML reads null and ~ as nothing"
                          : is_number      ? "; a decimal is written with a point, not with a comma"
                                           : ""));
  if (node.IsSequence())
    throw InputError(
        place(node),
        what + ": expected an expression, found a list; quote a matrix: \"[a, b; c, d]\"");
  if (node.IsMap())
    throw InputError(place(node), what + ": expected an expression, found a mapping");
  return expr::parse(scalar(node, what));
}

double YamlFile::number(const YAML::Node& node, const std::string& what) const {
  const std::string text = string(node, what);
  const auto value = parse_decimal(text);
  if (!value) throw InputError(place(node), what + ": expected a number, found '" + text + "'");
  return *value;
}

double YamlFile::positive(const YAML::Node& node, const std::string& what) const {
  const double value = number(node, what);
  if (!(value > 0)) throw InputError(place(node), what + ": expected a positive number");
  return value;
}

}  // namespace gainsmith::io
