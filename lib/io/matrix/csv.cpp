#include "io/matrix/csv.h"

#include <cstddef>

namespace gainsmith::io {

namespace {

void add_cell(const std::string& cell, std::string& text) {
  if (cell.find_first_of(",\"\r\n") == std::string::npos) {
    text += cell;
    return;
  }
  text += '"';
  for (const char c : cell) text.append(c == '"' ? 2 : 1, c);
  text += '"';
}

}  // namespace

void add_csv_line(std::span<const std::string> cells, std::string& text) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) text += ',';
    add_cell(cells[i], text);
  }
  text += '\n';
}

}  // namespace gainsmith::io
