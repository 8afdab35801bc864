// A variable of a MAT file, as MATLAB, Octave and SciPy write it: versions 5 and 7.3, compressed or not.
// The library that reads them, matio, is loaded when the first one is read.
#pragma once

#include <string>

#include "io/matrix/file_matrix.h"

namespace gainsmith::io {

/// The real matrix under `name`, full or sparse, of floating-point or whole numbers or truth values;
/// whole numbers exactly. Without a name: the only variable of the file. `bytes`: the content of the
/// file, which is read again by the library. InputError for a name that is not there, with the
/// nearest one (`place`: where the name is given); for version 4, a file that is cut off or damaged,
/// variables that are no such matrix, and where the library is not installed.
FileMatrix mat_matrix(const std::string& bytes, const std::string& path, const std::string& name,
                      const Place& place);

}  // namespace gainsmith::io
