#include "design/scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "base/file.h"
#include "base/number.h"
#include "design/search_request.h"
#include "gainsmith/advice.h"
#include "gainsmith/commands.h"
#include "gainsmith/load.h"
#include "gainsmith/output.h"
#include "gainsmith/picture_file.h"
#include "gainsmith/range_option.h"
#include "gainsmith/search_figure.h"
#include "gainsmith/terminal.h"
#include "gainsmith/units.h"
#include "io/csv.h"
#include "io/json_text.h"

namespace gainsmith::app {

namespace {

struct ScanOptions {
  std::string problem;
  std::vector<std::string> set;
  std::vector<std::string> over;
  std::vector<std::string> show;
  unsigned threads = 0;
  std::string output;
  std::string plot;
  bool json = false;
};

struct Grid {
  std::vector<std::string> names;
  std::vector<std::vector<double>> values;
  std::vector<bool> logarithmic;
};

/// Adds the ranges and columns of the command line to what the problem is asked.
void add_questions(const ScanOptions& options, const std::vector<RangeOption>& ranges,
                   model::Problem& problem) {
  for (const RangeOption& option : ranges) {
    model::check_scalar_name(*problem.method, option.range.name, {"--over"});
    for (const model::ScalarRange& known : problem.questions.ranges)
      if (known.name == option.range.name)
        throw InputError({"--over"}, option.range.name + " is given twice");
    problem.questions.ranges.push_back(option.range);
  }
  for (const std::string& text : options.show)
    problem.questions.figures.push_back(parse_expression(text, "--show"));
}

Grid grid_of(const std::vector<RangeOption>& ranges, const model::Instance& instance) {
  constexpr int kDefault = 11;
  constexpr double kMost = 1e7;
  Grid grid;
  double count = 1;
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    const RangeOption& option = ranges[k];
    grid.names.push_back(option.range.name);
    if (option.is_value) {
      grid.values.push_back({model::scalar_value(instance.design->asked[k].low, instance.values)});
      grid.logarithmic.push_back(false);
      continue;
    }
    search::Axis axis = design::searched_scalar(instance, instance.design->asked[k]).axis;
    axis.logarithmic = option.logarithmic.value_or(axis.logarithmic);
    if (axis.logarithmic && !(axis.low > 0))
      throw InputError({"--over"},
                       option.range.name + ": a logarithmic scale needs a low end above 0");
    grid.logarithmic.push_back(axis.logarithmic);
    grid.values.push_back(points_on(axis, option.count.value_or(kDefault)));
    count *= static_cast<double>(grid.values.back().size());
  }
  if (count > kMost) throw InputError({"--over"}, "the grid has more than 1e7 points");
  return grid;
}

bool has_objective(const model::Design& design) { return design.objective || design.quotient; }

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

std::string json(const std::vector<design::ScanRow>& rows, const Grid& grid,
                 const std::vector<std::string>& figures) {
  io::Json list = io::Json::array();
  for (const design::ScanRow& row : rows) {
    io::Json values = io::Json::object();
    for (std::size_t k = 0; k < grid.names.size(); ++k) values[grid.names[k]] = row.at[k];
    io::Json entry = {{"at", values}, {"verdict", verdict_of(row)}};
    if (!row.refused.empty()) entry["message"] = row.refused;
    if (row.objective) entry["objective"] = *row.objective;
    for (std::size_t k = 0; k < row.figures.size(); ++k)
      entry["figures"][figures[k]] =
          row.figures[k] ? io::finite_or_null(*row.figures[k]) : io::Json();
    list.push_back(std::move(entry));
  }
  return io::to_text(list);
}

/// Undecided when some point was not finished; yes when some point is feasible, no when every point
/// is excluded.
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

ScanPicture picture_of(const ScanOptions& options, const Grid& grid, const model::Design& design) {
  ScanPicture picture;
  picture.title = design.name;
  for (std::size_t k = 0; k < grid.names.size(); ++k)
    picture.axes.push_back({with_unit(design, grid.names[k]), grid.values[k], grid.logarithmic[k]});
  picture.has_objective = has_objective(design);
  if (picture.has_objective) picture.quantities.push_back(with_unit(design, "objective"));
  for (const std::string& text : options.show)
    picture.quantities.push_back(with_unit(design, text));
  return picture;
}

void check_picture(const ScanOptions& options) {
  check_picture_name(options.plot);
  if (!options.plot.empty() && options.over.size() > 2)
    throw InputError({"--plot"}, "a picture shows a grid of one scalar or two, not of " +
                                     std::to_string(options.over.size()));
}

ExitCode scan(const ScanOptions& options) {
  check_picture(options);
  prepare_outputs(options.problem, {options.output, options.plot});
  std::vector<RangeOption> ranges;
  for (const std::string& text : options.over) ranges.push_back(parse_range(text, "--over"));
  const model::Instance instance =
      load_problem(options.problem, options.set,
                   [&](model::Problem& problem) { add_questions(options, ranges, problem); });
  const Grid grid = grid_of(ranges, instance);
  const auto rows =
      design::scan(instance.design, grid.names, search::grid(grid.values), options.threads, {});
  const Telling telling;
  const bool minimizes = has_objective(*instance.design);
  if (!options.plot.empty())
    write_picture(options.plot, scan_figure(picture_of(options, grid, *instance.design), rows));
  const std::string file = csv(table_of(rows, grid.names, options.show, minimizes, model::printed));
  if (options.output == "-") {
    fmt::print("{}", file);
    return exit_of_all(rows);
  }
  if (!options.output.empty()) write_atomically(options.output, file);
  std::vector<std::string> titles, shown;
  for (const std::string& name : grid.names) titles.push_back(with_unit(*instance.design, name));
  for (const std::string& text : options.show) shown.push_back(with_unit(*instance.design, text));
  fmt::print("{}", options.json ? json(rows, grid, options.show)
                                : aligned(table_of(rows, titles, shown, minimizes, for_people)) +
                                      held_line(instance, grid.names));
  return exit_of_all(rows);
}

}  // namespace

