#include "io/matrix/mat_matrix.h"

#include <matio.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <mutex>
#include <sstream>
#include <vector>

#include "base/nearest.h"
#include "base/own_process.h"
#include "base/shared_library.h"
#include "io/matrix/mat_layout.h"

namespace gainsmith::io {

namespace {

/// The library keeps its messages; what is wrong is said here.
void ignore_message(int /*level*/, char* /*message*/) {}

/// The functions of the library.
struct Matio {
  SharedLibrary library{GAINSMITH_MATIO_FILE,
                        "matrices of .mat files need it: install libmatio11, or save the matrix as "
                        "CSV by writematrix(A, 'A.csv')"};
#define GAINSMITH_FUNCTION(name) \
  decltype(Mat_##name)* name = library.function<decltype(Mat_##name)>("Mat_" #name)
  GAINSMITH_FUNCTION(Open);
  GAINSMITH_FUNCTION(Close);
  GAINSMITH_FUNCTION(LogInitFunc);
  GAINSMITH_FUNCTION(VarReadNextInfo);
  GAINSMITH_FUNCTION(VarReadDataAll);
  GAINSMITH_FUNCTION(VarFree);
#undef GAINSMITH_FUNCTION

  Matio() {
    LogInitFunc("", ignore_message);
    // HDF5, which is below it, prints its errors unless it is told not to.
    using SetErrorHandler = int(std::int64_t, void*, void*);
    library.function<SetErrorHandler>("H5Eset_auto2")(0, nullptr, nullptr);
  }
};

const Matio& matio() {
  static const Matio kLoaded;
  return kLoaded;
}

struct CloseFile {
  void operator()(mat_t* file) const { matio().Close(file); }
};
struct FreeVariable {
  void operator()(matvar_t* variable) const { matio().VarFree(variable); }
};
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

class MatReader {
 public:
  MatReader(const std::string& path, const std::string& name, const Place& place)
      : path_(path), name_(name), place_(place), file_(matio().Open(path.c_str(), MAT_ACC_RDONLY)) {
    if (!file_) damaged();
  }

  FileMatrix read() {
    const Variable variable = find();
    name_found_ = variable->name;
    what_ = path_ + ": " + name_found_;
    check_kind(*variable);
    model::StatedMatrix matrix =
        sized_matrix(static_cast<double>(variable->dims[0]), static_cast<double>(variable->dims[1]),
                     what_, place_);
    if (matio().VarReadDataAll(file_.get(), variable.get()) != 0 || variable->data == nullptr)
      damaged();
    const std::vector<std::size_t> at =
        variable->class_type == MAT_C_SPARSE ? sparse(*variable, matrix) : full(matrix);
    const void* const data = variable->class_type == MAT_C_SPARSE
                                 ? static_cast<const mat_sparse_t*>(variable->data)->data
                                 : variable->data;
    for (const std::size_t element : at)
      if (element == kNothing)
        matrix.elements.emplace_back("0");
      else
        add(variable->data_type, data, element, matrix);
    return {matrix};
  }

 private:
  [[noreturn]] void damaged() const {
    throw InputError(place_,
                     path_ + ": the file is cut off or damaged: its variables cannot be read");
  }
  [[noreturn]] void refuse(const std::string& message) const {
    throw InputError(place_, what_ + " " + message);
  }

  /// The variable of the name; without a name the only one.
  Variable find() {
    std::vector<std::string> names;
    Variable found;
    while (Variable next{matio().VarReadNextInfo(file_.get())}) {
      if (next->name == nullptr) continue;
      names.emplace_back(next->name);
      if (!name_.empty() ? names.back() == name_ : names.size() == 1) found = std::move(next);
      if (!name_.empty() && found) return found;
    }
    if (names.empty())
      throw InputError(place_,
                       path_ + ": no variable can be read: the file has none, or is cut off");
    if (name_.empty() && names.size() == 1) return found;
    if (name_.empty()) {
      std::string known;
      for (const std::string& name : names) known += (known.empty() ? "" : ", ") + name;
      throw InputError(place_, path_ + " has several variables; say which by 'name': " + known);
    }
    throw InputError(place_, path_ + " has no variable '" + name_ + "'" + suggestion(name_, names));
  }

