#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "gainsmith/campaign_text.h"
#include "gainsmith/commands.h"
#include "gainsmith/load.h"
#include "gainsmith/terminal.h"
#include "io/campaign_json.h"
#include "model/stated_file.h"
#include "verify/statistics.h"

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
  bool json = false;
};

/// As many as are given, or as show the probability that is given.
std::optional<std::uint64_t> runs_of(const VerifyOptions& options) {
  if (!options.probability) return options.runs;
  if (options.runs)
    throw InputError(Place{}, "either --runs or --probability: the latter says how many runs");
  return verify::runs_for(*options.probability, options.confidence);
}

ExitCode verify_gains(const VerifyOptions& options) {
  const LoadedGains loaded = load_run(options.gains, options.set);
  const verify::CampaignOptions campaign{runs_of(options), options.seed, options.threads,
                                         options.confidence};
  const auto setup = verify::make_setup(loaded.stated, loaded.gains);
  const verify::Report report = verify::run_campaign(*setup, campaign);
  // A gain file holds what was set.
  const std::string source =
      options.set.empty()
          ? options.gains
          : model::problem_words(options.gains, loaded.stated.design->statement.settings);
  const Telling telling;
  fmt::print("{}",
             options.json
                 ? io::to_text(io::to_json(campaign_record(report, io::gains_hash(loaded.gains))))
                 : campaign_summary(report, source));
  return campaign_exit(report.verdict);
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
       Option("--threads", options->threads,
              "threads, 0: one a core; the report does not depend on it")
           .within(0, 1024),
       Option("--json", options->json, "print the report as JSON")},
      "Exit code: 0 held, 1 violated, 2 wrong input, 3 undecided or interrupted.\n"
      "Examples:\n"
      "  gainsmith verify gains.json --runs 10000\n"
      "  gainsmith verify gains.json --probability 1e-4 --confidence 0.999\n"
      "  gainsmith verify gains.json --json | jq .worst_run",
      [options] { return verify_gains(*options); }};
}

}  // namespace gainsmith::app
