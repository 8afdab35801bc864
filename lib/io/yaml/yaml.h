// Internal to io: YAML with places, strict about keys.
//
// Readers ask a YamlMap for the keys that they know, and finish() refuses what nobody asked for: a
// misspelt key is never passed over. Scalars stay texts with the place of each character until a
// reader says what they are, so that YAML's own types (yes, 0o7, 1_000) mean nothing.
#pragma once

#include <yaml-cpp/yaml.h>

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "expr/text/ast.h"
#include "expr/text/text.h"
#include "io/schema/keys.h"
#include "model/problem.h"

namespace gainsmith::io {

class Sources;

/// A parsed file, with those that it is `like` (variant_yaml.h).
class YamlFile {
 public:
  /// InputError with the place for bytes that are no text in UTF-8, a YAML error, an empty file or
  /// several documents, and for a name of the file with control characters. `sources`: of a
  /// problem, which may name files; it must outlive this.
  YamlFile(std::string text, std::string file, Sources* sources = nullptr);

  const YAML::Node& root() const { return root_; }
  const std::string& text() const { return text_; }
  const std::string& file() const { return parts_.front().file; }

  /// The root of another file, whose nodes have places in that file. `name`: of it in the sources.
  YAML::Node add(std::string text, const std::string& file, const std::string& name);
  /// A mapping of entries that are in several files; `place` is its own.
  YAML::Node mapping(const std::vector<std::pair<YAML::Node, YAML::Node>>& entries,
                     const Place& place);
  /// The file that the node is in.
  const std::string& file(const YAML::Node& node) const { return part(node).file; }
  /// The name in the sources of the file `path` that the node names.
  std::string named_by(const YAML::Node& node, const std::string& path) const;
  /// InputError at the node when no file can be named here.
  Sources& sources(const YAML::Node& node) const;

  /// Where a node starts; just behind its key when it is left out.
  Place place(const YAML::Node& node) const;
  /// The scalar with the place of each of its characters, however it is quoted or folded.
  expr::Text scalar(const YAML::Node& node, const std::string& what) const;
  /// A formula of the language. InputError for a list or a mapping.
  expr::Expression expression(const YAML::Node& node, const std::string& what) const;
  /// Without control characters other than those of `allowed`: of a name none.
  std::string string(const YAML::Node& node, const std::string& what,
                     std::string_view allowed = "\n\t") const;
  /// A number written as such (not an expression).
  double number(const YAML::Node& node, const std::string& what) const;
  /// A number above 0.
  double positive(const YAML::Node& node, const std::string& what) const;

 private:
  /// A file within the text of all: after the first one they follow each other, from new lines on.
  struct Part {
    std::string file;
    std::string name;
    std::size_t first_line = 0;
    std::size_t begin = 0;  ///< byte
  };

  const Part& part(const YAML::Node& node) const;
  const Part& part_at(std::size_t offset) const;
  std::size_t end_of(const Part& part) const;
  /// yaml-cpp counts lines and columns from 0, and columns in bytes.
  std::size_t offset(const YAML::Mark& mark) const;
  std::size_t offset(std::size_t line, std::size_t column) const;
  Place place(const YAML::Mark& mark) const;
  Place place(std::size_t offset) const;
  /// Characters before a byte. The table of them keeps places on long lines cheap.
  int characters_to(std::size_t offset) const;
  /// Whether a node that is null is written there as a word, and is not just left out.
  bool is_written(const YAML::Node& null) const;

  /// Bytes between the entries of the table of characters.
  static constexpr std::size_t kStep = 256;

  std::string text_;
  std::vector<Part> parts_;
  std::vector<std::size_t> line_starts_;
  std::vector<int> characters_;  ///< before each kStep-th byte
  std::vector<std::pair<YAML::Node, Place>> mappings_;
  Sources* sources_;
  YAML::Node root_;
};

/// One "key: value".
struct YamlItem {
  std::string key;
  expr::Text key_text;
  Place place;
  YAML::Node value;
};

/// A mapping that knows which keys were asked for. finish() turns the others into errors.
class YamlMap {
 public:
  /// InputError when the node is no mapping or a key occurs twice. `what` names it in messages.
  YamlMap(const YamlFile& file, const YAML::Node& node, std::string what);
  /// One whose keys are in a table: asking for another key is std::logic_error.
  YamlMap(const YamlFile& file, const YAML::Node& node, std::string what, const Level& level);

  const std::vector<YamlItem>& items() const { return items_; }
  /// The item of an optional key.
  std::optional<YamlItem> find(const std::string& key);
  /// InputError where the key is missing, with a key that is likely to be meant.
  YamlItem require(const std::string& key);
  /// InputError at the first key that nobody asked for, with `advice` on it or else the nearest one
  /// that somebody did.
  void finish(const std::map<std::string, std::string>& advice = {}) const;
  const Place& place() const { return place_; }
  const std::string& what() const { return what_; }

 private:
  std::string what_;
  Place place_;
  std::vector<YamlItem> items_;
  std::vector<std::string> asked_;
  const Level* level_ = nullptr;
};

/// The items of an optional mapping; empty when the node is absent or null.
std::vector<YamlItem> items_of(const YamlFile& file, const std::optional<YamlItem>& item,
                               const std::string& what);

/// A matrix value: a scalar expression, a list (a row) or a list of lists (rows). Elements are
/// expressions.
model::Value value_of(const YamlFile& file, const YamlItem& item);

/// The same as an expression alone; a list of numbers is a column, or a row.
expr::Expression matrix_of(const YamlFile& file, const YamlItem& item, bool column = true);

/// The same of a datum, which may be a list of matrices: those of a family.
model::Value datum_of(const YamlFile& file, const YamlItem& item);

}  // namespace gainsmith::io
