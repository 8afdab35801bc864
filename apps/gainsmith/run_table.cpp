#include "gainsmith/run_table.h"

#include <cmath>
#include <utility>
#include <vector>

#include "gainsmith/run_figure.h"
#include "io/matrix/csv.h"
#include "model/gains.h"

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

std::string run_csv(const verify::Setup& setup, const hybrid::Trajectory& run) {
  return events_csv(verify::table_of_run(setup, run, 0));
}

std::string run_picture(const model::Design& design, const verify::Setup& setup,
                        std::uint64_t number, hybrid::Trajectory& run) {
  std::vector<DrawnRun> drawn;  // a list in braces would copy it
  drawn.push_back(drawn_run(setup, number, std::move(run), 0));
  std::string picture = drawing::svg(run_figure(design.name, *setup.events, drawn, view_of(design)));
  run = std::move(drawn.front().replay.run);
  return picture;
}

std::string events_csv(const verify::Replay& replay) {
  std::string text;
  io::add_csv_line(names_of(replay), text);
  std::vector<std::string> cells;
  for (Eigen::Index row = 0; row < replay.table.rows(); ++row) {
    cells.clear();
    for (std::size_t k = 0; k < replay.columns.size(); ++k) {
      const double value = replay.table(row, static_cast<Eigen::Index>(k));
      cells.push_back(std::isfinite(value) ? model::printed(value) : "");
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

}  // namespace gainsmith::app