Command scan_command() {
  auto options = std::make_shared<ScanOptions>();
  return {
      "scan",
      "Solve a problem at every point of a grid of scalars",
      {Option("problem", options->problem, "problem file (YAML); - for standard input").required(),
       set_option(options->set),
       Option("--over", options->over,
              "NAME=LOW:HIGH[:COUNT[:log|lin]], 11 points without COUNT, or NAME=VALUE; may be "
              "repeated for a grid")
           .required(),
       Option("--show", options->show,
              "a column more: an expression such as trace(P1) or norm(L); may be repeated"),
       Option("--threads", options->threads,
              "threads, 0: as many as cores it may use; the table does not depend on it")
           .within(0, 1024),
       Option("-o,--output", options->output, "write the table as CSV here; - for standard output"),
       Option("--plot", options->plot,
              "draw the table here: what it shows over one scalar, or a map of two (.svg, .pdf, "
              ".png)"),
       Option("--json", options->json, "print the table as JSON")},
      "A point that the method's assumptions exclude is 'refused'.\n"
      "Exit code: 0 some point is feasible, 1 all are excluded by certificates, 2 wrong input, 3 "
      "otherwise\n"
      "and when interrupted.\n"
      "Examples:\n"
      "  gainsmith scan problem.yaml --over T2=0.5:0.8:13\n"
      "  gainsmith scan problem.yaml --over delta=1e-3:10:20:log --over eta=1e-6:1:7 -o table.csv\n"
      "  gainsmith scan problem.yaml --over T2=0.5:0.8 --show norm(L) --plot scan.svg",
      [options] { return scan(*options); }};
}

}  // namespace gainsmith::app
