#include <fmt/format.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/save_pace.h"
#include "gainsmith/campaign_json.h"
#include "gainsmith/campaign_parts.h"
#include "gainsmith/campaign_text.h"
#include "gainsmith/commands.h"
#include "gainsmith/kept_folder.h"
#include "gainsmith/load.h"
#include "gainsmith/notes.h"
#include "gainsmith/output.h"
#include "gainsmith/part_file.h"
#include "gainsmith/shard_option.h"
#include "gainsmith/terminal.h"
#include "gainsmith/worst_text.h"
#include "io/json/campaign_json.h"
#include "model/stated_file.h"
#include "statistics/figure_survey.h"
#include "statistics/sample_bounds.h"
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
  std::string until;
  bool worst = false;
  bool strict = false;
  std::string shard;
  std::string resume;
  std::string output;
  bool json = false;
};

/// As many as are given, or as show the probability that is given.
std::optional<std::uint64_t> runs_of(const VerifyOptions& options) {
  if (!options.probability) return options.runs;
  if (options.runs)
    throw InputError(Place{}, "either --runs or --probability: the latter says how many runs");
  return statistics::runs_for(*options.probability, options.confidence);
}

/// How the gains are called on a command line. A gain file holds what was set.
std::string source_of(const VerifyOptions& options, const LoadedGains& loaded) {
  return options.set.empty()
             ? model::quoted(options.gains)
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

void require_figures(const VerifyOptions& options, const model::Design& design) {
  if (options.compare && design.compare.empty())
    throw InputError({options.gains},
                     "the problem names nothing to compare: compare: [{peak: norm(e)}, ...]");
}

/// A part of a campaign that is made.
struct PartWork {
  const verify::Campaign& campaign;
  statistics::RunRange range;
  PartFile& file;
  /// Adds figures over these runs, where they are asked for.
  std::function<void(const statistics::RunRange&, const verify::Save&)> survey;
  bool compare = false;

  bool is_whole() const {
    const verify::CampaignPart& part = file.part;
    return (part.runs.count() == range.count() || part.ended()) &&
           (!compare || part.figures.runs.count() == range.count());
  }
  std::string progress() const {
    const auto runs = file.part.runs.count();
    const std::string text = fmt::format("{} of {} runs", runs, range.count());
    return compare && runs == range.count()
               ? text + fmt::format(" and the figures of {}", file.part.figures.runs.count())
               : text;
  }
  void make(const verify::Save& save) const {
    campaign.make_runs(range, file.part, save);
    if (file.part.runs.count() < range.count()) return;
    SavePace pace;
    survey(range, [&] {
      if (save && pace.is_due()) pace.save(save);
    });
    if (save) save();
  }
};

/// Makes the runs; with --resume those that its folder has not yet.
void make_runs(const VerifyOptions& options, const PartWork& work) {
  if (options.resume.empty()) return work.make({});
  PartFile& file = work.file;
  io::Json statement = file.statement;
  statement["shard"] = to_text(file.shard);
  KeptFolder folder(options.resume, std::move(statement));
  if (folder.kept()) take_kept(folder.kept()->done, folder.kept()->file, file.part);
  const auto keep = [&] { folder.keep(runs_json(file.part)); };
  keep();  // whether the folder can be written to is known before the work
  work.make(keep);
  if (!work.is_whole())
    say(fmt::format("gainsmith: {} keeps {}; the same command goes on from there\n", options.resume,
                    work.progress()));
}

/// 0 for a part that is whole, whatever its runs are; otherwise nothing is written.
ExitCode tell_campaign_part(const VerifyOptions& options, const PartWork& work) {
  if (!work.is_whole()) {
    say_unwritten(work.file.shard, work.progress());
    return ExitCode::undecided;
  }
  work.campaign.repeat_worst(work.file.part);
  write_part(document_of(work.file), options.output,
             fmt::format("{} of {} runs", work.range.count(), work.campaign.asked()));
  return ExitCode::yes;
}

ExitCode verify_gains(const VerifyOptions& options) {
  require_part_name(options.shard, options.output);
  prepare_outputs(options.gains, {options.output});
  const LoadedGains loaded = load_run(options.gains, options.set);
  if (options.worst) return search_worst(options, loaded);
  const model::Design& design = *loaded.stated.design;
  require_figures(options, design);
  const auto setup = verify::make_setup(loaded.stated, loaded.gains);
  PartFile file;
  const auto survey = [&](const statistics::RunRange& runs, const verify::Save& grown) {
    if (options.compare)
      statistics::grow(*setup->events, design.compare, file.part.facts.seed, runs, options.threads,
                       file.part.figures, grown);
  };
  statistics::RunRange range;
  verify::CampaignOptions asked{runs_of(options), options.seed, options.threads, options.confidence,
                                !options.until.empty()};
  if (options.compare)
    asked.between = [&](std::uint64_t runs) { survey({range.first, range.first + runs}, {}); };
  const verify::Campaign campaign(*setup, asked);
  file.part = campaign.begin();
  if (options.strict) refuse_notes(options.gains, file.part.facts.doubts);
  file.statement =
      campaign_statement(file.part.facts, io::gains_hash(loaded.gains), options.compare);
  file.source = source_of(options, loaded);
  file.shard = parse_shard(options.shard);
  range = statistics::shard_of(campaign.asked(), file.shard.index, file.shard.of);
  const PartWork work{campaign, range, file, survey, options.compare};
  make_runs(options, work);
  if (!options.shard.empty()) return tell_campaign_part(options, work);
  try {
    campaign.repeat_worst(file.part);
  } catch (const Stopped&) {
    // Then no violation is confirmed.
  }
  const ExitCode exit = tell_campaign(file, options.output, options.json);
  if (options.strict) refuse_notes(options.gains, strict_notes(verify::conclude(file.part)));
  if (options.resume.empty() && !work.is_whole())
    say("gainsmith: with --resume FOLDER what is done would be kept\n");
  return exit;
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
              "losses, noise and uncertain data; --runs: of the search (default: 3000 of a linear "
              "sampled plant, otherwise 600)"),
       Option("--threads", options->threads,
              "threads, 0: as many as cores it may use; the report does not depend on it")
           .within(0, 1024),
       Option(
           "--compare", options->compare,
           "also print quantiles of the figures under 'compare' over all runs, each simulated on "
           "its own, which takes longer"),
       Option(
           "--until", options->until,
           "violated: end with the first run that violates a claim; the bound on the probability "
           "takes it into account")
           .one_of({"violated"})
           .excludes({"--compare", "--worst"}),
       Option("--strict", options->strict,
              "a note on noise, uncertain data or an observer that is perhaps not meant so is an "
              "error: exit code 2"),
       shard_option(options->shard,
                    "make only part I of N of the runs, and write it with -o for 'merge'")
           .excludes({"--worst", "--until"}),
       Option("--resume", options->resume,
              "keep in this folder what is done: after a stop of any kind the same command goes on "
              "from it")
           .excludes({"--worst"}),
       Option("-o,--output", options->output,
              "write the report as JSON here, or the part; - for standard output")
           .excludes({"--worst"}),
       Option("--json", options->json, "print the report as JSON").excludes({"--shard"})},
      "Exit code: 0 held, 1 violated, 2 wrong input, 3 undecided or interrupted. With --shard: 0 "
      "the "
      "part\n"
      "is whole, 3 interrupted.\n"
      "Examples:\n"
      "  gainsmith verify gains.json --runs 10000\n"
      "  gainsmith verify gains.json --probability 1e-4 --confidence 0.999\n"
      "  gainsmith verify gains.json --worst\n"
      "  gainsmith verify gains.json --runs 1e9 --resume kept\n"
      "  gainsmith verify gains.json --runs 1e9 --shard 3/8 -o part3.json\n"
      "  gainsmith verify gains.json --json | jq .worst_run",
      [options] { return verify_gains(*options); }};
}

}  // namespace gainsmith::app
