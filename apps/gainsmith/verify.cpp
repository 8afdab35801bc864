#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "gainsmith/campaign_text.h"
#include "gainsmith/commands.h"
#include "gainsmith/figures_text.h"
#include "gainsmith/load.h"
#include "gainsmith/terminal.h"
#include "gainsmith/worst_text.h"
#include "io/campaign_json.h"
#include "model/stated_file.h"
#include "verify/figure_survey.h"
#include "verify/statistics.h"
#include "verify/worst.h"

namespace gainsmith::app {

namespace {

struct VerifyOptions {
  std::string gains;
  std::vector<std::string> set;
  std::optional<std::uint64_t> runs;
  std::optional<std::uint64_t> seed;
  unsigned threads = 0;
  std::optional<double> probability;
  double confidence = 0.95;
  bool compare = false;
  bool worst = false;
  bool json = false;
};

/// As many as are given, or as show the probability that is given.
std::optional<std::uint64_t> runs_of(const VerifyOptions& options) {
  if (!options.probability) return options.runs;
  if (options.runs)
    throw InputError(Place{}, "either --runs or --probability: the latter says how many runs");
  return verify::runs_for(*options.probability, options.confidence);
}

/// How the gains are called on a command line. A gain file holds what was set.
std::string source_of(const VerifyOptions& options, const LoadedGains& loaded) {
  return options.set.empty()
             ? options.gains
             : model::problem_words(options.gains, loaded.stated.design->statement.settings);
}

ExitCode search_worst(const VerifyOptions& options, const LoadedGains& loaded) {
  if (options.compare)
    throw InputError({options.gains}, "--compare is about runs at random, not about --worst");
  if (options.probability)
    throw InputError({options.gains}, "--probability is about runs at random, not about --worst");
  verify::WorstOptions search;
  search.seed = options.seed.value_or(search.seed);
  search.runs = options.runs;
  search.threads = options.threads;
  const verify::WorstReport report = verify::search_worst(loaded.stated, loaded.gains, search);
  const model::Design& design = *loaded.stated.design;
  const Telling telling;
  fmt::print("{}", options.json ? io::to_text(worst_json(report, design))
                                : worst_summary(report, design, source_of(options, loaded)));
  return campaign_exit(report.verdict);
}

/// Where nothing is drawn no run says anything of another.
model::FiguresRecord record_of(const verify::FigureSurvey& survey, const verify::Report& report) {
  std::optional<double> confidence;
  if (!report.different) confidence = report.confidence;
  return figures_record(survey, report.asked, report.seed, confidence, confidence);
}

ExitCode verify_gains(const VerifyOptions& options) {
  const LoadedGains loaded = load_run(options.gains, options.set);
  if (options.worst) return search_worst(options, loaded);
  if (options.compare && loaded.stated.design->compare.empty())
    throw InputError({options.gains},
                     "the problem names nothing to compare: compare: [{peak: norm(e)}, ...]");
  const auto setup = verify::make_setup(loaded.stated, loaded.gains);
  verify::CampaignOptions campaign{runs_of(options), options.seed, options.threads,
                                   options.confidence};
  const model::Design& design = *loaded.stated.design;
  verify::GrowingSurvey figures(*setup->events, design.compare,
                                options.seed.value_or(design.campaign.seed), options.threads);
  if (options.compare) campaign.between = [&](std::uint64_t runs) { figures.grow(runs); };
  const verify::Report report = verify::run_campaign(*setup, campaign);
  if (options.compare && !report.interrupted()) figures.grow(report.runs);
  const Telling telling;
  if (options.json) {
    model::CampaignRecord record = campaign_record(report, io::gains_hash(loaded.gains));
    if (options.compare) record.figures = record_of(figures.survey(), report);
    fmt::print("{}", io::to_text(io::to_json(record)));
  } else {
    fmt::print("{}{}", campaign_summary(report, source_of(options, loaded)),
               options.compare ? figures_text(record_of(figures.survey(), report)) : "");
  }
  const ExitCode exit = campaign_exit(report.verdict);
  const bool whole = !options.compare || figures.survey().runs == report.asked;
  return exit == ExitCode::yes && !whole ? ExitCode::undecided : exit;
}

}  // namespace

Command verify_command() {
  auto options = std::make_shared<VerifyOptions>();
  return {
      "verify",
      "Check a gain file's claims by Monte-Carlo simulation",
      {Option("gains", options->gains, "gain file (JSON), or a problem (YAML) without unknowns")
           .required(),
       set_option(options->set),
       Option("--runs", options->runs, "number of runs (default: the problem's)")
           .within<std::uint64_t>(1, 1000000000000000),
       Option("--probability", options->probability,
              "instead of --runs: as many runs as show, when none violates, that at most this part "
              "of such runs does")
           .within(1e-12, 0.999999),
       Option("--confidence", options->confidence, "with which the report bounds that part")
           .within(0.5, 0.999999999),
       Option("--seed", options->seed, "seed of the random streams (default: the problem's)"),
       Option("--worst", options->worst,
              "search the worst run of each claim instead of drawing runs: over starts, lengths, "
              "losses, noise and uncertain data; --runs: of the search (default: 3000, or 600 "
              "where flows are integrated)"),
       Option("--threads", options->threads,
              "threads, 0: one a core; the report does not depend on it")
           .within(0, 1024),
       Option(
           "--compare", options->compare,
           "also print quantiles of the figures under 'compare' over all runs, each simulated on "
           "its own, which takes longer"),
       Option("--json", options->json, "print the report as JSON")},
      "Exit code: 0 held, 1 violated, 2 wrong input, 3 undecided or interrupted.\n"
      "Examples:\n"
      "  gainsmith verify gains.json --runs 10000\n"
      "  gainsmith verify gains.json --probability 1e-4 --confidence 0.999\n"
      "  gainsmith verify gains.json --worst\n"
      "  gainsmith verify gains.json --json | jq .worst_run",
      [options] { return verify_gains(*options); }};
}

}  // namespace gainsmith::app
