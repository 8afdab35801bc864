// Matrices of lists: [1, 2] and [[1, 2], [3, 4]] become the texts [1, 2] and [1, 2; 3, 4] of the
// language, whose elements keep their places in the file. So they are parsed and checked like any
// other formula.
#include <string>

#include "expr/text/parser.h"
#include "io/yaml/data_file_yaml.h"
#include "io/yaml/text_composer.h"
#include "io/yaml/yaml.h"

namespace gainsmith::io {

namespace {

/// A list of matrices is one of lists of rows, or of files.
bool is_list_of_matrices(const YAML::Node& node) {
  for (const auto& element : node)
    if (names_file(element) ||
        (element.IsSequence() && element.size() > 0 && element[0].IsSequence()))
      return true;
  return false;
}

/// Quoted, so that a ';' in it is no slip.
bool is_quoted_matrix(const YAML::Node& node) {
  return node.IsScalar() && node.Tag() == "!" && node.Scalar().starts_with('[');
}

/// One element: an expression, in brackets of its own.
void add_scalar(const YamlFile& file, const YAML::Node& node, const std::string& what,
                TextComposer& composer) {
  if (node.IsSequence() || node.IsMap())
    throw InputError(file.place(node), what + ": expected a number or an expression here, found " +
                                           (node.IsMap() ? "a mapping" : "a list"));
  const expr::Text part = file.scalar(node, what);
  if (part.str().find(';') != std::string::npos && !is_quoted_matrix(node))
    throw InputError(file.place(node),
                     what + ": a matrix with ';' must be quoted: \"[a, b; c, d]\"");
  expr::parse_element(part);
  composer.bracketed(part);
}

std::string counted(std::size_t elements) {
  return std::to_string(elements) + (elements == 1 ? " element" : " elements");
}

/// Of a row [1 2], which YAML reads as one text.
std::string advice_on_row(const YAML::Node& row) {
  for (const YAML::Node& element : row) {
    const std::string text = element.IsScalar() ? element.Scalar() : "";
    const std::size_t gap = text.find(' ');
    const bool numbers = text.find_first_not_of("0123456789.eE+- ") == std::string::npos;
    if (numbers && gap != std::string::npos) return "; a comma is missing in '" + text + "'";
  }
  return {};
}

/// `between`: the numbers of a list.
model::Value matrix(const YamlFile& file, const YamlItem& item, const char* between) {
  const YAML::Node& node = item.value;
  if (names_file(node)) return matrix_of_file(file, item);
  if (node.IsMap()) refuse_mapping(file, item);
  if (!node.IsSequence())
    return {item.key, file.expression(node, item.key), false, file.place(node)};
  if (node.size() == 0) throw InputError(file.place(node), item.key + ": the list is empty");
  const bool flat = !node[0].IsSequence();
  TextComposer composer(file.file(node));
  composer.punctuation("[", file.place(node));
  std::size_t width = 0;
  for (std::size_t i = 0; i < node.size(); ++i) {
    const YAML::Node row = node[i];
    if (flat || !row.IsSequence()) {
      if (!flat) throw InputError(file.place(row), item.key + ": expected a row [a, b, ...] here");
      if (i > 0) composer.punctuation(between, file.place(row));
      add_scalar(file, row, item.key, composer);
      continue;
    }
    if (i > 0) composer.punctuation(";", file.place(row));
    if (i == 0) width = row.size();
    if (width == 0) throw InputError(file.place(row), item.key + ": this row is empty");
    if (row.size() != width)
      throw InputError(file.place(row), item.key + ": this row has " + counted(row.size()) +
                                            ", the first row has " + counted(width) +
                                            advice_on_row(row));
    for (std::size_t j = 0; j < row.size(); ++j) {
      if (j > 0) composer.punctuation(",", file.place(row[j]));
      add_scalar(file, row[j], item.key, composer);
    }
  }
  composer.punctuation("]", file.place(node));
  return {item.key, composer.parse(file.place(node)), flat, file.place(node), true};
}

}  // namespace

model::Value value_of(const YamlFile& file, const YamlItem& item) {
  return matrix(file, item, ",");
}

expr::Expression matrix_of(const YamlFile& file, const YamlItem& item, bool column) {
  return matrix(file, item, column ? ";" : ",").value;
}

/// A list of lists of rows, or of files, is a family of matrices.
model::Value datum_of(const YamlFile& file, const YamlItem& item) {
  if (item.value.IsScalar()) refuse_bare_path(file, item);
  if (!item.value.IsSequence() || !is_list_of_matrices(item.value)) return value_of(file, item);
  model::Value result{item.key, {}, false, file.place(item.value), true};
  for (const auto& element : item.value)
    result.matrices.push_back(
        datum_of(file, {item.key, item.key_text, file.place(element), element}));
  return result;
}

}  // namespace gainsmith::io
