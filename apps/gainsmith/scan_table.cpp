#include "gainsmith/scan_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/file.h"
#include "base/number.h"
#include "gainsmith/picture_file.h"
#include "gainsmith/search_figure.h"
#include "gainsmith/terminal.h"
#include "io/json/json_text.h"
#include "io/matrix/csv.h"
#include "search/axis.h"

namespace gainsmith::app {

namespace {

std::string for_people(double value) {
  constexpr int kDigits = 8;
  return brief(value, kDigits);
}

/// Columns and cells, for the table and the CSV file.
struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

/// `text` of a number: for files or for people.
Table table_of(const std::vector<design::ScanRow>& rows, const std::vector<std::string>& names,
               const std::vector<std::string>& figures, bool minimizes,
               std::string (*text)(double)) {
  const auto number = [&](const std::optional<double>& value) {
    return value ? text(*value) : std::string();
  };
  Table table;
  table.columns = names;
  table.columns.push_back("verdict");
  if (minimizes) table.columns.push_back("objective");
  table.columns.insert(table.columns.end(), figures.begin(), figures.end());
  for (const design::ScanRow& row : rows) {
    std::vector<std::string> cells;
    for (const double value : row.at) cells.push_back(text(value));
    cells.push_back(verdict_of(row));
    if (minimizes) cells.push_back(number(row.objective));
    for (std::size_t k = 0; k < figures.size(); ++k)
      cells.push_back(k < row.figures.size() ? number(row.figures[k]) : "");
    table.rows.push_back(std::move(cells));
  }
  return table;
}

std::string csv(const Table& table) {
  std::string text;
  io::add_csv_line(table.columns, text);
  for (const auto& row : table.rows) io::add_csv_line(row, text);
  return text;
}

std::string aligned(const Table& table) {
  std::vector<std::size_t> widths;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    std::size_t width = table.columns[i].size();
    for (const auto& row : table.rows) width = std::max(width, row[i].size());
    widths.push_back(width);
  }
  std::string text;
  const auto line = [&](const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i)
      text += fmt::format("{:>{}}{}", cells[i], widths[i], i + 1 < cells.size() ? "  " : "\n");
  };
  line(table.columns);
  for (const auto& row : table.rows) line(row);
  return text;
}

std::string json(const std::vector<design::ScanRow>& rows, const ScanFacts& facts) {
  io::Json list = io::Json::array();
  for (const design::ScanRow& row : rows) {
    io::Json values = io::Json::object();
    for (std::size_t k = 0; k < facts.axes.size(); ++k) values[facts.axes[k].name] = row.at[k];
    io::Json entry = {{"at", values}, {"verdict", verdict_of(row)}};
    if (!row.refused.empty()) entry["message"] = row.refused;
    if (row.objective) entry["objective"] = *row.objective;
    for (std::size_t k = 0; k < row.figures.size(); ++k)
      entry["figures"][facts.figures[k]] =
          row.figures[k] ? io::finite_or_null(*row.figures[k]) : io::Json();
    list.push_back(std::move(entry));
  }
  return io::to_text(list);
}

/// Undecided when some point was not finished; yes when some point is feasible, no when every point
/// is infeasible.
ExitCode exit_of_all(const std::vector<design::ScanRow>& rows) {
  const auto unfinished =
      std::count_if(rows.begin(), rows.end(), [](const auto& row) { return row.interrupted; });
  if (unfinished > 0) {
    say(fmt::format("interrupted: {} of {} points have no answer\n", unfinished, rows.size()));
    return ExitCode::undecided;
  }
  const auto has = [&](model::Verdict verdict) {
    return std::any_of(rows.begin(), rows.end(), [&](const design::ScanRow& row) {
      return row.refused.empty() && row.verdict == verdict;
    });
  };
  if (has(model::Verdict::yes)) return ExitCode::yes;
  return has(model::Verdict::undecided) ? ExitCode::undecided : ExitCode::no;
}

ScanPicture picture_of(const ScanFacts& facts) {
  ScanPicture picture;
  picture.title = facts.title;
  for (const ScanFacts::Axis& axis : facts.axes)
    picture.axes.push_back({axis.title, axis.values, axis.logarithmic});
  picture.has_objective = !facts.objective.empty();
  if (picture.has_objective) picture.quantities.push_back(facts.objective);
  picture.quantities.insert(picture.quantities.end(), facts.titles.begin(), facts.titles.end());
  return picture;
}

}  // namespace

std::vector<std::vector<double>> points_of(const ScanFacts& facts) {
  std::vector<std::vector<double>> values;
  for (const ScanFacts::Axis& axis : facts.axes) values.push_back(axis.values);
  return search::grid(values);
}

ExitCode tell_scan(const ScanFacts& facts, const std::vector<design::ScanRow>& rows,
                   const ScanOutputs& outputs) {
  const Telling telling;
  const bool minimizes = !facts.objective.empty();
  if (!outputs.picture.empty())
    write_picture(outputs.picture, scan_figure(picture_of(facts), rows));
  std::vector<std::string> names, titles;
  for (const ScanFacts::Axis& axis : facts.axes) {
    names.push_back(axis.name);
    titles.push_back(axis.title);
  }
  const std::string file = csv(table_of(rows, names, facts.figures, minimizes, model::printed));
  if (outputs.table == "-") {
    fmt::print("{}", file);
    return exit_of_all(rows);
  }
  if (!outputs.table.empty()) write_atomically(outputs.table, file);
  fmt::print("{}", outputs.json
                       ? json(rows, facts)
                       : aligned(table_of(rows, titles, facts.titles, minimizes, for_people)) +
                             facts.note);
  return exit_of_all(rows);
}

}  // namespace gainsmith::app
