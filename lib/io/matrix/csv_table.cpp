// Tables of CSV in one pass: cells are ranges of the text, and become texts or numbers when they
// are asked for.
#include "io/matrix/csv_table.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "base/nearest.h"
#include "base/number.h"

namespace gainsmith::io {

namespace {

/// What around a cell does not count.
bool is_blank_cell(char c) { return c == ' ' || c == '\t'; }

/// Also a carriage return alone.
bool ends_line(const std::string& text, std::size_t at) {
  return text[at] == '\n' || (text[at] == '\r' && text[std::min(at + 1, text.size() - 1)] != '\n');
}

/// "angle [deg]" and "angle (deg)" are called angle.
bool is_with_unit(const std::string& name, const std::string& column) {
  if (column.empty() || !name.starts_with(column)) return false;
  const std::size_t at = name.find_first_not_of(' ', column.size());
  return at != std::string::npos &&
         ((name[at] == '[' && name.back() == ']') || (name[at] == '(' && name.back() == ')'));
}

}  // namespace

CsvTable::CsvTable(std::string text, std::string path, FirstLine first)
    : text_(std::move(text)), path_(std::move(path)) {
  // The byte order mark that some programs write in front.
  if (text_.starts_with("\xEF\xBB\xBF")) text_.erase(0, 3);
  read(first);
}

/// Comments, empty lines, a heading, names and units are told apart in the order of the lines.
void CsvTable::read(FirstLine first) {
  bool is_first = true;
  bool may_be_units = true;
  std::size_t at = 0;
  int number = 1;
  while (at < text_.size()) {
    if (text_[at] == '#') {
      has_comments_ = true;
      while (at < text_.size() && !ends_line(text_, at)) ++at;
      ++at, ++number;
      continue;
    }
    Line start{number, at};
    std::size_t begin = at;
    const std::vector<Cell> cells = line(at, number, begin);
    start.broken = begin != start.begin;
    if (cells.size() == 1 && cells[0].begin == cells[0].end && !cells[0].quoted) continue;
    const bool skipped = first == FirstLine::row && is_first && is_heading(cells);
    is_first = false;
    if (skipped) continue;
    if (names_.empty() && first == FirstLine::names) {
      read_header(cells, start);
      continue;
    }
    while (lines_.empty() && first == FirstLine::row && names_.size() < cells.size())
      names_.push_back(std::to_string(names_.size() + 1));
    if (cells.size() == names_.size() && lines_.empty() && first == FirstLine::names &&
        std::exchange(may_be_units, false) && are_units(cells)) {
      for (const Cell& cell : cells) units_.push_back(text(cell));
      continue;
    }
    if (cells.size() != names_.size())
      throw InputError({path_, start.number, 1}, "the row has " + std::to_string(cells.size()) +
                                                     " cells, the first line " +
                                                     std::to_string(names_.size()));
    lines_.push_back(start);
    cells_.insert(cells_.end(), cells.begin(), cells.end());
  }
  if (names_.empty())
    throw InputError({path_, 1, 1}, first == FirstLine::names
                                        ? "the file is empty; expected a line of column names"
                                        : "the file has no numbers; expected a row in each line");
  if (lines_.empty()) throw InputError({path_, 1, 1}, "there is no row below the column names");
}

/// Quoted cells may hold ends of lines: `number` then grows by more than one.
std::vector<CsvTable::Cell> CsvTable::line(std::size_t& at, int& number, std::size_t& begin) const {
  std::vector<Cell> cells;
  while (true) {
    cells.push_back(cell(at, number, begin));
    if (at >= text_.size()) return cells;
    const char c = text_[at++];
    if (c == ',') continue;
    if (c == '\r' && at < text_.size() && text_[at] == '\n') ++at;
    ++number;
    return cells;
  }
}

/// Up to the comma or the end of the line, at which `at` is then.
CsvTable::Cell CsvTable::cell(std::size_t& at, int& number, std::size_t& line_begin) const {
  const auto is_end = [&](char c) { return c == ',' || c == '\n' || c == '\r'; };
  while (at < text_.size() && is_blank_cell(text_[at])) ++at;
  Cell found{at, at, false};
  if (at < text_.size() && text_[at] == '"') {
    const Place open{path_, number, static_cast<int>(at - line_begin) + 1};
    found = {++at, at, true};
    while (at < text_.size() && !(text_[at] == '"' && text_.compare(at, 2, "\"\"") != 0)) {
      if (ends_line(text_, at)) ++number, line_begin = at + 1;
      at += text_[at] == '"' ? 2U : 1U;
    }
    if (at >= text_.size()) throw InputError(open, "this quotation mark is not closed");
    found.end = at++;
    while (at < text_.size() && is_blank_cell(text_[at])) ++at;
    if (at < text_.size() && !is_end(text_[at]))
      throw InputError({path_, number, static_cast<int>(at - line_begin) + 1},
                       "expected a comma or the end of the line after a quoted cell");
    return found;
  }
  while (at < text_.size() && !is_end(text_[at])) ++at;
  found.end = at;
  while (found.end > found.begin && is_blank_cell(text_[found.end - 1])) --found.end;
  return found;
}

void CsvTable::read_header(const std::vector<Cell>& cells, const Line& line) {
  for (const Cell& cell : cells) {
    const std::string name = text(cell);
    const Place place = this->place(line, cell);
    if (parse_decimal(name))
      throw InputError(place, "expected a line of column names, found the number " + name +
                                  (has_comments_ ? "; lines that begin with # are comments" : ""));
    if (std::find(names_.begin(), names_.end(), name) != names_.end())
      throw InputError(place, "there are two columns '" + name + "'");
    names_.push_back(name);
  }
  if (names_.size() == 1 && names_[0].find(';') != std::string::npos)
    throw InputError({path_, line.number, 1},
                     "the columns are separated by semicolons; expected commas");
}

/// No cell is quoted or begins as a number, behind signs and a point.
bool CsvTable::are_units(const std::vector<Cell>& cells) const {
  return std::all_of(cells.begin(), cells.end(), [&](const Cell& cell) {
    const std::string word = text(cell);
    const std::size_t at = word.find_first_not_of("+-.");
    return !cell.quoted && (at == std::string::npos || word.find_first_of("0123456789") != at);
  });
}

bool CsvTable::is_heading(const std::vector<Cell>& cells) const {
  return std::all_of(cells.begin(), cells.end(), [&](const Cell& cell) {
    constexpr std::array kValues = {"na", "nan", "n/a", "null", "none", "inf", "true", "false"};
    std::string word = text(cell);
    std::transform(word.begin(), word.end(), word.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const bool named =
        !word.empty() && (word.front() == '_' || (word.front() >= 'a' && word.front() <= 'z'));
    return named && std::find(kValues.begin(), kValues.end(), word) == kValues.end();
  });
}

/// A doubled quotation mark within a quoted cell is one.
std::string CsvTable::text(const Cell& cell) const {
  std::string result = text_.substr(cell.begin, cell.end - cell.begin);
  if (!cell.quoted) return result;
  for (std::size_t k = 0; (k = result.find("\"\"", k)) != std::string::npos; ++k)
    result.erase(k, 1);
  return result;
}

std::optional<std::size_t> CsvTable::find(const std::string& column) const {
  auto found = std::find(names_.begin(), names_.end(), column);
  if (found == names_.end()) {
    const auto is_it = [&](const std::string& name) { return is_with_unit(name, column); };
    found = std::find_if(names_.begin(), names_.end(), is_it);
    // Two columns of one name in two units have to be told apart.
    if (std::count_if(found, names_.end(), is_it) > 1) return std::nullopt;
  }
  if (found == names_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names_.begin());
}

/// The line of units precedes a unit in the name.
std::string CsvTable::unit(std::size_t column) const {
  if (!units_.empty() && !units_[column].empty()) {
    const std::string& unit = units_[column];
    const bool bare = unit.find_first_of("[(") != 0 || unit.size() < 2;
    return bare ? unit : unit.substr(1, unit.size() - 2);
  }
  const std::string& name = names_[column];
  const std::size_t from = name.find_first_of("[(");
  if (from == std::string::npos || !is_with_unit(name, name.substr(0, from))) return "";
  return name.substr(from + 1, name.size() - from - 2);
}

std::size_t CsvTable::column(const std::string& name, const Place& place) const {
  if (const auto found = find(name)) return *found;
  throw InputError(place, path_ + " has no column '" + name + "'" + suggestion(name, names_));
}

std::string CsvTable::text(std::size_t row, std::size_t column) const {
  return text(cell(row, column));
}

std::optional<double> CsvTable::number(std::size_t row, std::size_t column) const {
  const std::string word = text(row, column);
  if (word.empty()) return std::nullopt;
  if (const auto value = parse_decimal(word)) return value;
  throw InputError(place(row, column), "the column " + names_[column] +
                                           " needs finite decimal numbers, not '" + word + "'");
}

Place CsvTable::place(std::size_t row, std::size_t column) const {
  return place(lines_[row], cell(row, column));
}

/// A line that is broken within quotation marks is walked through to find its part.
Place CsvTable::place(const Line& line, const Cell& cell) const {
  const std::size_t at = cell.begin - (cell.quoted ? 1U : 0U);
  Place place{path_, line.number, 0};
  std::size_t begin = line.begin;
  for (std::size_t k = begin; line.broken && k < at; ++k)
    if (ends_line(text_, k)) ++place.line, begin = k + 1;
  place.column = static_cast<int>(at - begin) + 1;
  return place;
}

}  // namespace gainsmith::io
