// Internal to io: a variable of a MAT file, whatever read it, and the matrix that it is. Nothing in it is believed: it
// comes from a stranger's file.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "model/stated_file.h"

namespace gainsmith::io {

/// Numbers as they are stored. `type`: of matio_types, which has the codes of the files.
struct MatNumbers {
  int type = 0;
  std::string_view bytes;
  bool big_endian = false;
};

struct MatVariable {
  std::string name;
  int kind = 0;  ///< of matio_classes, which has the codes of the files too
  bool complex = false;
  std::vector<double> dimensions;
  MatNumbers values;  ///< column after column; of a sparse matrix those that are stored
  // Of a sparse matrix: the row of each stored value, and of each column where its values begin; then where the last ends.
  MatNumbers rows, columns;
};

/// The matrix under `name`; with an empty name that of the only variable. `found`: all variables, without numbers, which
/// `read` gives. It is asked for a real matrix of a size that a matrix may have only. InputError at `place` for any other
/// variable, and where types, lengths and places do not fit together.
model::StatedMatrix matrix_of_variable(const std::vector<MatVariable>& found,
                                       const std::string& name, const std::string& path,
                                       const Place& place,
                                       const std::function<MatVariable(std::size_t index)>& read);

}  // namespace gainsmith::io
