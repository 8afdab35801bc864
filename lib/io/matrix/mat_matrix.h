// A variable of a MAT file of version 5 (MathWorks, MAT-File Format, chapter 1), as MATLAB, Octave
// and SciPy write it, compressed or not.
#pragma once

#include <string>

#include "io/matrix/file_matrix.h"

namespace gainsmith::io {

/// The real matrix under `name`, full or sparse, of floating-point or whole numbers or truth
/// values; whole numbers exactly. Without a name: the only variable of the file. `bytes`: the
/// content of the file. InputError for a name that is not there, with the nearest one (`place`:
/// where the name is given); for other versions, a file that is cut off or damaged, and variables
/// that are no such matrix.
FileMatrix mat_matrix(const std::string& bytes, const std::string& path, const std::string& name,
                      const Place& place);

}  // namespace gainsmith::io
