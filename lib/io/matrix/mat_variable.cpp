// Matrices of MAT variables: full ones column after column, sparse ones as compressed columns, that
// is rows of the stored values and, for each column, where its values begin.
#include "io/matrix/mat_variable.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/nearest.h"
#include "io/matrix/file_matrix.h"

namespace gainsmith::io {

namespace {

struct StoredFormat {
  char kind = ' ';        ///< as add_stored has it
  std::size_t width = 0;  ///< bytes; 0 of what are no numbers
};

/// The types are counted: int8, uint8, int16, uint16, int32, uint32, single, -, double, -, -,
/// int64, uint64.
StoredFormat format_of(int type) {
  constexpr std::string_view kKinds = " iuiuiuf f  iu", kWidths = "01122444080088";
  const auto at = static_cast<std::size_t>(type);
  if (type < 0 || at >= kKinds.size()) return {};
  return {kKinds[at], static_cast<std::size_t>(kWidths[at] - '0')};
}

/// Whether numbers of a class may have the type: that of the class, double of a sparse matrix, or
/// whole numbers of fewer bytes.
bool may_have(int kind, int type) {
  constexpr std::array kTypes = {9, 9, 7, 1,  2, 3,
                                 4, 5, 6, 12, 13};  // sparse, double, single, int8, ...
  const int own = kTypes.at(static_cast<std::size_t>(kind - mat::kSparseClass));
  const StoredFormat format = format_of(type);
  return type == own ||
         (format.width > 0 && format.kind != 'f' && format.width < format_of(own).width);
}

/// Numbers of 4 bytes; empty where the type is another one.
std::vector<std::uint64_t> whole_numbers(const MatNumbers& numbers) {
  std::vector<std::uint64_t> result;
  if (numbers.type != mat::kInt32 && numbers.type != mat::kUint32) return result;
  for (std::size_t at = 0; at + 4 <= numbers.bytes.size(); at += 4)
    result.push_back(word_of(numbers.bytes.substr(at, 4), numbers.big_endian));
  return result;
}

/// Of an element of a sparse matrix that is not stored: it is 0.
constexpr std::size_t kNothing = static_cast<std::size_t>(-1);

/// Which of the stored values the elements are, row by row; empty when they do not fit.
std::vector<std::size_t> places(const MatVariable& variable, std::size_t rows, std::size_t cols) {
  const std::size_t width = format_of(variable.values.type).width;
  if (!may_have(variable.kind, variable.values.type) || variable.values.bytes.size() % width != 0)
    return {};
  const std::size_t stored = variable.values.bytes.size() / width;
  std::vector<std::size_t> at(rows * cols, kNothing);
  // Element (i, j), k = i cols + j, is the stored value j rows + i.
  if (variable.kind != mat::kSparseClass) {
    for (std::size_t k = 0; k < at.size(); ++k) at[k] = k % cols * rows + k / cols;
    return stored == at.size() ? at : std::vector<std::size_t>{};
  }
  const auto row = whole_numbers(variable.rows), begin = whole_numbers(variable.columns);
  if (begin.size() != cols + 1 || begin[0] != 0 || !std::is_sorted(begin.begin(), begin.end()) ||
      begin[cols] > std::min(row.size(), stored))
    return {};
  for (std::size_t j = 0; j < cols; ++j)
    for (std::size_t k = begin[j]; k < begin[j + 1]; ++k) {
      // Rows of a column ascend: so no element is stored twice.
      if (row[k] >= rows || (k > begin[j] && row[k] <= row[k - 1])) return {};
      at[row[k] * cols + j] = k;
    }
  return at;
}

/// The variable of the name, or the only one. InputError with what there is.
std::size_t index_of(const std::vector<MatVariable>& found, const std::string& name,
                     const std::string& path, const Place& place) {
  if (found.empty())
    throw InputError(place, path + ": no variable can be read: the file has none, or is cut off");
  if (name.empty() && found.size() == 1) return 0;
  std::vector<std::string> names;
  std::string known;
  for (const MatVariable& array : found) {
    if (!name.empty() && array.name == name) return names.size();
    names.push_back(array.name);
    known += (known.empty() ? "" : ", ") + array.name;
  }
  throw InputError(place, name.empty()
                              ? path + " has several variables; say which by 'name': " + known
                              : path + " has no variable '" + name + "'" + suggestion(name, names));
}

/// Why a variable is no real matrix; empty when it is one.
std::string refusal(const MatVariable& variable) {
  const std::string& name = variable.name;
  if (variable.kind == mat::kStructClass)
    return "is a struct; save its field as a variable: A = " + name + ".A; save('-v7', ...)";
  if (variable.kind == mat::kCellClass)
    return "is a cell array; save its cell as a variable: A = " + name + "{1}; save('-v7', ...)";
  if (variable.kind == mat::kTextClass) return "is a text, not a matrix";
  if (variable.kind < mat::kSparseClass || variable.kind > mat::kUint64Class)
    return "is no matrix; of a model 'sys' save the matrices: [A, B, C, D] = ssdata(sys)";
  if (variable.complex) return "is complex; save real(" + name + ") and imag(" + name + ")";
  if (variable.dimensions.size() == 2) return "";
  return "has " + std::to_string(variable.dimensions.size()) +
         " dimensions; a matrix has two: save " + name + "(:, :, k)";
}

}  // namespace

model::StatedMatrix matrix_of_variable(const std::vector<MatVariable>& found,
                                       const std::string& name, const std::string& path,
                                       const Place& place,
                                       const std::function<MatVariable(std::size_t index)>& read) {
  const std::size_t index = index_of(found, name, path, place);
  const std::string what = path + ": " + found[index].name;
  const std::string why = refusal(found[index]);
  if (!why.empty()) throw InputError(place, what + " " + why);
  const auto& size = found[index].dimensions;
  model::StatedMatrix matrix = sized_matrix(size[0], size[1], what, place);
  const MatVariable variable = read(index);
  const MatNumbers& values = variable.values;
  const auto at = places(variable, static_cast<std::size_t>(matrix.rows),
                         static_cast<std::size_t>(matrix.cols));
  if (at.empty())
    throw InputError(place, what + ": the file is damaged: these are no numbers of such a matrix");
  const auto [kind, width] = format_of(values.type);
  for (const std::size_t element : at)
    if (element == kNothing)
      matrix.elements.emplace_back("0");
    else
      add_stored(kind, values.bytes.substr(element * width, width), values.big_endian, what, place,
                 matrix);
  return matrix;
}

}  // namespace gainsmith::io
