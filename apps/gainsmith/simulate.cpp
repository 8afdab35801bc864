#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/file.h"
#include "base/number.h"
#include "base/progress.h"
#include "bind/stated.h"
#include "gainsmith/campaign_text.h"
#include "gainsmith/commands.h"
#include "gainsmith/envelope_figure.h"
#include "gainsmith/figures_picture.h"
#include "gainsmith/figures_text.h"
#include "gainsmith/load.h"
#include "gainsmith/output.h"
#include "gainsmith/picture_file.h"
#include "gainsmith/picture_options.h"
#include "gainsmith/presentation.h"
#include "gainsmith/run_figure.h"
#include "gainsmith/run_table.h"
#include "gainsmith/run_text.h"
#include "gainsmith/several_designs.h"
#include "gainsmith/terminal.h"
#include "hybrid/idle.h"
#include "io/json/figures_json.h"
#include "io/json/given_run_json.h"
#include "io/json/json_text.h"
#include "statistics/figure_survey.h"

namespace gainsmith::app {

namespace {

struct SimulateOptions {
  std::vector<std::string> files;  ///< the same run of each
  std::vector<std::string> set;
  std::uint64_t run = 0;
  std::string given;
  std::optional<std::uint64_t> seed;
  std::string output;
  PictureOptions picture;
  Presentation presentation;
  double step = 0;
  bool compare = false;
  bool envelope = false;
  bool judge = false;
  bool json = false;
};

std::string step_error(const std::string& text) {
  const auto value = parse_decimal(text);
  if (value && *value > 0) return {};
  return "expected a positive time between two points, such as 0.01, not '" + text + "'";
}

std::string judged_text(const std::vector<judge::Fault>& faults) {
  if (faults.empty()) return "  judged: the run satisfies the texts\n";
  std::string text;
  for (const judge::Fault& fault : faults) {
    text += fmt::format("  judged: t = {}: {}", brief(fault.t), fault.what);
    if (fault.size != 0 || fault.allowed != 0)
      text += fmt::format(" ({} > {})", brief(fault.size), brief(fault.allowed));
    text += '\n';
  }
  return text;
}

void write(const SimulateOptions& options, const std::string& text) {
  if (options.output.empty() || options.output == "-")
    fmt::print("{}", text);
  else
    write_atomically(options.output, text);
}

void show(const SimulateOptions& options, drawing::Figure figure) {
  present(options.presentation, {&figure});
  write_picture(options.picture.file, drawing::svg(figure));
}

/// Points of the picture lie closer than those of a table.
void draw(const SimulateOptions& options, const model::Design& design, const verify::Setup& setup,
          const std::vector<std::uint64_t>& runs, const std::vector<verify::Replay>& replays) {
  std::vector<DrawnRun> drawn;
  for (std::size_t k = 0; k < replays.size(); ++k)
    drawn.push_back(drawn_run(setup, runs[k], replays[k].run, options.step));
  show(options, run_figure(design.name, *setup.events, drawn, view_of(options.picture, design)));
}

/// What has no effect, or none together.
void check(const SimulateOptions& options) {
  check_picture_name(options.picture.file);
  const auto refuse = [&](const char* message) {
    throw InputError({options.files.front()}, message);
  };
  const PictureOptions& picture = options.picture;
  const bool several = !picture.runs.empty();
  if (options.compare && (options.judge || picture.only_drawn() || options.step > 0))
    refuse(
        "--compare is about figures alone, without --judge, --step and what --plot draws of runs");
  if (options.envelope && (!several || picture.file.empty()))
    refuse("--envelope draws quantiles of several runs: give --runs and --plot FILE");
  if (options.envelope && (options.compare || !picture.planes.empty() || !picture.bands.empty()))
    refuse("--envelope draws quantiles over time, without --compare, --phase and --band");
  if (!options.compare && picture.file.empty() && picture.only_drawn())
    refuse("--phase, --panels and --band say what --plot draws: give --plot FILE");
  if (!options.compare && picture.file.empty() && several)
    refuse("--runs names several runs for --plot FILE or --compare: give one of them, or --run");
  if (picture.file.empty() && !options.presentation.empty())
    refuse(
        "--title, --size, --window, --name and --jump-width are about a picture: give --plot FILE");
  if (!options.presentation.jump_width.empty() && (options.envelope || options.compare))
    refuse("--jump-width is about runs, without --envelope and --compare");
  const bool designs = options.files.size() > 1;
  if (designs && (options.envelope || !options.given.empty() || options.judge ||
                  (several && !options.compare)))
    refuse(
        "several designs are drawn in one run each, without --runs, --envelope, --given and "
        "--judge; --compare takes --runs");
  if (designs && !options.compare && picture.file.empty())
    refuse("several designs are drawn over each other: give --plot FILE, or --compare");
  if (designs && (!options.output.empty() || options.json))
    refuse("-o and --json are about one design");
  if (!options.given.empty() && (several || options.compare))
    refuse("--given is about one run: without --runs and --compare");
  if (several && options.run != 0) refuse("either --run or --runs, not both");
  if (several && !options.compare && (!options.output.empty() || options.json || options.judge))
    refuse("--runs draws several runs: without -o, --json and --judge, which are about one");
}

/// With which a consistent filter passes, of covariances among the figures.
constexpr double kFit = 0.95;

ExitCode compare(const SimulateOptions& options, const LoadedGains& loaded, std::uint64_t seed,
                 const std::vector<std::uint64_t>& runs) {
  const std::vector<model::Figure>& figures = loaded.stated.design->compare;
  if (figures.empty())
    throw InputError({options.files.front()},
                     "the problem names nothing to compare: compare: [{peak: norm(e)}, ...]");
  const auto setup = claims::make_run_setup(bind::run_texts(loaded.stated, loaded.gains));
  const statistics::FigureSurvey survey =
      statistics::survey_figures(*setup, figures, seed, {runs.size(), runs});
  const Telling telling;
  // These runs were chosen, so nothing is said of others.
  const bool drawn = !hybrid::different_runs(setup->system, setup->scenario);
  const model::FiguresRecord record = figures_record(survey, runs.size(), seed, std::nullopt,
                                                     drawn ? std::optional(kFit) : std::nullopt);
  if (survey.runs > 0)
    write(options, options.json ? io::to_text(io::to_json(record)) : comparison_text(record));
  if (survey.runs > 0 && !options.picture.file.empty())
    show(options, histograms(loaded.stated.design->name, survey));
  if (const statistics::SomeRuns& early = survey.early; early.count > 0) {
    say(fmt::format("run {} ended before its horizon, {}\n", early.first, early.why));
    if (early.count > 1) say(fmt::format("so did {} of these runs in all\n", early.count));
  }
  return survey.runs < runs.size() ? ExitCode::undecided : ExitCode::yes;
}

ExitCode draw_envelope(const SimulateOptions& options, const model::Design& design,
                       const verify::Setup& setup, std::uint64_t seed,
                       const std::vector<std::uint64_t>& runs) {
  EnvelopeFigure figure(setup.horizon(), view_of(options.picture, design));
  const double step = options.step > 0 ? options.step : figure.step();
  std::uint64_t made = 0, early = 0;
  {
    const Doing doing("runs", runs.size());
    for (const std::uint64_t run : runs) {
      const verify::Replay replay = verify::table_of_run(setup, seed, run, step, true);
      if (replay.run.ending == hybrid::Ending::interrupted) break;
      figure.add(replay);
      early += is_complete(replay.run.ending) ? 0 : 1;
      ++made;
      doing.step();
    }
  }
  const Telling telling;
  std::string text = fmt::format("quantiles of {} runs of seed {}\n", made, seed);
  if (early > 0) text += fmt::format("{} of them ended before the horizon\n", early);
  if (made > 0) show(options, figure.figure(fmt::format("{}, {} runs", design.name, made)));
  print_report(text, false);
  return made < runs.size() ? ExitCode::undecided : ExitCode::yes;
}

bool is_stopped(const verify::Replay& replay) {
  return replay.run.ending == hybrid::Ending::interrupted;
}

/// The same run of several designs in one picture, or their figures below each other.
ExitCode simulate_several(const SimulateOptions& options) {
  const std::vector<std::string> names = names_of_files(options.files);
  std::vector<LoadedGains> designs;
  for (const std::string& file : options.files) designs.push_back(load_run(file, options.set));
  require_same_plant(designs, options.files);
  const std::uint64_t seed = options.seed.value_or(designs.front().stated.design->campaign.seed);
  const std::vector<std::uint64_t> runs = runs_of(options.picture, options.compare, options.run);
  ExitCode exit = ExitCode::yes;
  if (options.compare) {
    for (std::size_t k = 0; k < designs.size(); ++k) {
      fmt::print("{}\n", names[k]);
      exit = std::max(exit, compare(options, designs[k], seed, runs));
    }
    return exit;
  }
  std::vector<std::unique_ptr<const verify::Setup>> setups;
  std::vector<DesignRun> drawn;
  std::string text;
  for (std::size_t k = 0; k < designs.size(); ++k) {
    const model::Design& design = *designs[k].stated.design;
    setups.push_back(verify::make_setup(designs[k].stated, designs[k].gains));
    const verify::Setup& setup = *setups.back();
    verify::Replay replay = verify::replay_run(setup, seed, options.run, options.step, false);
    if (is_stopped(replay)) return ExitCode::undecided;
    text += names[k] + ": " + run_text(seed, options.run, replay);
    drawn.push_back({names[k], &design, setup.events.get(),
                     drawn_run(setup, options.run, std::move(replay.run), options.step)});
  }
  const Telling telling;
  show(options, figure_of_designs(drawn, [&](const model::Design& design) {
         return view_of(options.picture, design);
       }));
  print_report(text, false);
  return exit;
}

ExitCode simulate(const SimulateOptions& options) {
  check(options);
  for (const std::string& file : options.files)
    prepare_outputs(file, {options.output, options.picture.file});
  if (options.files.size() > 1) return simulate_several(options);
  const LoadedGains loaded = load_run(options.files.front(), options.set);
  const model::Design& design = *loaded.stated.design;
  const std::uint64_t seed = options.seed.value_or(design.campaign.seed);
  const std::vector<std::uint64_t> runs =
      runs_of(options.picture, options.compare || options.envelope, options.run);
  if (options.compare) return compare(options, loaded, seed, runs);
  std::vector<hybrid::GivenRun> given;
  if (!options.given.empty())
    given.push_back(io::parse_given_run(options.given, "--given", *design.dynamics));
  const auto setup =
      verify::make_setup(loaded.stated, loaded.gains, given.empty() ? nullptr : &given);
  if (options.envelope) return draw_envelope(options, design, *setup, seed, runs);
  std::vector<verify::Replay> replays;
  for (const std::uint64_t run : runs) {
    replays.push_back(verify::replay_run(*setup, seed, run, options.step, options.judge));
    if (is_stopped(replays.back())) break;
  }
  const verify::Replay& first = replays.front();
  const bool stopped = is_stopped(replays.back());
  const Telling telling;
  if (!options.picture.file.empty()) draw(options, design, *setup, runs, replays);
  const bool table = options.picture.file.empty() || !options.output.empty() || options.json;
  const bool table_on_stdout = table && (options.output.empty() || options.output == "-");
  if (table)
    write(options,
          options.json ? io::to_text(events_json(first, view_of(design))) : events_csv(first));
  std::string text;
  for (std::size_t k = 0; k < replays.size(); ++k) text += run_text(seed, runs[k], replays[k]);
  text += notes_text(loaded.stated, runs, replays);
  if (options.judge && !stopped) text += judged_text(first.faults);
  print_report(text, table_on_stdout);
  if (stopped) return ExitCode::undecided;
  return first.faults.empty() ? ExitCode::yes : ExitCode::no;
}

}  // namespace

Command simulate_command() {
  auto options = std::make_shared<SimulateOptions>();
  Command command{
      "simulate",
      "Replay one run of a campaign as CSV",
      {Option("gains", options->files,
              "gain file (JSON), or a problem (YAML) without unknowns; with --plot or --compare "
              "several designs of one plant")
           .required(),
       set_option(options->set), Option("--run", options->run, "the run's number"),
       Option(
           "--given", options->given,
           "starts, lengths, losses and noise in place of draws, as 'verify --worst' prints them")
           .named("JSON"),
       Option("--seed", options->seed, "seed of the campaign (default: the problem's)"),
       Option("-o,--output", options->output, "write the table here (default: standard output)"),
       Option("--step", options->step, "points of flows this far apart (default: as integrated)")
           .checked(step_error),
       Option("--plot", options->picture.file,
              "draw states, estimates, inputs, errors and claims here (.svg, .pdf, .png)"),
       Option("--panels", options->picture.panels,
              "with --plot: these alone, such as x1,e,claims: names of quantities and claims, "
              "states, inputs, errors, claims"),
       Option("--phase", options->picture.planes,
              "with --plot: x1,x2: a plane of two quantities; may be repeated"),
       Option("--band", options->picture.bands,
              "with --plot: xh:P: +-2 sigma around an estimate, from its covariance (default: "
              "'covariance' of the problem); may be repeated"),
       Option("--runs", options->picture.runs,
              "several runs, 0,3,17 or 0:9; with --plot: at most 100, over each other; with "
              "--compare: the least, median and largest value of each figure"),
       Option("--envelope", options->envelope,
              "with --plot and --runs: over time the median, the band from 5 to 95 % of the runs, "
              "the least and the largest value, in place of each run"),
       Option("--compare", options->compare,
              "print the figures under 'compare' of all observers, of one run or of --runs; with "
              "--plot: histograms"),
       Option("--judge", options->judge,
              "check the run against the texts, by computations of its own; exit code 1 if it "
              "finds a fault"),
       Option("--json", options->json, "write JSON instead of CSV")},
      "Columns: t, j, the event, the states, the signals, then the value of each "
      "claim.\n"
      "Examples:\n"
      "  gainsmith simulate gains.json --run 17 -o run-17.csv\n"
      "  gainsmith simulate problem.yaml --plot run.svg --step 0.01\n"
      "  gainsmith simulate gains.json --plot plane.pdf --phase x1,x2 --runs 0:9\n"
      "  gainsmith simulate gains.json --compare --runs 0:99\n"
      "  gainsmith simulate gains.json --plot spread.svg --runs 0:199 --envelope\n"
      "  gainsmith simulate slow.json fast.json --plot both.svg --window 0:2",
      [options] { return simulate(*options); }};
  for (const Option& option : presentation_options(options->presentation, true))
    command.options.push_back(option);
  return command;
}

}  // namespace gainsmith::app
