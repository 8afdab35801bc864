// Tables as CSV (RFC 4180, lines ended by a line feed).
#pragma once

#include <span>
#include <string>

namespace gainsmith::io {

/// Adds a line. Cells with a comma, a quotation mark or the end of a line are quoted.
void add_csv_line(std::span<const std::string> cells, std::string& text);

}  // namespace gainsmith::io
