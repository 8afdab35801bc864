#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/file.h"
#include "base/number.h"
#include "gainsmith/commands.h"
#include "gainsmith/load.h"
#include "gainsmith/notes.h"
#include "gainsmith/output.h"
#include "gainsmith/run_table.h"
#include "gainsmith/terminal.h"
#include "hybrid/idle.h"
#include "io/json_text.h"

namespace gainsmith::app {

namespace {

struct SimulateOptions {
  std::string gains;
  std::vector<std::string> set;
  std::uint64_t run = 0;
  std::optional<std::uint64_t> seed;
  std::string output;
  std::string plot;
  double step = 0;
  bool compare = false;
  bool judge = false;
  bool json = false;
};

std::string step_error(const std::string& text) {
  const auto value = parse_decimal(text);
  if (value && *value > 0) return {};
  return "expected a positive time between two points, such as 0.01, not '" + text + "'";
}

/// `early`: the run ends before its horizon for a reason that decides nothing.
std::string claims_text(const std::vector<verify::ReplayedClaim>& claims, bool early) {
  std::string text;
  for (const verify::ReplayedClaim& claim : claims) {
    const claims::Finding& finding = claim.finding;
    if (!finding.looked) {
      text += fmt::format("  {:<12} {}\n", claim.name,
                      early ? "undecided: never checked, as the run ends before"
                            : "held: never checked, as the run does not reach the time or event "
                              "of the claim");
      continue;
    }
    const bool so_far = early && finding.judgement == claims::Judgement::held;
    const std::string tolerance =
        finding.tolerance > 0 ? ", tolerance " + brief(finding.tolerance) : "";
    text += fmt::format("  {:<12} {}{}: {} against {} at (t, j) = ({}, {}){}\n", claim.name,
                    to_string(finding.judgement), so_far ? " so far" : "", brief(finding.value),
                    brief(finding.bound), brief(finding.t), finding.j, tolerance);
  }
  return text;
}

/// The design's, and events that do not happen in a run that came to its end.
std::vector<std::string> notes_on_run(const model::Design& design, const hybrid::Trajectory& run) {
  std::vector<std::string> notes = notes_on_observers(hybrid::idle_observers(*design.dynamics));
  std::vector<char> happened(design.dynamics->events.size(), 0);
  for (const auto& part : run.parts)
    if (const auto* jump = std::get_if<hybrid::JumpPoint>(&part)) happened[jump->event] = 1;
  std::vector<std::string> silent;
  for (std::size_t e = 0; e < happened.size(); ++e)
    if (happened[e] == 0) silent.push_back(design.dynamics->events[e].name);
  if (!silent.empty() && is_complete(run.ending))
    notes.push_back(note_on_events(silent) + " in this run");
  return notes;
}

std::string judged_text(const std::vector<judge::Fault>& faults) {
  if (faults.empty()) return "  judged: the run satisfies the texts\n";
  std::string text;
  for (const judge::Fault& fault : faults)
    text += fmt::format("  judged: t = {}: {} ({} > {})\n", brief(fault.t), fault.what,
                        brief(fault.size), brief(fault.allowed));
  return text;
}

void write(const SimulateOptions& options, const std::string& text) {
  if (options.output.empty() || options.output == "-")
    fmt::print("{}", text);
  else
    write_atomically(options.output, text);
}

/// Steps of exact flows are long: a picture shows what lies between their ends.
verify::Replay for_plot(const SimulateOptions& options, const verify::Setup& setup,
                        std::uint64_t seed, const verify::Replay& replay) {
  constexpr double kPoints = 1500;
  if (options.step > 0 || replay.run.end <= 0 || replay.run.ending == hybrid::Ending::interrupted)
    return replay;
  return verify::replay_run(setup, seed, options.run, replay.run.end / kPoints);
}

ExitCode compare(const SimulateOptions& options, const LoadedGains& loaded, std::uint64_t seed) {
  if (options.json || options.judge || !options.plot.empty() || options.step > 0)
    throw InputError({options.gains},
                     "--compare prints figures alone, without --json, --plot, --judge or --step");
  const verify::Comparison comparison =
      verify::compared_figures(loaded.stated, loaded.gains, seed, options.run);
  if (comparison.figures.empty())
    throw InputError({options.gains},
                     "the problem names nothing to compare: compare: [{peak: norm(e)}, ...]");
  write(options, comparison_text(comparison.figures));
  if (!comparison.early.empty())
    say(fmt::format("run {} ended before its horizon, {}\n", options.run, comparison.early));
  return ExitCode::yes;
}

ExitCode simulate(const SimulateOptions& options) {
  if (!options.plot.empty() && !options.plot.ends_with(".svg"))
    throw InputError({"--plot"}, "a picture is written as SVG: expected a name that ends with "
                                 "'.svg', not '" + options.plot + "'");
  prepare_outputs(options.gains, {options.output, options.plot});
  const LoadedGains loaded = load_run(options.gains, options.set);
  const std::uint64_t seed = options.seed.value_or(loaded.stated.design->campaign.seed);
  if (options.compare) return compare(options, loaded, seed);
  const auto setup = verify::make_setup(loaded.stated, loaded.gains);
  const verify::Replay replay =
      verify::replay_run(*setup, seed, options.run, options.step, options.judge);
  const bool stopped = replay.run.ending == hybrid::Ending::interrupted;
  const Telling telling;
  if (!options.plot.empty())
    write_atomically(options.plot, run_figure(loaded.stated.design->name,
                                              for_plot(options, *setup, seed, replay)));
  const bool table = options.plot.empty() || !options.output.empty() || options.json;
  const bool table_on_stdout = table && (options.output.empty() || options.output == "-");
  if (table)
    write(options, options.json ? io::to_text(events_json(replay)) : events_csv(replay));
  const auto jumps = static_cast<std::size_t>(std::count_if(
      replay.run.parts.begin(), replay.run.parts.end(),
      [](const auto& part) { return std::holds_alternative<hybrid::JumpPoint>(part); }));
  std::string text = fmt::format("run {} of seed {}: {} points, {} jumps, ended at t = {}: {}\n",
                                 options.run, seed, replay.table.rows(), jumps,
                                 brief(replay.run.end), to_string(replay.run.ending));
  if (!replay.run.message.empty()) text += "  " + replay.run.message + "\n";
  for (const std::string& note : replay.run.notes) text += "  " + note + "\n";
  for (const std::string& note : notes_on_run(*loaded.stated.design, replay.run))
    text += "  note: " + note + "\n";
  text += claims_text(replay.claims, !is_complete(replay.run.ending));
  if (options.judge && !stopped) text += judged_text(replay.faults);
  print_report(text, table_on_stdout);
  if (stopped) return ExitCode::undecided;
  return replay.faults.empty() ? ExitCode::yes : ExitCode::no;
}

}  // namespace

Command simulate_command() {
  auto options = std::make_shared<SimulateOptions>();
  return {
      "simulate",
      "Replay one run of a campaign as CSV",
      {Option("gains", options->gains, "gain file (JSON), or a problem (YAML) without unknowns")
           .required(),
       set_option(options->set),
       Option("--run", options->run, "the run's number"),
       Option("--seed", options->seed, "seed of the campaign (default: the problem's)"),
       Option("-o,--output", options->output, "write the table here (default: standard output)"),
       Option("--step", options->step, "points of flows this far apart (default: as integrated)")
           .checked(step_error),
       Option("--plot", options->plot, "draw states, estimates, errors and claims (SVG)"),
       Option("--compare", options->compare, "print the figures under 'compare' of all observers"),
       Option("--judge", options->judge,
              "check the run against the texts, by computations of its own; exit code 1 if it "
              "finds a fault"),
       Option("--json", options->json, "write JSON instead of CSV")},
      "Columns: t, j, the event, the states, the signals, then the value of each "
      "claim.\n"
      "Examples:\n"
      "  gainsmith simulate gains.json --run 17 -o run-17.csv\n"
      "  gainsmith simulate problem.yaml --plot run.svg --step 0.01",
      [options] { return simulate(*options); }};
}

}  // namespace gainsmith::app
