// Tables as CSV (RFC 4180, lines ended by a line feed).
#pragma once

#include <span>
#include <string>

#include "numbers/matrix.h"

namespace gainsmith::io {

/// Adds a line. Cells with a comma, a quotation mark or the end of a line are quoted.
void add_csv_line(std::span<const std::string> cells, std::string& text);

/// A line of column names, then a line for each row of the table; numbers by decimal17, so that
/// reading them gives the same doubles. One name for each column.
std::string to_csv(std::span<const std::string> columns, const numbers::Matrix& table);

}  // namespace gainsmith::io
