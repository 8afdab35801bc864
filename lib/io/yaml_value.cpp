// Matrices of lists.
#include <string>
#include <utility>
#include <vector>

#include "expr/parser.h"
#include "io/yaml.h"

namespace gainsmith::io {

namespace {

/// A list of matrices is one of lists of rows.
bool is_list_of_matrices(const YAML::Node& node) {
  for (const auto& element : node)
    if (element.IsSequence() && element.size() > 0 && element[0].IsSequence()) return true;
  return false;
}

/// Quoted, so that a ';' in it is no slip.
bool is_quoted_matrix(const YAML::Node& node) {
  return node.IsScalar() && node.Tag() == "!" && node.Scalar().starts_with('[');
}

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
    if (part.str().find(';') != std::string::npos && !is_quoted_matrix(node))
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
  if (is_list_of_matrices(node)) {
    model::Value result{item.key, {}, false, file.place(node), true};
    for (const auto& element : node)
      result.matrices.push_back(
          value_of(file, {item.key, item.key_text, file.place(element), element}));
    return result;
  }
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
    if (width == 0) throw InputError(file.place(row), item.key + ": this row is empty");
    if (row.size() != width)
      throw InputError(file.place(row), item.key + ": this row has " + std::to_string(row.size()) +
                                            " elements, the first row has " +
                                            std::to_string(width));
    for (std::size_t j = 0; j < row.size(); ++j) {
      if (j > 0) composer.punctuation(",", file.place(row[j]));
      composer.scalar(row[j], item.key);
    }
  }
  composer.punctuation("]", file.place(node));
  return {item.key, composer.parse(file.place(node)), flat, file.place(node), true};
}

}  // namespace gainsmith::io
