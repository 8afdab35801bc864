// A matrix of CSV. Elements are counted before the table is read: a wrong file may be large.
#include "io/matrix/csv_matrix.h"

#include <algorithm>

#include "base/number.h"
#include "io/matrix/csv_table.h"

namespace gainsmith::io {

namespace {

[[noreturn]] void refuse(const std::string& cell, const Place& place) {
  if (cell.empty()) throw InputError(place, "this cell is empty; expected a number");
  const bool several = cell.find_first_of("; \t") != std::string::npos;
  throw InputError(place, "expected a finite decimal number, found '" + cell + "'" +
                              (several ? "; cells are separated by commas" : ""));
}

/// Before cells are made of them: each element but the last has a comma or a line end behind it.
void check_count(const std::string& text, const std::string& path) {
  for (const char mark : {',', '\n', '\r'})
    if (std::count(text.begin(), text.end(), mark) > kMostElements)
      throw InputError({path}, "the file has more than the " + std::to_string(kMostElements) +
                                   " elements that a matrix may have");
}

}  // namespace

FileMatrix csv_matrix(const std::string& text, const std::string& path) {
  check_count(text, path);
  const CsvTable table(text, path, CsvTable::FirstLine::row);
  FileMatrix result;
  result.matrix = sized_matrix(static_cast<double>(table.rows()),
                               static_cast<double>(table.columns()), "the matrix", {path});
  for (std::size_t i = 0; i < table.rows(); ++i)
    for (std::size_t j = 0; j < table.columns(); ++j) {
      const Place place = table.place(i, j);
      const std::string cell = table.text(i, j);
      if (!parse_decimal(cell)) refuse(cell, place);
      result.matrix.elements.push_back(spelt_as_json(cell));
      result.positions.push_back({place.line, place.column});
    }
  return result;
}

}  // namespace gainsmith::io
