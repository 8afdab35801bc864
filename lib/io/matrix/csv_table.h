// Reading tables of CSV (RFC 4180): a line of column names, then rows of cells; or rows alone.
//
// Lines end with LF or CRLF; cells are separated by commas, may be quoted, and spaces around them
// do not count. Empty lines and those that begin with # are left out; so is a line of units below
// the names, in which no cell begins as a number does. A name may end with its unit, as in "angle
// [deg]", and is found without it where it is the only one. Errors name file, line and column of
// the CSV itself.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.h"

namespace gainsmith::io {

/// A table, which owns its text. Rows and columns count from 0; the text of cells is UTF-8.
class CsvTable {
 public:
  /// `row`: the first line is a row, the columns are called 1, 2, ...; but it is left out when
  /// each cell of it begins with a letter and represents no value, as NA and true do.
  enum class FirstLine { names, row };

  /// `path` is used in messages. InputError when the text is empty, has no rows, two columns of one
  /// name, a row of another length than the first, or a quotation mark that is not closed.
  CsvTable(std::string text, std::string path, FirstLine first = FirstLine::names);

  const std::string& path() const { return path_; }
  std::size_t rows() const { return lines_.size(); }
  std::size_t columns() const { return names_.size(); }
  /// The position of a column; none.
  std::optional<std::size_t> find(const std::string& column) const;
  /// "ms" of the line of units, or of a column "t [ms]" or "t (ms)"; empty without one.
  std::string unit(std::size_t column) const;
  /// InputError at `place`, which names the column, when there is none, with the nearest spelling.
  std::size_t column(const std::string& name, const Place& place) const;
  /// The text of a cell, without its quotation marks.
  std::string text(std::size_t row, std::size_t column) const;
  /// None of an empty cell. InputError for what is no finite decimal number.
  std::optional<double> number(std::size_t row, std::size_t column) const;
  /// Where a cell begins, its quotation mark included.
  Place place(std::size_t row, std::size_t column) const;

 private:
  /// Within the text, quotation marks included.
  struct Cell {
    std::size_t begin = 0, end = 0;
    bool quoted = false;
  };
  struct Line {
    int number = 0;
    std::size_t begin = 0;
    bool broken = false;  ///< by the end of a line within quotation marks
  };

  void read(FirstLine first);
  /// The cells of the line that begins at `at`, which is moved behind it; `number` and `begin`: of
  /// the line that `at` is in.
  std::vector<Cell> line(std::size_t& at, int& number, std::size_t& begin) const;
  Cell cell(std::size_t& at, int& number, std::size_t& line_begin) const;
  void read_header(const std::vector<Cell>& cells, const Line& line);
  Place place(const Line& line, const Cell& cell) const;
  bool are_units(const std::vector<Cell>& cells) const;
  bool is_heading(const std::vector<Cell>& cells) const;
  std::string text(const Cell& cell) const;
  const Cell& cell(std::size_t row, std::size_t column) const {
    return cells_[row * names_.size() + column];
  }

  std::string text_, path_;
  std::vector<std::string> names_;
  std::vector<std::string> units_;  ///< of the line below them; empty without it
  std::vector<Line> lines_;         ///< of the rows
  std::vector<Cell> cells_;         ///< row by row
  bool has_comments_ = false;
};

}  // namespace gainsmith::io
