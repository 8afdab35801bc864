#include "gainsmith/run_table.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "gainsmith/run_figure.h"
#include "io/csv.h"

namespace gainsmith::app {

namespace {

using Kind = verify::Column::Kind;

/// t, j, then the event, which is no number.
std::vector<std::string> names_of(const verify::Replay& replay) {
  std::vector<std::string> names;
  for (const verify::Column& column : replay.columns) {
    names.push_back(column.name);
    if (column.kind == Kind::jumps) names.emplace_back("event");
  }
  return names;
}

}  // namespace

std::string run_csv(const verify::Setup& setup, std::uint64_t seed, std::uint64_t run) {
  return events_csv(verify::table_of_run(setup, seed, run, 0));
}

std::string run_picture(const model::Design& design, const verify::Setup& setup, std::uint64_t seed,
                        std::uint64_t run) {
  constexpr double kPoints = 1500;
  return run_figure(
      design.name, {{run, verify::table_of_run(setup, seed, run, setup.horizon() / kPoints, true)}},
      view_of(design));
}

std::string events_csv(const verify::Replay& replay) {
  std::string text;
  io::add_csv_line(names_of(replay), text);
  std::vector<std::string> cells;
  for (Eigen::Index row = 0; row < replay.table.rows(); ++row) {
    cells.clear();
    for (std::size_t k = 0; k < replay.columns.size(); ++k) {
      const double value = replay.table(row, static_cast<Eigen::Index>(k));
      cells.push_back(std::isfinite(value) ? decimal17(value) : "");
      if (replay.columns[k].kind == Kind::jumps)
        cells.push_back(replay.events[static_cast<std::size_t>(row)]);
    }
    io::add_csv_line(cells, text);
  }
  return text;
}

io::Json events_json(const verify::Replay& replay, const RunView& view) {
  io::Json rows = io::Json::array();
  for (Eigen::Index row = 0; row < replay.table.rows(); ++row) {
    io::Json cells = io::Json::array();
    for (std::size_t k = 0; k < replay.columns.size(); ++k) {
      cells.push_back(io::finite_or_null(replay.table(row, static_cast<Eigen::Index>(k))));
      if (replay.columns[k].kind == Kind::jumps)
        cells.push_back(replay.events[static_cast<std::size_t>(row)]);
    }
    rows.push_back(std::move(cells));
  }
  io::Json document = {{"ending", to_string(replay.run.ending)}, {"end", replay.run.end}};
  if (!replay.run.message.empty()) document["message"] = replay.run.message;
  if (!replay.run.notes.empty()) document["notes"] = replay.run.notes;
  document["columns"] = names_of(replay);
  for (const verify::Column& column : replay.columns)
    if (const std::string unit = unit_of(view, column); !unit.empty())
      document["units"][column.name] = unit;
  document["rows"] = rows;
  return document;
}

namespace {

/// Least, median and largest value of each figure, and those that have none in some runs.
std::pair<std::vector<verify::FoundFigure>, std::string> spread(
    const std::vector<verify::Comparison>& runs) {
  std::vector<verify::FoundFigure> rows;
  std::string missing;
  for (std::size_t k = 0; k < runs.front().figures.size(); ++k) {
    verify::FoundFigure row = runs.front().figures[k];
    std::vector<double> values;
    for (const verify::Comparison& run : runs)
      if (run.figures[k].value && !std::isnan(*run.figures[k].value))
        values.push_back(*run.figures[k].value);
    std::sort(values.begin(), values.end());
    const std::string title = row.title;
    const std::size_t count = values.size();
    if (count > 0 && count < runs.size())
      missing += fmt::format("{}{}: no value in {} of {} runs\n",
                             row.observer.empty() ? "" : row.observer + ": ", title,
                             runs.size() - count, runs.size());
    const auto add = [&](const char* which, auto value_of) {
      row.title = title + ": " + which;
      row.value = count > 0 ? std::optional<double>(value_of()) : std::nullopt;
      rows.push_back(row);
    };
    add("least", [&] { return values.front(); });
    add("median", [&] { return (values[(count - 1) / 2] + values[count / 2]) / 2; });
    add("largest", [&] { return values.back(); });
  }
  return {std::move(rows), std::move(missing)};
}

std::string comparison_table(const std::vector<verify::FoundFigure>& figures) {
  bool has_all = true;
  std::vector<std::string> observers;
  std::vector<std::string> titles;
  const auto add = [](std::vector<std::string>& list, const std::string& one) {
    if (std::find(list.begin(), list.end(), one) == list.end()) list.push_back(one);
  };
  for (const verify::FoundFigure& figure : figures) {
    add(observers, figure.observer);
    add(titles, figure.title);
  }
  std::size_t width = 10;
  for (const std::string& title : titles) width = std::max(width, title.size() + 2);
  std::size_t column = 13;
  for (const std::string& observer : observers) column = std::max(column, observer.size());
  column += 2;
  std::string text = fmt::format("{:<{}}", "", width);
  for (const std::string& observer : observers)
    text += fmt::format("{:>{}}", observer.empty() ? "all" : observer, column);
  text += '\n';
  for (const std::string& title : titles) {
    text += fmt::format("{:<{}}", title, width);
    for (const std::string& observer : observers) {
      const auto found = std::find_if(figures.begin(), figures.end(), [&](const auto& one) {
        return one.title == title && one.observer == observer;
      });
      const bool known = found != figures.end() && found->value;
      has_all = has_all && (known || found == figures.end());
      text += fmt::format("{:>{}}", known ? brief(*found->value) : "-", column);
    }
    text += '\n';
  }
  if (!has_all)
    text += "-: no such event in this run, a time after its end, or a value that is no number\n";
  return text;
}

}  // namespace

std::string comparison_text(const std::vector<verify::Comparison>& runs) {
  if (runs.size() == 1) return comparison_table(runs.front().figures);
  const auto [rows, missing] = spread(runs);
  return comparison_table(rows) + missing;
}

}  // namespace gainsmith::app
