// A matrix as CSV: a row of numbers a line. A first line without any number names the columns and
// is left out.
#pragma once

#include <string>

#include "io/matrix/file_matrix.h"

namespace gainsmith::io {

/// The matrix with the decimals of the text. InputError with the line and column in the file for a
/// cell that is no finite number, for rows of different lengths, an empty file, and too many
/// elements. `path` is used in messages.
FileMatrix csv_matrix(const std::string& text, const std::string& path);

}  // namespace gainsmith::io
