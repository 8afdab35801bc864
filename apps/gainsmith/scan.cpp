#include "design/scan.h"

#include <fmt/format.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/save_pace.h"
#include "design/search_request.h"
#include "gainsmith/advice.h"
#include "gainsmith/commands.h"
#include "gainsmith/kept_folder.h"
#include "gainsmith/load.h"
#include "gainsmith/output.h"
#include "gainsmith/picture_file.h"
#include "gainsmith/range_option.h"
#include "gainsmith/scan_parts.h"
#include "gainsmith/scan_table.h"
#include "gainsmith/terminal.h"
#include "gainsmith/units.h"

namespace gainsmith::app {

namespace {

struct ScanOptions {
  std::string problem;
  std::vector<std::string> set;
  std::vector<std::string> over;
  std::vector<std::string> show;
  unsigned threads = 0;
  std::string shard;
  std::string resume;
  std::string output;
  std::string plot;
  bool json = false;
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

std::vector<ScanFacts::Axis> axes_of(const std::vector<RangeOption>& ranges,
                                     const model::Instance& instance) {
  constexpr int kDefault = 11;
  constexpr double kMost = 1e7;
  std::vector<ScanFacts::Axis> axes;
  double count = 1;
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    const RangeOption& option = ranges[k];
    ScanFacts::Axis& made =
        axes.emplace_back(option.range.name, with_unit(*instance.design, option.range.name));
    if (option.is_value) {
      made.values = {model::scalar_value(instance.design->asked[k].low, instance.values)};
      continue;
    }
    search::Axis axis = design::searched_scalar(instance, instance.design->asked[k]).axis;
    axis.logarithmic = option.logarithmic.value_or(axis.logarithmic);
    if (axis.logarithmic && !(axis.low > 0))
      throw InputError({"--over"},
                       option.range.name + ": a logarithmic scale needs a low end above 0");
    made.logarithmic = axis.logarithmic;
    made.values = points_on(axis, option.count.value_or(kDefault));
    count *= static_cast<double>(made.values.size());
  }
  if (count > kMost) throw InputError({"--over"}, "the grid has more than 1e7 points");
  return axes;
}

ScanFacts facts_of(const ScanOptions& options, const std::vector<RangeOption>& ranges,
                   const model::Instance& instance) {
  const model::Design& design = *instance.design;
  ScanFacts facts;
  facts.title = design.name;
  facts.axes = axes_of(ranges, instance);
  if (design.objective || design.quotient) facts.objective = with_unit(design, "objective");
  facts.figures = options.show;
  for (const std::string& text : options.show) facts.titles.push_back(with_unit(design, text));
  std::vector<std::string> names;
  for (const ScanFacts::Axis& axis : facts.axes) names.push_back(axis.name);
  facts.note = held_line(instance, names);
  return facts;
}

void check_picture(const ScanOptions& options) {
  check_picture_name(options.plot);
  if (!options.plot.empty() && options.over.size() > 2)
    throw InputError({"--plot"}, "a picture shows a grid of one scalar or two, not of " +
                                     std::to_string(options.over.size()));
}

/// Answers the points of the part; with --resume those whose answers its folder has not yet.
void answer_points(const ScanOptions& options, const model::Instance& instance, ScanPart& part) {
  std::vector<std::string> names;
  for (const ScanFacts::Axis& axis : part.facts.axes) names.push_back(axis.name);
  const auto answer = [&](const std::function<void()>& answered) {
    std::vector<std::size_t> which;
    for (const std::size_t k : points_of_shard(part))
      if (part.rows[k].interrupted) which.push_back(k);
    design::scan(instance.design, names, which, options.threads, {}, part.rows, answered);
  };
  if (options.resume.empty()) return answer({});
  io::Json statement = part.statement;
  statement["shard"] = to_text(part.shard);
  KeptFolder folder(options.resume, std::move(statement));
  if (folder.kept()) take_rows(folder.kept()->done, folder.kept()->file, part);
  const auto keep = [&] { folder.keep(rows_json(part)); };
  keep();
  SavePace pace;
  answer([&] {
    if (pace.is_due()) pace.save(keep);
  });
  keep();
  if (const auto open = open_points(part); open > 0)
    say(
        fmt::format("gainsmith: {} keeps all but {} of {} points; the same command goes on from "
                    "there\n",
                    options.resume, open, points_of_shard(part).size()));
}

/// 0 for a part that is whole, whatever its answers are; otherwise nothing is written.
ExitCode tell_scan_part(const ScanOptions& options, const ScanPart& part) {
  const std::size_t all = points_of_shard(part).size(), open = open_points(part);
  if (open > 0) {
    say_unwritten(part.shard, fmt::format("{} of {} points", all - open, all));
    return ExitCode::undecided;
  }
  write_part(document_of(part), options.output,
             fmt::format("{} of {} points", all, part.rows.size()));
  return ExitCode::yes;
}

ExitCode scan(const ScanOptions& options) {
  check_picture(options);
  require_part_name(options.shard, options.output);
  prepare_outputs(options.problem, {options.output, options.plot});
  std::vector<RangeOption> ranges;
  for (const std::string& text : options.over) ranges.push_back(parse_range(text, "--over"));
  const model::Instance instance =
      load_problem(options.problem, options.set,
                   [&](model::Problem& problem) { add_questions(options, ranges, problem); });
  ScanPart part;
  part.facts = facts_of(options, ranges, instance);
  part.statement = begin_statement("scan");
  part.statement["problem_sha256"] = instance.design->statement.hash;
  part.statement["--over"] = options.over;
  part.statement["--show"] = options.show;
  part.shard = parse_shard(options.shard);
  part.rows = design::rows_of(points_of(part.facts));
  answer_points(options, instance, part);
  if (!options.shard.empty()) return tell_scan_part(options, part);
  design::require_a_point(part.rows);
  return tell_scan(part.facts, part.rows, {options.output, options.plot, options.json});
}

}  // namespace

Command scan_command() {
  auto options = std::make_shared<ScanOptions>();
  return {
      "scan",
      "Solve a problem at every point of a grid of scalars",
      {Option("problem", options->problem, "problem file (YAML); - for standard input").required(),
       set_option(options->set),
       Option(
           "--over", options->over,
           "NAME=LOW:HIGH[:COUNT[:log|lin]] or NAME=VALUE; 11 points without COUNT; without log or "
           "lin a range of positive numbers that spans two decades is logarithmic; may be "
           "repeated for a grid")
           .required(),
       Option("--show", options->show,
              "a column more: an expression such as trace(P1) or norm(L); may be repeated"),
       Option("--threads", options->threads,
              "threads, 0: as many as cores it may use; the table does not depend on it")
           .within(0, 1024),
       shard_option(options->shard,
                    "solve only part I of N of the points, and write it with -o for 'merge'"),
       Option("--resume", options->resume,
              "keep in this folder what is done: after a stop of any kind the same command goes on "
              "from it"),
       Option("-o,--output", options->output,
              "write the table as CSV here, or the part; - for standard output"),
       Option("--plot", options->plot,
              "draw the table here: what it shows over one scalar, or a map of two (.svg, .pdf, "
              ".png)")
           .excludes({"--shard"}),
       Option("--json", options->json, "print the table as JSON").excludes({"--shard"})},
      "A point that the method's assumptions exclude is 'refused'.\n"
      "Exit code: 0 some point is feasible, 1 all are infeasible by certificates, 2 wrong input, 3 "
      "otherwise\n"
      "and when interrupted. With --shard: 0 the part is whole, 3 interrupted.\n"
      "Examples:\n"
      "  gainsmith scan problem.yaml --over T2=0.5:0.8:13\n"
      "  gainsmith scan problem.yaml --over delta=1e-3:10:20:log --over eta=1e-6:1:7 -o table.csv\n"
      "  gainsmith scan problem.yaml --over T2=0.5:0.8 --show 'norm(L)' --plot scan.svg",
      [options] { return scan(*options); }};
}

}  // namespace gainsmith::app
