#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bind/stated.h"
#include "claims/run_setup.h"
#include "design/excluded_inequalities.h"
#include "design/sos_statements.h"
#include "gainsmith/commands.h"
#include "gainsmith/gain_check.h"
#include "gainsmith/load.h"
#include "gainsmith/notes.h"
#include "gainsmith/output.h"
#include "gainsmith/problem_files.h"
#include "gainsmith/terminal.h"
#include "hybrid/doubts.h"
#include "hybrid/idle.h"
#include "io/json/json_text.h"
#include "lmi/compile.h"

namespace gainsmith::app {

namespace {

struct CheckOptions {
  std::vector<std::string> problems;
  std::vector<std::string> set;
  bool strict = false;
  bool json = false;
};

bool has_start(const model::Design& design, std::size_t state) {
  const auto& starts = design.campaign.starts;
  return design.states[state].start || design.states[state].shape.size() == 0 ||
         std::any_of(starts.begin(), starts.end(),
                     [&](const auto& start) { return start.state == state; });
}

/// What of a campaign the problem leaves to the defaults.
std::vector<std::string> campaign_defaults(const model::Design& design) {
  std::vector<std::string> words;
  if (!design.dynamics || design.claims.empty() || !design.no_campaign.empty()) return words;
  if (!model::has_end(design) && model::ends(design))
    words.emplace_back("campaign.horizon: 40 of the timer's longest intervals");
  for (std::size_t i = 0; i < design.states.size(); ++i)
    if (!has_start(design, i) &&
        hybrid::starts_in_a_box(*design.dynamics, design.dynamics->variables[i]))
      words.push_back("campaign.initial." + design.states[i].name +
                      ": the box [-1, 1], in the units of the file");
  return words;
}

/// States that start nowhere: no run can be made.
std::vector<std::string> missing_starts(const model::Design& design) {
  std::vector<std::string> names;
  for (std::size_t i = 0; design.dynamics && i < design.states.size(); ++i)
    if (!has_start(design, i) &&
        !hybrid::starts_in_a_box(*design.dynamics, design.dynamics->variables[i]))
      names.push_back(design.states[i].name);
  return names;
}

/// Finds what a run would refuse, where it needs no gains: a horizon beyond the data, a time from
/// which on nothing is claimed. What it says of the runs besides.
std::vector<std::string> check_runs(const model::Instance& instance) {
  const model::Design& design = *instance.design;
  std::vector<std::string> notes = bind::unread_names(design);
  if (design.dynamics)
    for (std::string& doubt :
         hybrid::doubts_about(*design.dynamics, design.claims, instance.values))
      notes.push_back(std::move(doubt));
  const bool runs = design.dynamics && design.no_campaign.empty() && model::ends(design);
  if (!runs) return notes;
  const std::vector<std::string> nowhere = missing_starts(design);
  if (!nowhere.empty()) {
    notes.push_back(note_on_starts(nowhere));
    return notes;
  }
  const bool needs_nothing = design.unknowns.empty() && design.inequalities.empty() &&
                             design.open.empty() && design.gains.empty();
  if (!needs_nothing) return notes;
  const auto setup = claims::make_run_setup(bind::run_texts(instance, {}));
  std::vector<std::string> late;
  for (const std::size_t event : hybrid::late_events(setup->system, setup->scenario))
    late.push_back(design.dynamics->events[event].name);
  if (!late.empty()) notes.push_back(note_on_events(late) + ": it is due after the horizon");
  // Where each run is made once at most, or nothing is claimed of it, nothing has to be drawn.
  const auto different = hybrid::different_runs(setup->system, setup->scenario);
  if (different && !design.claims.empty() && design.campaign.runs > *different)
    notes.push_back(note_on_runs(different));
  return notes;
}

struct Sizes {
  int unknowns = 0;
  std::size_t blocks = 0;
};

/// Of its inequalities, which are posed: InputError where they cannot be.
Sizes sizes_of(const model::Instance& instance) {
  const lmi::Inequalities inequalities(instance);
  if (design::has_sums_of_squares(*instance.design))
    return {inequalities.unknowns.size(), design::sos_statements(inequalities).statements.size()};
  const lmi::Lmi lmi = lmi::compile(inequalities);
  return {lmi.unknowns, lmi.blocks.size()};
}

/// What a valid problem asks for.
io::Json description(const model::Instance& instance, const std::vector<std::string>& notes) {
  const Sizes found = sizes_of(instance);
  if (!instance.design->necessary.inequalities.empty())
    lmi::compile(lmi::Inequalities(design::with_necessary(instance)));
  io::Json sizes = io::Json::object();
  for (const auto& [name, size] : instance.design->dimensions) sizes[name] = size;
  io::Json result = {{"valid", true},
                     {"problem", instance.design->name},
                     {"method", instance.design->method},
                     {"dimensions", sizes},
                     {"unknown_scalars", found.unknowns},
                     {"blocks", found.blocks},
                     {"campaign_defaults", campaign_defaults(*instance.design)},
                     {"notes", notes}};
  if (const auto& dynamics = instance.design->dynamics) {
    io::Json observers = io::Json::array();
    io::Json events = io::Json::array();
    for (const auto& component : dynamics->components)
      if (component.observer) observers.push_back(component.name);
    for (const auto& event : dynamics->events) events.push_back(event.name);
    result["observers"] = std::move(observers);
    result["events"] = std::move(events);
  }
  return result;
}

/// "plain, careful", or "none".
std::string listed(const io::Json& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name.get<std::string>();
  return text.empty() ? "none" : text;
}

std::string text_of(const std::string& path, const io::Json& found) {
  const int unknowns = found["unknown_scalars"].get<int>();
  const int blocks = found["blocks"].get<int>();
  std::string text =
      fmt::format("{}: valid: method {}, {}\n", path, found["method"].get<std::string>(),
                  unknowns + blocks == 0
                      ? "a design by formula"
                      : fmt::format("{} unknown scalars, {} inequality blocks", unknowns, blocks));
  if (found.contains("events"))
    text += fmt::format("  observers   {}\n  events      {}\n", listed(found["observers"]),
                        listed(found["events"]));
  for (const auto& word : found["campaign_defaults"])
    text += fmt::format("  by default  {}\n", word.get<std::string>());
  for (const auto& note : found["notes"])
    text += fmt::format("  note        {}\n", note.get<std::string>());
  return text;
}

/// How much is printed of a file.
enum class Detail { none, line, all };

void print(const std::string& text, Detail detail) {
  if (detail == Detail::none) return;
  fmt::print("{}", detail == Detail::line ? text.substr(0, text.find('\n') + 1) : text);
}

/// One file: its result as JSON, printed where JSON is not asked for.
ExitCode check_file(const std::string& path, const CheckOptions& options, Detail detail,
                    io::Json& found) {
  if (is_gain_file(path)) {
    const design::GainCheck checked = check_gains(load_gains(path));
    found = gain_check_json(path, checked);
    print(gain_check_text(path, checked), detail);
    return exit_of(checked.verdict);
  }
  const model::Instance instance = load_problem(path, options.set);
  const std::vector<std::string> notes = check_runs(instance);
  if (options.strict) refuse_notes(path, notes);
  found = description(instance, notes);
  print(text_of(path, found), detail);
  found["file"] = path;
  return ExitCode::yes;
}

/// Of several files: a wrong one, then one that does not hold, then one that is not known.
ExitCode worse(ExitCode a, ExitCode b) {
  for (const ExitCode code : {ExitCode::bad_input, ExitCode::no, ExitCode::undecided})
    if (a == code || b == code) return code;
  return ExitCode::yes;
}

/// The line of a wrong file among others: its name at first, as in those of good files.
std::string wrong_line(const std::string& path, const InputError& error) {
  const std::string what = error.what();
  return (what.starts_with(path) ? what : path + ": " + what) + "\n";
}

/// "5 files: 3 good, 1 wrong, 1 not known".
std::string total(const std::map<ExitCode, int>& counts, std::size_t files) {
  std::string text = fmt::format("{} files:", files);
  std::string mark = " ";
  for (const auto& [code, word] : {std::pair(ExitCode::yes, "good"),
                                   {ExitCode::no, "do not hold"},
                                   {ExitCode::bad_input, "wrong"},
                                   {ExitCode::undecided, "not known"}}) {
    const auto found = counts.find(code);
    if (found == counts.end()) continue;
    text += fmt::format("{}{} {}", mark, found->second, word);
    mark = ", ";
  }
  return text + "\n";
}

ExitCode check(const CheckOptions& options) {
  ExitCode exit = ExitCode::yes;
  io::Json results = io::Json::array();
  const std::vector<ProblemFile> files = problem_files(options.problems);
  const bool several = files.size() > 1;
  const Detail detail = options.json ? Detail::none : several ? Detail::line : Detail::all;
  std::map<ExitCode, int> counts;
  for (const ProblemFile& problem : files) {
    const std::string path = problem.path.string();
    try {
      io::Json found;
      const ExitCode code = check_file(path, options, detail, found);
      ++counts[code];
      exit = worse(exit, code);
      results.push_back(std::move(found));
    } catch (const InputError& error) {
      ++counts[ExitCode::bad_input];
      exit = ExitCode::bad_input;
      if (detail == Detail::line)
        fmt::print("{}", wrong_line(path, error));
      else
        say(fmt::format("gainsmith: {}\n", error.what()));
      results.push_back({{"valid", false},
                         {"file", error.place().file},
                         {"line", error.place().line},
                         {"column", error.place().column},
                         {"message", error.message()}});
    }
  }
  if (options.json) fmt::print("{}", io::to_text(results));
  if (detail == Detail::line) fmt::print("{}", total(counts, files.size()));
  return exit;
}

}  // namespace

Command check_command() {
  auto options = std::make_shared<CheckOptions>();
  return {
      "check",
      "Validate problem files; prove the inequalities at the gains of gain files",
      {Option("files", options->problems,
              "problem files (YAML), gain files (JSON), or folders of problems; - for a problem on "
              "standard input")
           .required(),
       set_option(options->set),
       Option("--strict", options->strict, "a note on a problem is an error: exit code 2"),
       Option("--json", options->json, "print the result as JSON")},
      "A problem is read, not solved. A gain file is taken as it is, edited or not.\n"
      "Of several files it prints a line each, of wrong ones too, and their number at the end.\n"
      "Exit code: 0 all valid and proved, 1 the inequalities do not hold at the gains of a file, 2 "
      "wrong\n"
      "input, 3 whether they hold is not known.\n"
      "Examples:\n"
      "  gainsmith check problems/ferrante-seuret-2021\n"
      "  gainsmith check --strict problem.yaml\n"
      "  gainsmith check gains.json",
      [options] { return check(*options); }};
}

}  // namespace gainsmith::app