  void check_kind(const matvar_t& variable) const {
    switch (variable.class_type) {
      case MAT_C_STRUCT:
        refuse("is a struct; save its field as a variable: A = " + name_found_ +
               ".A; save('-v7', ...)");
      case MAT_C_CELL:
        refuse("is a cell array; save its cell as a variable: A = " + name_found_ +
               "{1}; save('-v7', ...)");
      case MAT_C_CHAR:
        refuse("is a text, not a matrix");
      case MAT_C_EMPTY:
      case MAT_C_OBJECT:
      case MAT_C_FUNCTION:
      case MAT_C_OPAQUE:
        refuse("is no matrix; of a model 'sys' save the matrices: [A, B, C, D] = ssdata(sys)");
      default:
        break;
    }
    if (variable.isComplex != 0)
      refuse("is complex; save real(" + name_found_ + ") and imag(" + name_found_ + ")");
    if (variable.rank != 2)
      refuse("has " + std::to_string(variable.rank) + " dimensions; a matrix has two: save " +
             name_found_ + "(:, :, k)");
  }

  template <class Number>
  void add(const void* data, std::size_t at, model::StatedMatrix& matrix) const {
    const Number value = static_cast<const Number*>(data)[at];
    if constexpr (std::is_integral_v<Number>)
      matrix.elements.push_back(std::to_string(value));
    else
      add_element(value, what_, place_, matrix);
  }

  void add(matio_types type, const void* data, std::size_t at, model::StatedMatrix& matrix) const {
    switch (type) {
      case MAT_T_DOUBLE:
        return add<double>(data, at, matrix);
      case MAT_T_SINGLE:
        return add<float>(data, at, matrix);
      case MAT_T_INT8:
        return add<std::int8_t>(data, at, matrix);
      case MAT_T_UINT8:
        return add<std::uint8_t>(data, at, matrix);
      case MAT_T_INT16:
        return add<std::int16_t>(data, at, matrix);
      case MAT_T_UINT16:
        return add<std::uint16_t>(data, at, matrix);
      case MAT_T_INT32:
        return add<std::int32_t>(data, at, matrix);
      case MAT_T_UINT32:
        return add<std::uint32_t>(data, at, matrix);
      case MAT_T_INT64:
        return add<std::int64_t>(data, at, matrix);
      case MAT_T_UINT64:
        return add<std::uint64_t>(data, at, matrix);
      default:
        damaged();
    }
  }

  /// Where in memory, which has column after column, the elements are, row by row.
  static std::vector<std::size_t> full(const model::StatedMatrix& shape) {
    const auto rows = static_cast<std::size_t>(shape.rows);
    const auto cols = static_cast<std::size_t>(shape.cols);
    std::vector<std::size_t> at;
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < cols; ++j) at.push_back(j * rows + i);
    return at;
  }

  /// The same of a sparse matrix, which has what is not 0.
  std::vector<std::size_t> sparse(const matvar_t& variable,
                                  const model::StatedMatrix& shape) const {
    const auto& data = *static_cast<const mat_sparse_t*>(variable.data);
    const auto rows = static_cast<std::size_t>(shape.rows);
    const auto cols = static_cast<std::size_t>(shape.cols);
    if (data.jc == nullptr || data.njc != cols + 1) damaged();
    std::vector<std::size_t> at(rows * cols, kNothing);
    for (std::size_t j = 0; j < cols; ++j)
      for (std::size_t k = data.jc[j]; k < data.jc[j + 1]; ++k) {
        if (k >= data.nir || k >= data.ndata || data.ir[k] >= rows) damaged();
        at[data.ir[k] * cols + j] = k;
      }
    return at;
  }

  static constexpr std::size_t kNothing = static_cast<std::size_t>(-1);

  const std::string& path_;
  const std::string& name_;
  const Place& place_;
  std::unique_ptr<mat_t, CloseFile> file_;
  std::string name_found_;
  std::string what_;  ///< "plant.mat: A"
};

/// The matrix as words: rows, columns, elements.
std::string packed(const model::StatedMatrix& matrix) {
  std::string text = std::to_string(matrix.rows) + " " + std::to_string(matrix.cols);
  for (const std::string& element : matrix.elements) text += " " + element;
  return text;
}

model::StatedMatrix unpacked(const std::string& text) {
  std::istringstream words(text);
  model::StatedMatrix matrix;
  words >> matrix.rows >> matrix.cols;
  for (std::string element; words >> element;) matrix.elements.push_back(element);
  return matrix;
}

}  // namespace

FileMatrix mat_matrix(const std::string& bytes, const std::string& path, const std::string& name,
                      const Place& place) {
  check_mat_layout(bytes, path, place);
  // Neither the library nor HDF5 below it is made for several threads, or for files with errors.
  static std::mutex mutex;
  const std::scoped_lock lock(mutex);
  matio();
  const auto text =
      in_own_process([&] { return packed(MatReader(path, name, place).read().matrix); });
  if (!text) throw InputError(place, path + ": the file is damaged: its variables cannot be read");
  return {unpacked(*text)};
}

}  // namespace gainsmith::io
