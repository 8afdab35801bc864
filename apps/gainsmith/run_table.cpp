#include "gainsmith/run_table.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "gainsmith/run_figure.h"
#include "io/csv.h"
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

std::string run_csv(const verify::Setup& setup, std::uint64_t seed, std::uint64_t run) {
  return events_csv(verify::table_of_run(setup, seed, run, 0));
}

std::string run_picture(const model::Design& design, const verify::Setup& setup, std::uint64_t seed,
                        std::uint64_t run) {
  const hybrid::Trajectory made = verify::table_of_run(setup, seed, run, 0).run;
  return run_figure(design.name, {drawn_run(setup, run, made, 0)}, view_of(design));
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

namespace {

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

/// The values of figure k that are numbers, ascending.
std::vector<double> values_of(const std::vector<verify::Comparison>& runs, std::size_t k) {
  std::vector<double> values;
  for (const verify::Comparison& run : runs)
    if (const auto& value = run.figures[k].value; value && !std::isnan(*value))
      values.push_back(*value);
  std::sort(values.begin(), values.end());
  return values;
}

double median_of(const std::vector<double>& ascending) {
  const std::size_t count = ascending.size();
  return (ascending[(count - 1) / 2] + ascending[count / 2]) / 2;
}

/// A line for each figure and observer: its spread over the runs.
std::string spread_table(const std::vector<verify::Comparison>& runs) {
  const std::vector<verify::FoundFigure>& figures = runs.front().figures;
  std::size_t width = 10, observer_width = 0;
  for (const verify::FoundFigure& figure : figures) {
    width = std::max(width, figure.title.size() + 2);
    observer_width = std::max(observer_width, figure.observer.size());
  }
  std::string text = fmt::format("{:<{}}{:>15}{:>15}{:>15}\n", "", width + observer_width, "least",
                                 "median", "largest");
  std::string missing;
  for (std::size_t k = 0; k < figures.size(); ++k) {
    const verify::FoundFigure& figure = figures[k];
    const std::vector<double> values = values_of(runs, k);
    const auto cell = [&](auto value_of) { return values.empty() ? "-" : brief(value_of()); };
    const bool same = k > 0 && figures[k - 1].title == figure.title;
    text +=
        fmt::format("{:<{}}{:<{}}{:>15}{:>15}{:>15}\n", same ? "" : figure.title, width,
                    figure.observer, observer_width, cell([&] { return values.front(); }),
                    cell([&] { return median_of(values); }), cell([&] { return values.back(); }));
    if (values.size() < runs.size())
      missing += fmt::format("{}{}: no value in {} of {} runs\n",
                             figure.observer.empty() ? "" : figure.observer + ": ", figure.title,
                             runs.size() - values.size(), runs.size());
  }
  return text + missing;
}

}  // namespace

std::string comparison_text(const std::vector<verify::Comparison>& runs) {
  return runs.size() == 1 ? comparison_table(runs.front().figures) : spread_table(runs);
}

}  // namespace gainsmith::app
