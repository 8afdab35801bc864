// A matrix in a JSON document: a number, a list of numbers, or a list of rows.
#pragma once

#include <string>

#include "io/matrix/file_matrix.h"

namespace gainsmith::io {

/// The matrix that `name` leads to, "gains.L"; empty: the document itself. InputError for a name
/// that is not there, with the nearest one (`place`: where the name is given), and with the line
/// and column in the file for all that is no matrix.
FileMatrix json_matrix(const std::string& text, const std::string& path, const std::string& name,
                       const Place& place);

}  // namespace gainsmith::io
