#include "io/csv.h"

#include <vector>

#include "base/number.h"

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

std::string to_csv(std::span<const std::string> columns, const numbers::Matrix& table) {
  std::string text;
  add_csv_line(columns, text);
  std::vector<std::string> cells(columns.size());
  for (Eigen::Index row = 0; row < table.rows(); ++row) {
    for (std::size_t k = 0; k < cells.size(); ++k)
      cells[k] = decimal17(table(row, static_cast<Eigen::Index>(k)));
    add_csv_line(cells, text);
  }
  return text;
}

}  // namespace gainsmith::io
