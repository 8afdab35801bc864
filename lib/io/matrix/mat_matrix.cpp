#include "io/matrix/mat_matrix.h"

#include <matio.h>

#include <bit>
#include <cstdint>
#include <memory>
#include <mutex>
#include <sstream>
#include <string_view>
#include <vector>

#include "base/own_process.h"
#include "base/shared_library.h"
#include "io/matrix/mat_layout.h"
#include "io/matrix/mat_v5.h"
#include "io/matrix/mat_variable.h"

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
  GAINSMITH_FUNCTION(SizeOf);
  GAINSMITH_FUNCTION(VarReadInfo);
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

/// Of zlib, which is below the library.
std::string inflated(std::string_view bytes, std::size_t most) {
  using Uncompress = int(unsigned char*, unsigned long*, const unsigned char*, unsigned long);
  constexpr int kFull = -5;
  static Uncompress* const uncompress = matio().library.function<Uncompress>("uncompress");
  std::string text(most, '\0');
  unsigned long size = most;
  const int code = uncompress(reinterpret_cast<unsigned char*>(text.data()), &size,
                              reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  text.resize(code == 0 || code == kFull ? size : 0);
  return text;
}

MatNumbers numbers_of(const void* data, std::size_t size, int type) {
  const std::string_view bytes(static_cast<const char*>(data), data == nullptr ? 0 : size);
  return {type, bytes, std::endian::native == std::endian::big};
}

/// What the library says of a variable, and has read of it.
MatVariable variable_of(const matvar_t& found) {
  MatVariable result{found.name, found.class_type, found.isComplex != 0, {}, {}, {}, {}};
  for (int k = 0; k < found.rank; ++k)
    result.dimensions.push_back(static_cast<double>(found.dims[k]));
  if (found.data == nullptr || found.isComplex != 0) return result;
  if (found.class_type != MAT_C_SPARSE) {
    result.values = numbers_of(found.data, found.nbytes, found.data_type);
    return result;
  }
  const auto& sparse = *static_cast<const mat_sparse_t*>(found.data);
  result.rows = numbers_of(sparse.ir, sparse.nir * sizeof *sparse.ir, MAT_T_UINT32);
  result.columns = numbers_of(sparse.jc, sparse.njc * sizeof *sparse.jc, MAT_T_UINT32);
  result.values =
      numbers_of(sparse.data, sparse.ndata * matio().SizeOf(found.data_type), found.data_type);
  return result;
}

model::StatedMatrix matrix_of_hdf5(const std::string& path, const std::string& name,
                                   const Place& place) {
  const std::unique_ptr<mat_t, CloseFile> file(matio().Open(path.c_str(), MAT_ACC_RDONLY));
  std::vector<MatVariable> found;
  while (file) {
    const Variable next(matio().VarReadNextInfo(file.get()));
    if (!next) break;
    if (next->name != nullptr) found.push_back(variable_of(*next));
  }
  Variable variable;
  return matrix_of_variable(found, name, path, place, [&](std::size_t index) {
    variable.reset(matio().VarReadInfo(file.get(), found[index].name.c_str()));
    if (!variable || matio().VarReadDataAll(file.get(), variable.get()) != 0)
      throw InputError(place, path + ": the file is damaged: its variables cannot be read");
    return variable_of(*variable);
  });
}

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
  const MatLayout layout = mat_layout(bytes, path, place);
  if (!layout.hdf5) return {matrix_of_v5(bytes, layout.big_endian, path, name, place, inflated)};
  // Neither the library nor HDF5 below it is made for several threads, or for files with errors.
  static std::mutex mutex;
  const std::scoped_lock lock(mutex);
  matio();
  const auto text = in_own_process([&] { return packed(matrix_of_hdf5(path, name, place)); });
  if (!text) throw InputError(place, path + ": the file is damaged: its variables cannot be read");
  return {unpacked(*text)};
}

}  // namespace gainsmith::io
