// Matrices of files: by the key of their format to its reader, then as a text of the language with
// the decimals of the file.
#include "io/yaml/data_file_yaml.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "base/nearest.h"
#include "io/matrix/csv_matrix.h"
#include "io/matrix/json_matrix.h"
#include "io/matrix/mat_matrix.h"
#include "io/matrix/npy_matrix.h"
#include "io/schema/keys.h"
#include "io/sources.h"

namespace gainsmith::io {

namespace {

/// Which matrix of which file.
struct Wanted {
  std::string name;  ///< within the file
  Place place;       ///< of that name, or of the path
};

/// A format of files, by the key that names it in a problem.
struct Format {
  const char* key;
  bool has_names;  ///< one file may hold several matrices
  FileMatrix (*read)(const std::string& bytes, const std::string& path, const Wanted& wanted);
};

constexpr std::array kFormats = {
    Format{"csv", false,
           [](const std::string& bytes, const std::string& path, const Wanted&) {
             return csv_matrix(bytes, path);
           }},
    Format{"npy", false,
           [](const std::string& bytes, const std::string& path, const Wanted& wanted) {
             return npy_matrix(bytes, path, wanted.place);
           }},
    Format{"mat", true,
           [](const std::string& bytes, const std::string& path, const Wanted& wanted) {
             return mat_matrix(bytes, path, wanted.name, wanted.place);
           }},
    Format{"json", true,
           [](const std::string& bytes, const std::string& path, const Wanted& wanted) {
             return json_matrix(bytes, path, wanted.name, wanted.place);
           }},
};

/// The matrix as a text of the language, element by element. `positions` are those of the elements
/// in their file; without them all have the place of the node.
model::Value value(const YamlItem& item, const FileMatrix& found, const std::string& file,
                   const Place& place) {
  const model::StatedMatrix& matrix = found.matrix;
  std::string text = "[";
  const expr::Position here{place.line, place.column};
  std::vector<expr::Position> positions = {here};
  for (std::size_t k = 0; k < matrix.elements.size(); ++k) {
    // A formula keeps where its characters come from: here each element where it is in its file.
    const expr::Position at = found.positions.empty() ? here : found.positions[k];
    if (k > 0) text += k % static_cast<std::size_t>(matrix.cols) == 0 ? ';' : ',';
    text += matrix.elements[k];
    positions.resize(text.size(), at);
  }
  text += ']';
  positions.resize(text.size() + 1, positions.back());
  const std::string& of = found.positions.empty() ? place.file : file;
  return {item.key,
          expr::parse({std::move(text), of, std::move(positions)}),
          matrix.flat,
          place,
          matrix.flat,
          {},
          file + (matrix.key.empty() ? "" : ": " + matrix.key)};
}

/// The keys of all formats, for suggestions.
std::vector<std::string> format_keys() {
  std::vector<std::string> keys;
  for (const Format& format : kFormats) keys.emplace_back(format.key);
  return keys;
}

}  // namespace

bool names_file(const YAML::Node& node) {
  if (!node.IsMap()) return false;
  for (const Format& format : kFormats)
    if (node[format.key]) return true;
  return false;
}

void refuse_mapping(const YamlFile& file, const YamlItem& item) {
  const YAML::Node& node = item.value;
  const auto first = node.begin();
  std::string found = "an empty mapping";
  if (first != node.end() && first->first.IsScalar()) {
    const std::string& key = first->first.Scalar();
    found = "a mapping with '" + key + "'";
    if (key != "name") found += suggestion(key, format_keys());
  }
  throw InputError(file.place(node), item.key +
                                         ": expected an expression, or a matrix of a file as in "
                                         "{csv: FILE}; found " +
                                         found);
}

void refuse_bare_path(const YamlFile& file, const YamlItem& item) {
  const std::string& text = item.value.Scalar();
  for (const std::string& key : format_keys())
    if (text.ends_with("." + key) && text.find_first_of("()[]*+ '\"") == std::string::npos)
      throw InputError(file.place(item.value),
                       item.key + ": a matrix of a file is written {" + key + ": " + text + "}");
}

model::Value matrix_of_file(const YamlFile& file, const YamlItem& item) {
  YamlMap map(file, item.value, item.key, keys::data_file);
  const Format* format = nullptr;
  std::optional<YamlItem> path;
  for (const Format& each : kFormats)
    if (const auto found = map.find(each.key)) {
      if (format != nullptr)
        throw InputError(found->place, "either '" + std::string(format->key) + "' or '" + each.key +
                                           "', not both");
      format = &each;
      path = found;
    }
  const auto name = map.find("name");
  if (name && !format->has_names)
    throw InputError(name->place, "name: a " + std::string(format->key) +
                                      " file holds one matrix; leave it out");
  map.finish();
  const Wanted wanted{name ? file.string(name->value, "name") : "",
                      file.place(name ? name->value : path->value)};
  const Reference reference{file.named_by(path->value, file.string(path->value, path->key)),
                            path->key, file.place(path->value)};
  Sources& sources = file.sources(path->value);
  const FileMatrix found = sources.matrix(reference, wanted.name,
                                          [&](const std::string& bytes, const std::string& shown) {
                                            return format->read(bytes, shown, wanted);
                                          });
  return value(item, found, sources.shown(reference.name), file.place(item.value));
}

}  // namespace gainsmith::io
