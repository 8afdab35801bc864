// Internal to io: a variable of a MAT file, and the matrix that it is. Nothing in it is believed:
// it comes from a stranger's file.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "model/stated_file.h"

namespace gainsmith::io {

/// Codes of the files (MathWorks, MAT-File Format, tables 1-1 and 1-3).
namespace mat {
enum Type { kInt8 = 1, kUint8 = 2, kInt32 = 5, kUint32 = 6, kMatrix = 14, kCompressed = 15 };
/// Of numbers: sparse, double, single, and int8 to uint64 in pairs.
enum Class {
  kCellClass = 1,
  kStructClass = 2,
  kTextClass = 4,
  kSparseClass = 5,
  kUint64Class = 15,
  kOpaqueClass = 17
};
}  // namespace mat

/// Numbers as they are stored.
struct MatNumbers {
  int type = 0;  ///< mat::Type, or another code
  std::string_view bytes;
  bool big_endian = false;
};

/// A variable; its bytes belong to the file or to what was decompressed.
struct MatVariable {
  std::string name;
  int kind = 0;  ///< mat::Class, or another code
  bool complex = false;
  std::vector<double> dimensions;
  MatNumbers values;  ///< column after column; of a sparse matrix those that are stored
  // Of a sparse matrix: the row of each stored value, and of each column where its values begin;
  // then where the last ends.
  MatNumbers rows, columns;
};

/// The matrix under `name`; with an empty name that of the only variable. `found`: all variables,
/// without numbers, which `read` gives. It is asked for a real matrix of a size that a matrix may
/// have only. InputError at `place` for any other variable, and where types, lengths and places do
/// not fit together.
model::StatedMatrix matrix_of_variable(const std::vector<MatVariable>& found,
                                       const std::string& name, const std::string& path,
                                       const Place& place,
                                       const std::function<MatVariable(std::size_t index)>& read);

}  // namespace gainsmith::io
