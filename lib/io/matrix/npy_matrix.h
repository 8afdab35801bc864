// A matrix as NumPy writes it with numpy.save: files .npy of the format versions 1 to 3.
#pragma once

#include <string>

#include "io/matrix/file_matrix.h"

namespace gainsmith::io {

/// The matrix of an array with at most two dimensions, of real numbers, whole numbers or truth
/// values, in either order of its elements and of its bytes. An array with one dimension is a list.
/// InputError at `place` for any other array, for a file that is cut off, and for elements that are
/// not finite.
FileMatrix npy_matrix(const std::string& bytes, const std::string& path, const Place& place);

}  // namespace gainsmith::io
