#include "design/optimize.h"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/save_pace.h"
#include "base/stop.h"
#include "gainsmith/commands.h"
#include "gainsmith/kept_folder.h"
#include "gainsmith/load.h"
#include "gainsmith/output.h"
#include "gainsmith/part_file.h"
#include "gainsmith/range_option.h"
#include "gainsmith/search_wanted.h"
#include "gainsmith/summary.h"
#include "gainsmith/terminal.h"
#include "io/json/json_fields.h"

namespace gainsmith::app {

namespace {

struct OptimizeOptions {
  std::string problem;
  std::vector<std::string> set;
  std::vector<std::string> over;
  std::string largest;
  std::string smallest;
  std::string minimize;
  std::optional<double> tolerance;
  std::optional<int> evaluations;
  unsigned threads = 0;
  bool refine = false;
  std::string resume;
  std::string output;
  bool json = false;
};

model::ScalarRange range_of(const std::string& text, const char* option,
                            const model::Problem& problem) {
  const RangeOption parsed = parse_range(text, option);
  model::check_scalar_name(*problem.method, parsed.range.name, {option});
  if (parsed.count) throw InputError({option}, "expected NAME=LOW:HIGH, not '" + text + "'");
  return parsed.range;
}

/// Adds what the command line says to the problem's search.
void add_search(const OptimizeOptions& options, model::Problem& problem) {
  model::Search search = problem.search.value_or(model::Search{});
  if (!options.over.empty()) search.over.clear();
  for (const std::string& text : options.over)
    search.over.push_back(range_of(text, "--over", problem));
  for (const bool largest : {true, false}) {
    const std::string& text = largest ? options.largest : options.smallest;
    if (text.empty()) continue;
    search.extreme = range_of(text, largest ? "--largest" : "--smallest", problem);
    search.largest = largest;
    search.minimize.reset();
    search.run_figure.reset();
  }
  if (!options.minimize.empty()) {
    search.minimize = parse_expression(options.minimize, "--minimize");
    search.run_figure.reset();
    search.extreme.reset();
  }
  if (options.tolerance && !search.extreme)
    throw InputError({"--tolerance"}, "it belongs to --largest or --smallest");
  if (options.tolerance) search.tolerance = options.tolerance;
  if (options.evaluations) search.evaluations = *options.evaluations;
  problem.search = search;
  if (!options.over.empty() || !options.largest.empty() || !options.smallest.empty())
    state_search(search, problem);
}

constexpr auto kKnownValueFields = [](auto& at, auto& entry) {
  auto& [key, value] = entry;
  at("function", key.first);
  at("point", key.second);
  at("value", value);
};

io::Json values_json(const search::KnownValues& known) {
  io::Json values = io::Json::array();
  for (const auto& entry : known.all())
    values.push_back(io::record_json(entry, kKnownValueFields, io::JsonNumbers::exact));
  return values;
}

void take_values(const io::Json& document, const std::string& file, search::KnownValues& known) {
  for (const io::JsonReader& item : io::JsonReader(document, file).items()) {
    std::pair<search::KnownValues::Key, std::optional<double>> entry;
    io::read_record(item, entry, kKnownValueFields, io::JsonNumbers::exact);
    known.add(std::move(entry.first), entry.second);
  }
}

/// What the values follow from.
io::Json statement_of(const OptimizeOptions& options, const model::Instance& instance) {
  const auto text = [](const auto& value) { return value ? fmt::format("{}", *value) : ""; };
  io::Json statement = begin_statement("search");
  statement["problem_sha256"] = instance.design->statement.hash;
  statement["--over"] = options.over;
  statement["--largest"] = options.largest;
  statement["--smallest"] = options.smallest;
  statement["--minimize"] = options.minimize;
  statement["--tolerance"] = text(options.tolerance);
  statement["--evaluations"] = text(options.evaluations);
  return statement;
}

/// The search; with --resume from the values that its folder has.
model::Gains search(const OptimizeOptions& options, const model::Instance& instance,
                    const design::SearchRequest& request) {
  search::KnownValues known;
  if (options.resume.empty())
    return design::optimize(instance, request, options.threads, {}, known);
  KeptFolder folder(options.resume, statement_of(options, instance));
  if (folder.kept()) take_values(folder.kept()->done, folder.kept()->file, known);
  const auto keep = [&] { folder.keep(values_json(known)); };
  keep();  // whether the folder can be written to is known before the work
  SavePace pace;
  known.grown = [&] {
    if (pace.is_due()) pace.save(keep);
  };
  const auto say_kept = [&] {
    keep();
    say(fmt::format("gainsmith: {} keeps {} values; the same command goes on from there\n",
                    options.resume, known.all().size()));
  };
  try {
    model::Gains gains = design::optimize(instance, request, options.threads, {}, known);
    if (gains.search && !gains.search->finished)
      say_kept();
    else
      keep();
    return gains;
  } catch (const Stopped&) {
    say_kept();
    throw;
  }
}

ExitCode optimize(const OptimizeOptions& options) {
  prepare_outputs(options.problem, {options.output});
  check_positive(options.tolerance, "--tolerance");
  const model::Instance instance = load_problem(
      options.problem, options.set, [&](model::Problem& problem) { add_search(options, problem); });
  design::SearchRequest request = wanted_search(instance);
  request.refine = options.refine;
  if (request.over.empty())
    throw InputError({options.problem},
                     "nothing to optimise over: give --over NAME=LOW:HIGH, or write search: {over: "
                     "{NAME: [low, high]}} into the problem");
  model::Gains gains = search(options, instance, request);
  find_error(instance, gains);
  const Telling telling;
  write_result(gains, options.output,
               options.json ? io::to_text(json_without_statement(gains)) : synthesis_summary(gains),
               options.json);
  return exit_of_search(gains);
}

}  // namespace

Command optimize_command() {
  auto options = std::make_shared<OptimizeOptions>();
  return {
      "optimize",
      "Find the best values of a few scalars outside the inequalities",
      {Option("problem", options->problem, "problem file (YAML); - for standard input").required(),
       set_option(options->set),
       Option("--over", options->over,
              "NAME=LOW:HIGH, once for each scalar (default: the problem's search)"),
       Option("--largest", options->largest,
              "NAME=LOW:HIGH: make this scalar as large as it can be"),
       Option("--smallest", options->smallest, "NAME=LOW:HIGH: as small as it can be")
           .excludes({"--largest"}),
       Option("--minimize", options->minimize, "an expression (default: the method's objective)")
           .excludes({"--largest", "--smallest"}),
       Option("--tolerance", options->tolerance, "width of the bracket of --largest or --smallest"),
       Option("--refine", options->refine,
              "at the end move scalars and unknowns together (Ipopt); kept when it is better"),
       Option("--evaluations", options->evaluations, "of the figure, at most").within(1, 1000000),
       Option("--threads", options->threads,
              "threads, 0: as many as cores it may use; the result does not depend on it")
           .within(0, 1024),
       Option("--resume", options->resume,
              "keep in this folder what is done: after a stop of any kind the same command goes on "
              "from it"),
       Option("-o,--output", options->output, "write the gain file here; - for standard output"),
       Option("--json", options->json, "print the result as JSON")},
      "Exit code: 0 gains found, 2 wrong input, 3 nothing feasible was found.\n"
      "Examples:\n"
      "  gainsmith optimize problem.yaml --over delta=1e-3:10 --over eta=1e-6:1 -o gains.json\n"
      "  gainsmith optimize problem.yaml --over delta=1e-3:10 --largest T2=0.5:1.1\n"
      "  gainsmith optimize problem.yaml --over delta=1e-3:10 --minimize 'trace(P1)' --refine",
      [options] { return optimize(*options); }};
}

}  // namespace gainsmith::app
