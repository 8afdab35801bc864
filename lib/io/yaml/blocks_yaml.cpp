// The text "[B_11, B_12; *, B_22] < 0" put together from the blocks, and parsed like any other.
// Each character keeps its place in the file, so that errors are shown at the block.
#include "io/yaml/blocks_yaml.h"

#include <algorithm>
#include <map>
#include <utility>

#include "io/yaml/text_composer.h"

namespace gainsmith::io {

namespace {

class NamedBlocks {
 public:
  NamedBlocks(const YamlFile& file, const YamlItem& blocks) : file_(file), place_(blocks.place) {
    for (const YamlItem& row : items_of(file, blocks, "blocks")) at(row.key);
    for (const YamlItem& row : items_of(file, blocks, "blocks"))
      for (const YamlItem& entry : items_of(file, row, row.key)) add(row.key, entry);
    if (names_.empty()) throw InputError(place_, "blocks: expected rows, name: {name: block}");
  }

  /// The inequality of the whole matrix, n x n blocks by n names.
  expr::Expression compared(const YamlItem& is) {
    const expr::Text relation = file_.scalar(is.value, "is");
    // Nothing precedes the sign: the left side is made here.
    const char* const kExpected = "is: expected a comparison with 0, < 0 or \"> 0\"";
    if (relation.str().find_first_of("<>") != relation.str().find_first_not_of(' '))
      throw InputError(relation.place(0), kExpected);
    TextComposer composer(place_.file);
    composer.punctuation("[", place_);
    for (std::size_t i = 0; i < names_.size(); ++i)
      for (std::size_t j = 0; j < names_.size(); ++j) {
        if (j > 0 || i > 0) composer.punctuation(j > 0 ? "," : ";", place_);
        add_entry(i, j, composer);
      }
    composer.punctuation("]", place_);
    composer.text(relation);
    expr::Expression expression = composer.parse(place_);
    const expr::Node& root = *expression.root;
    if (root.kind != expr::NodeKind::compare || root.children.size() != 2 ||
        root.children[0]->kind != expr::NodeKind::block)
      throw InputError(relation.place(0), kExpected);
    return expression;
  }

 private:
  /// The row of a name; a new name gets the next one.
  std::size_t at(const std::string& name) {
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found != names_.end()) return static_cast<std::size_t>(found - names_.begin());
    names_.push_back(name);
    return names_.size() - 1;
  }

  void add(const std::string& row, const YamlItem& entry) {
    const std::size_t i = at(row);
    const std::size_t j = at(entry.key);
    if (i != j && entries_.contains({j, i}))
      throw InputError(entry.place, "the block " + row + ", " + entry.key +
                                        " is given on the other side of the diagonal too, as " +
                                        entry.key + ", " + row + "; one of them is enough");
    entries_.emplace(std::pair(i, j), file_.scalar(entry.value, entry.key));
  }

  /// Element (i, j): "*" below the diagonal, the block, or the transpose of the one given at (j,
  /// i).
  void add_entry(std::size_t i, std::size_t j, TextComposer& composer) const {
    if (i > j) return composer.punctuation("*", place_);
    if (const auto above = entries_.find({i, j}); above != entries_.end())
      return composer.bracketed(above->second);
    const auto below = entries_.find({j, i});
    if (below == entries_.end()) return composer.punctuation("0", place_);
    composer.bracketed(below->second);
    composer.punctuation("'", place_);
  }

  const YamlFile& file_;
  Place place_;
  std::vector<std::string> names_;
  std::map<std::pair<std::size_t, std::size_t>, expr::Text> entries_;
};

}  // namespace

expr::Expression named_blocks(const YamlFile& file, const YamlItem& blocks, const YamlItem& is) {
  return NamedBlocks(file, blocks).compared(is);
}

}  // namespace gainsmith::io
