#include "io/csv.h"

#include "base/number.h"

namespace gainsmith::io {

std::string to_csv(std::span<const std::string> columns, const numbers::Matrix& table) {
  std::string text;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (i > 0) text += ',';
    text += columns[i];
  }
  text += '\n';
  for (Eigen::Index row = 0; row < table.rows(); ++row) {
    for (Eigen::Index column = 0; column < table.cols(); ++column) {
      if (column > 0) text += ',';
      text += decimal17(table(row, column));
    }
    text += '\n';
  }
  return text;
}

}  // namespace gainsmith::io
