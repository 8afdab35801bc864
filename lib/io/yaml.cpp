#include "io/yaml.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "base/nearest.h"
#include "base/number.h"
#include "expr/parser.h"

namespace gainsmith::io {

namespace {

bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

std::vector<std::size_t> starts_of_lines(const std::string& text) {
  std::vector<std::size_t> starts = {0};
  for (std::size_t at = 0; at < text.size(); ++at)
    if (text[at] == '\n') starts.push_back(at + 1);
  return starts;
}

void refuse_non_text(const std::string& text, const std::string& file) {
  const auto found = std::find_if(text.begin(), text.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x20 && c != '\n' && c != '\t' && c != '\r';
  });
  if (found == text.end()) return;
  const auto line = 1 + std::count(text.begin(), found, '\n');
  throw InputError({file, static_cast<int>(line), 0},
                   "this is no text file: it holds control characters");
}

}  // namespace

YamlFile::YamlFile(std::string text, std::string file)
    : text_(std::move(text)), file_(std::move(file)), line_starts_(starts_of_lines(text_)) {
  refuse_non_text(text_, file_);
  std::vector<YAML::Node> documents;
  try {
    documents = YAML::LoadAll(text_);
  } catch (const YAML::Exception& error) {
    throw InputError({file_, error.mark.line + 1, error.mark.column + 1}, "YAML: " + error.msg);
  }
  if (documents.empty() || documents.front().IsNull())
    throw InputError({file_}, "the file is empty; expected a mapping such as 'problem: NAME'");
  if (documents.size() > 1)
    throw InputError(place(documents[1]), "expected one YAML document, found a second one");
  root_ = documents.front();
}

Place YamlFile::place(const YAML::Node& node) const {
  const YAML::Mark mark = node.Mark();
  return {file_, mark.line + 1, mark.column + 1};
}

std::size_t YamlFile::offset(int line, int column) const {
  if (line < 0 || static_cast<std::size_t>(line) >= line_starts_.size()) return text_.size();
  std::size_t at = line_starts_[static_cast<std::size_t>(line)];
  for (; column > 0 && at < text_.size(); --column) {
    ++at;
    while (at < text_.size() && (static_cast<unsigned char>(text_[at]) & 0xC0U) == 0x80U) ++at;
  }
  return at;
}

std::string YamlFile::string(const YAML::Node& node, const std::string& what) const {
  if (!node.IsScalar()) {
    std::string found = node.IsMap() ? "a mapping" : node.IsSequence() ? "a list" : "nothing";
    throw InputError(place(node), what + ": expected a text, found " + found);
  }
  return node.Scalar();
}

expr::Text YamlFile::scalar(const YAML::Node& node, const std::string& what) const {
  const std::string value = string(node, what);
  const YAML::Mark mark = node.Mark();
  std::size_t at = offset(mark.line, mark.column);
  const auto started = std::upper_bound(line_starts_.begin(), line_starts_.end(), at);
  int line = static_cast<int>(started - line_starts_.begin());
  int column = mark.column + 1;
  const auto advance = [&] {
    if (text_[at] == '\n') {
      ++line;
      column = 0;
    }
    ++at;
    while (at < text_.size() && (static_cast<unsigned char>(text_[at]) & 0xC0U) == 0x80U) ++at;
    ++column;
  };
  if (at < text_.size() && (text_[at] == '"' || text_[at] == '\'')) advance();
  if (at < text_.size() && (text_[at] == '|' || text_[at] == '>'))
    while (at < text_.size() && text_[at] != '\n') advance();
  // YAML changes only white space and escapes: walk along both texts and match the other
  // characters.
  std::vector<expr::Position> positions;
  for (const char c : value) {
    if (!is_space(c)) {
      while (at < text_.size() && is_space(text_[at])) advance();
      if (at < text_.size() && text_[at] == '\'' && c == '\'' && at + 1 < text_.size() &&
          text_[at + 1] == '\'' && text_[offset(mark.line, mark.column)] == '\'') {
        advance();  // '' stands for one quote in a single-quoted scalar
      }
    }
    positions.push_back({line, column});
    if (at < text_.size() && text_[at] == c) advance();
  }
  positions.push_back({line, column});
  return {value, file_, std::move(positions)};
}

expr::Expression YamlFile::expression(const YAML::Node& node, const std::string& what) const {
  if (node.IsSequence())
    throw InputError(
        place(node),
        what + ": expected an expression, found a list; quote a matrix: \"[a, b; c, d]\"");
  return expr::parse(scalar(node, what));
}

double YamlFile::number(const YAML::Node& node, const std::string& what) const {
  const std::string text = string(node, what);
  const auto value = parse_decimal(text);
  if (!value) throw InputError(place(node), what + ": expected a number, found '" + text + "'");
  return *value;
}

