#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bind/stated.h"
#include "gainsmith/commands.h"
#include "gainsmith/load.h"
#include "gainsmith/problem_files.h"
#include "gainsmith/terminal.h"
#include "io/json_text.h"
#include "lmi/compile.h"
#include "verify/careful_runs.h"

namespace gainsmith::app {

namespace {

struct CheckOptions {
  std::vector<std::string> problems;
  bool json = false;
};

/// What of a campaign the problem leaves to the defaults.
std::vector<std::string> campaign_defaults(const model::Design& design) {
  std::vector<std::string> words;
  if (!design.dynamics || design.claims.empty() || !design.no_campaign.empty()) return words;
  if (!model::has_end(design) && model::ends(design))
    words.emplace_back("campaign.horizon: 40 of the timer's longest intervals");
  for (std::size_t i = 0; i < design.states.size(); ++i) {
    const auto& starts = design.campaign.starts;
    const bool given = std::any_of(starts.begin(), starts.end(),
                                   [&](const auto& start) { return start.state == i; });
    if (!given && !design.states[i].start)
      words.push_back("campaign.initial." + design.states[i].name +
                      ": the box [-1, 1], in the units of the file");
  }
  return words;
}

/// Finds what a run would refuse, where it needs no gains: a horizon beyond the data, a time from
/// which on nothing is claimed.
void check_runs(const model::Instance& instance) {
  const model::Design& design = *instance.design;
  const bool runs = design.dynamics && design.no_campaign.empty() && model::ends(design);
  const bool needs_nothing = design.unknowns.empty() && design.inequalities.empty() &&
                             design.open.empty() && design.gains.empty();
  if (runs && needs_nothing) verify::make_event_setup(bind::run_texts(instance, {}));
}

/// What a valid problem asks for.
io::Json description(const model::Instance& instance) {
  const lmi::Lmi lmi = lmi::compile(lmi::Inequalities(instance));
  io::Json sizes = io::Json::object();
  for (const auto& [name, size] : instance.design->dimensions) sizes[name] = size;
  io::Json result = {{"valid", true},
                     {"problem", instance.design->name},
                     {"method", instance.design->method},
                     {"dimensions", sizes},
                     {"unknown_scalars", lmi.unknowns},
                     {"blocks", lmi.blocks.size()},
                     {"campaign_defaults", campaign_defaults(*instance.design)}};
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

void print(const std::string& path, const io::Json& found) {
  const int unknowns = found["unknown_scalars"].get<int>();
  const int blocks = found["blocks"].get<int>();
  fmt::print("{}: valid: method {}, {}\n", path, found["method"].get<std::string>(),
             unknowns + blocks == 0
                 ? "a design by formula"
                 : fmt::format("{} unknown scalars, {} inequality blocks", unknowns, blocks));
  if (found.contains("events"))
    fmt::print("  observers   {}\n  events      {}\n", listed(found["observers"]),
               listed(found["events"]));
  for (const auto& word : found["campaign_defaults"])
    fmt::print("  by default  {}\n", word.get<std::string>());
}

ExitCode check(const CheckOptions& options) {
  ExitCode exit = ExitCode::yes;
  io::Json results = io::Json::array();
  for (const ProblemFile& problem : problem_files(options.problems)) {
    const std::string path = problem.path.string();
    try {
      const model::Instance instance = load_problem(path);
      check_runs(instance);
      io::Json found = description(instance);
      if (!options.json) print(path, found);
      found["file"] = path;
      results.push_back(std::move(found));
    } catch (const InputError& error) {
      exit = ExitCode::bad_input;
      say(fmt::format("gainsmith: {}\n", error.what()));
      results.push_back({{"valid", false},
                         {"file", error.place().file},
                         {"line", error.place().line},
                         {"column", error.place().column},
                         {"message", error.message()}});
    }
  }
  if (options.json) fmt::print("{}", io::to_text(results));
  return exit;
}

}  // namespace

Command check_command() {
  auto options = std::make_shared<CheckOptions>();
  return {"check",
          "Validate problem files without solving",
          {Option("problems", options->problems,
                  "problem files (YAML), or folders of them; - for standard input")
               .required(),
           Option("--json", options->json, "print the result as JSON")},
          "Exit code: 0 all valid, 2 otherwise.\n"
          "Example:\n"
          "  gainsmith check problems/ferrante-seuret-2021",
          [options] { return check(*options); }};
}

}  // namespace gainsmith::app
