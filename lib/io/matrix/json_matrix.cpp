#include "io/matrix/json_matrix.h"

#include <utility>
#include <vector>

#include "base/nearest.h"
#include "io/json/json_place.h"
#include "io/json/json_text.h"

namespace gainsmith::io {

namespace {

/// Finds a value of a document and reads it as a matrix. Errors name its path and its place.
class JsonMatrixReader {
 public:
  JsonMatrixReader(const std::string& text, const std::string& path, std::string name)
      : text_(text), path_(path), name_(std::move(name)) {}

  /// The value that the name leads to. Keys may have points in them.
  const Json& find(const Json& value, const std::string& name, const Place& place) const {
    if (name.empty()) return value;
    std::vector<std::string> keys;
    if (value.is_object()) {
      if (const auto whole = value.find(name); whole != value.end()) return *whole;
      for (const auto& item : value.items()) keys.push_back(item.key());
      const std::size_t point = name.find('.');
      const auto first = value.find(name.substr(0, point));
      if (point != std::string::npos && first != value.end())
        return find(*first, name.substr(point + 1), place);
    }
    throw InputError(place, path_ + " has no '" + name + "'" +
                                (name == name_ ? "" : " in '" + name_ + "'") +
                                (keys.empty() ? "" : suggestion(name, keys)));
  }

  /// A number, a list (flat), or rows of equal lengths.
  FileMatrix read(const Json& value) const {
    FileMatrix result;
    if (value.is_object()) refuse_object(value);
    const bool scalar = is_number(value);
    const bool rows = value.is_array() && !value.empty() && value[0].is_array();
    const std::size_t count = scalar ? 1 : value.size();
    if (!scalar && !value.is_array()) refuse("", "expected a list of rows");
    result.matrix = sized_matrix(rows ? static_cast<double>(count) : 1,
                                 static_cast<double>(rows ? value[0].size() : count),
                                 name_.empty() ? "the matrix" : name_, {path_});
    result.matrix.flat = !rows && !scalar;
    if (scalar) add(value, "", result);
    for (std::size_t i = 0; i < value.size() && !scalar; ++i) {
      const std::string at = "[" + std::to_string(i) + "]";
      if (!rows) {
        add(value[i], at, result);
        continue;
      }
      if (!value[i].is_array() || value[i].size() != value[0].size())
        refuse(at, "expected a row of " + std::to_string(value[0].size()) + " numbers");
      for (std::size_t j = 0; j < value[i].size(); ++j)
        add(value[i][j], at + "[" + std::to_string(j) + "]", result);
    }
    return result;
  }

 private:
  [[noreturn]] void refuse(const std::string& at, const std::string& message) const {
    const std::string where = name_ + at;
    throw InputError(place_in(text_, path_, where), (where.empty() ? "" : where + ": ") + message);
  }

  [[noreturn]] void refuse_object(const Json& value) const {
    std::string names;
    for (const auto& item : value.items())
      names += (names.empty() ? "" : ", ") + (name_.empty() ? "" : name_ + ".") + item.key();
    refuse("", "expected a matrix, found an object; say which of it by 'name': " + names);
  }

  /// Adds an element with its decimal.
  void add(const Json& value, const std::string& at, FileMatrix& result) const {
    if (!is_number(value)) refuse(at, "expected a number");
    result.matrix.elements.push_back(spelt_as_json(decimal_of(value)));
  }

  const std::string& text_;
  const std::string& path_;
  std::string name_;
};

}  // namespace

FileMatrix json_matrix(const std::string& text, const std::string& path, const std::string& name,
                       const Place& place) {
  const Json document = parse_json(text, path);
  const JsonMatrixReader reader(text, path, name);
  return reader.read(reader.find(document, name, place));
}

}  // namespace gainsmith::io