YamlMap::YamlMap(const YamlFile& file, const YAML::Node& node, std::string what)
    : what_(std::move(what)), place_(file.place(node)) {
  if (!node.IsMap())
    throw InputError(place_, what_ + ": expected a mapping 'key: value', found " +
                                 (node.IsSequence() ? "a list"
                                  : node.IsNull()   ? "nothing"
                                                    : "'" + node.Scalar() + "'"));
  for (const auto& entry : node) {
    const std::string key = file.string(entry.first, what_ + ": a key");
    const Place place = file.place(entry.first);
    for (const YamlItem& earlier : items_)
      if (earlier.key == key)
        throw InputError(place, what_ + ": the key '" + key + "' stands twice; first in line " +
                                    std::to_string(earlier.place.line));
    items_.push_back({key, file.scalar(entry.first, key), place, entry.second});
  }
}

std::optional<YamlItem> YamlMap::find(const std::string& key) {
  asked_.push_back(key);
  for (const YamlItem& item : items_)
    if (item.key == key) return item;
  return std::nullopt;
}

YamlItem YamlMap::require(const std::string& key) {
  if (auto item = find(key)) return *item;
  // A misspelt key explains the missing one.
  for (const YamlItem& item : items_)
    if (std::find(asked_.begin(), asked_.end(), item.key) == asked_.end() &&
        nearest(item.key, {key}))
      throw InputError(item.place,
                       what_ + ": unknown key '" + item.key + "'; did you mean '" + key + "'?");
  throw InputError(place_, what_ + ": the key '" + key + "' is missing");
}

void YamlMap::finish() const {
  for (const YamlItem& item : items_)
    if (std::find(asked_.begin(), asked_.end(), item.key) == asked_.end())
      throw InputError(item.place,
                       what_ + ": unknown key '" + item.key + "'" + suggestion(item.key, asked_));
}

std::vector<YamlItem> items_of(const YamlFile& file, const std::optional<YamlItem>& item,
                               const std::string& what) {
  if (!item || item->value.IsNull()) return {};
  return YamlMap(file, item->value, what).items();
}

namespace {

/// Text put together from scalars and punctuation, each character with its place.
class Composer {
 public:
  explicit Composer(const YamlFile& file) : file_(file) {}

  void punctuation(const std::string& mark, const Place& place) {
    text_ += mark;
    positions_.insert(positions_.end(), mark.size(), {place.line, place.column});
  }

  void scalar(const YAML::Node& node, const std::string& what) {
    if (node.IsSequence() || node.IsMap())
      throw InputError(file_.place(node), what +
                                              ": expected a number or an expression here, found " +
                                              (node.IsMap() ? "a mapping" : "a list"));
    const expr::Text part = file_.scalar(node, what);
    if (part.str().find(';') != std::string::npos)
      throw InputError(file_.place(node),
                       what + ": a matrix with ';' must be quoted: \"[a, b; c, d]\"");
    expr::parse(part);
    // In brackets of its own an element cannot be torn apart by what stands around it.
    punctuation("(", part.place(0));
    text_ += part.str();
    for (std::size_t at = 0; at < part.str().size(); ++at) {
      const Place place = part.place(at);
      positions_.push_back({place.line, place.column});
    }
    punctuation(")", part.place(part.str().size()));
  }

  expr::Expression parse(const Place& end) {
    positions_.push_back({end.line, end.column});
    return expr::parse({text_, file_.file(), std::move(positions_)});
  }

 private:
  const YamlFile& file_;
  std::string text_;
  std::vector<expr::Position> positions_;
};

}  // namespace

model::Value value_of(const YamlFile& file, const YamlItem& item) {
  const YAML::Node& node = item.value;
  if (!node.IsSequence())
    return {item.key, file.expression(node, item.key), false, file.place(node)};
  if (node.size() == 0) throw InputError(file.place(node), item.key + ": the list is empty");
  const bool flat = !node[0].IsSequence();
  Composer composer(file);
  composer.punctuation("[", file.place(node));
  std::size_t width = 0;
  for (std::size_t i = 0; i < node.size(); ++i) {
    const YAML::Node row = node[i];
    if (flat || !row.IsSequence()) {
      if (!flat) throw InputError(file.place(row), item.key + ": expected a row [a, b, ...] here");
      if (i > 0) composer.punctuation(",", file.place(row));
      composer.scalar(row, item.key);
      continue;
    }
    if (i > 0) composer.punctuation(";", file.place(row));
    if (i == 0) width = row.size();
    if (row.size() != width || width == 0)
      throw InputError(file.place(row), item.key + ": this row has " + std::to_string(row.size()) +
                                            " elements, the first row has " +
                                            std::to_string(width));
    for (std::size_t j = 0; j < row.size(); ++j) {
      if (j > 0) composer.punctuation(",", file.place(row[j]));
      composer.scalar(row[j], item.key);
    }
  }
  composer.punctuation("]", file.place(node));
  return {item.key, composer.parse(file.place(node)), flat, file.place(node)};
}

}  // namespace gainsmith::io
