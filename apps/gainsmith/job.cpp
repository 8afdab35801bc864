#include "gainsmith/job.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <exception>
#include <memory>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "base/file.h"
#include "base/stop.h"
#include "bind/instance.h"
#include "bind/stated.h"
#include "design/expectations.h"
#include "design/explain.h"
#include "design/hautus.h"
#include "design/optimize.h"
#include "gainsmith/campaign_text.h"
#include "gainsmith/explain_text.h"
#include "gainsmith/kept_job.h"
#include "gainsmith/load.h"
#include "gainsmith/notes.h"
#include "gainsmith/run_table.h"
#include "gainsmith/search_wanted.h"
#include "gainsmith/summary.h"
#include "io/json/campaign_json.h"
#include "io/json/gains_json.h"
#include "io/json/result_json.h"
#include "model/stated_file.h"
#include "verify/campaign.h"
#include "verify/expected_run.h"
#include "verify/replay.h"

namespace gainsmith::app {

namespace {

namespace fs = std::filesystem;

/// Thrown out of work that Ctrl-C ended; what() says what was done.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The exit code of a result: what `expect:` names is compared, the rest must be as usual.
ExitCode judge(const model::Design& design, const model::Gains& gains,
               const std::optional<verify::Report>& campaign,
               const std::vector<std::string>& differences) {
  const auto& expect = design.expect;
  if (!differences.empty()) return ExitCode::no;
  if (!(expect && expect->verdict)) {
    if (gains.verdict == model::Verdict::undecided) return ExitCode::undecided;
    if (gains.verdict == model::Verdict::no) return ExitCode::no;
  }
  const bool violated = campaign && campaign->verdict == model::CampaignVerdict::violated;
  if (violated && !(expect && expect->campaign)) return ExitCode::no;
  const bool open = campaign && campaign->verdict == model::CampaignVerdict::undecided;
  return open && !(expect && expect->campaign) ? ExitCode::undecided : ExitCode::yes;
}

void set_interrupted(const std::string& line, JobResult& result) {
  result.exit = ExitCode::undecided;
  result.line = line;
  result.interrupted = true;
  result.report = {
      {"folder", result.name}, {"exit", static_cast<int>(result.exit)}, {"interrupted", line}};
}

/// What a run writes into the folder of a problem.
constexpr std::array kWritten = {"gains.json",    "campaign.json", "summary.txt",
                                 "worst-run.csv", "worst-run.svg", "result.json"};

/// Removes what an earlier run left in the folder.
void clear(const fs::path& folder) {
  std::error_code ignored;
  for (const char* name : kWritten) fs::remove(folder / name, ignored);
}

/// The folder, without what an earlier run left in it.
void prepare(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError({folder.string()}, "cannot make this folder: " + error.message());
  clear(folder);
}

/// Why there are no gains, in one line: the hidden mode, or what conflicts.
std::string no_gains_cause(const model::Instance& instance, const model::Gains& gains) {
  constexpr double kSeconds = 1;  // of work
  const std::string& message = gains.solver.message;
  if (gains.verdict == model::Verdict::undecided || !gains.certificate)
    return message.empty() ? verdict_line(gains) : to_string(gains.verdict) + ": " + message;
  const std::string hidden = design::hidden_mode_text(instance);
  if (!hidden.empty()) return "infeasible: " + hidden;
  const auto conflict = design::guess_conflict(instance, gains, {}, kSeconds);
  return "infeasible: " + explanation_line(conflict.value(), {});
}

class Job {
 public:
  /// `hash`: of the gains, as soon as they are written.
  Job(const fs::path& file, fs::path folder, const JobOptions& options, std::string& hash)
      : instance_(load_problem(file, options.set)),
        folder_(std::move(folder)),
        options_(options),
        hash_(hash) {}

  void run(JobResult& result) {
    const std::string fingerprint = job_fingerprint(instance_, options_);
    if (options_.resume)
      if (auto kept = kept_job(folder_, result.name, fingerprint)) {
        result = std::move(*kept);
        return;
      }
    make(result);
    result.fingerprint = fingerprint;
  }

 private:
  void make(JobResult& result) {
    const design::SearchRequest request = wanted_search(instance_);
    model::Gains gains = design::synthesize_searched(instance_, request, options_.threads, {});
    if (is_stopping()) throw Interrupted("interrupted while gains were searched");
    find_error(instance_, gains);
    instance_ = bind::evaluate(instance_.design, gains.searched);
    const auto campaign = verify_and_write(gains);
    const std::vector<std::string> notes =
        campaign ? strict_notes(*campaign) : bind::unread_names(*instance_.design);
    if (options_.strict) refuse_notes(instance_.design->file, notes);
    result.differences = design::differences(
        instance_, gains, campaign ? std::optional(campaign->verdict) : std::nullopt);
    const bool nothing = design::lacks_gains(*instance_.design, gains);
    const verify::RunDifferences run =
        nothing ? verify::RunDifferences{} : verify::run_differences(instance_, gains);
    if (is_stopping()) throw Interrupted("interrupted while figures of the first run were found");
    result.differences.insert(result.differences.end(), run.different.begin(), run.different.end());
    result.exit = judge(*instance_.design, gains, campaign, result.differences);
    if (result.exit == ExitCode::yes && !run.undecided.empty()) result.exit = ExitCode::undecided;
    result.differences.insert(result.differences.end(), run.undecided.begin(), run.undecided.end());
    if (result.exit != ExitCode::yes) result.causes = causes(gains, campaign);
    result.line = verdict_line(gains) + "; " +
                  (campaign ? campaign_line(campaign_record(*campaign, hash_))
                            : "no campaign: " + why_no_campaign(gains));
    if (!notes.empty()) result.line += "; note: " + notes.front();
    result.report = report(gains, campaign, result);
    write_atomically(folder_ / "summary.txt", summary(gains, campaign, result));
  }

  /// The gains are written when the campaign is over, or cannot be run: not when it is interrupted.
  std::optional<verify::Report> verify_and_write(const model::Gains& gains) {
    const auto write = [&] {
      prepare(folder_);
      write_atomically(folder_ / "gains.json", io::gains_text(gains));
      hash_ = io::gains_hash(gains);
    };
    std::unique_ptr<const verify::Setup> setup;
    std::optional<verify::Report> campaign;
    try {
      if (why_no_campaign(gains).empty()) setup = verify::make_setup(instance_, gains);
      const auto is_stated = [](const claims::Claim& claim) { return claim.stated(); };
      if (setup && gains.verdict != model::Verdict::yes &&
          std::ranges::none_of(setup->claims(), is_stated)) {
        unstated_ = "no claim can be judged without " + setup->claims().front().missing.front();
        setup.reset();
      }
      if (setup) campaign = verify_gains(*setup);
    } catch (const InputError&) {
      write();
      throw;
    }
    write();
    if (campaign) write_campaign(*setup, *campaign);
    return campaign;
  }

  /// The gain file as a word of a command.
  std::string gains_words() const { return model::quoted((folder_ / "gains.json").string()); }

  /// What is not as expected, or not as usual, of the verdict and of the campaign.
  std::vector<std::string> causes(const model::Gains& gains,
                                  const std::optional<verify::Report>& campaign) const {
    if (design::lacks_gains(*instance_.design, gains)) return {no_gains_cause(instance_, gains)};
    const auto& expect = instance_.design->expect;
    const std::string wanted = expect && expect->campaign ? *expect->campaign : "held";
    if (!campaign || to_string(campaign->verdict) == wanted) return {};
    return campaign_causes(*campaign, gains_words());
  }

  /// Empty when the method can be simulated and every gain has a value.
  std::string why_no_campaign(const model::Gains& gains) const {
    const model::Design& design = *instance_.design;
    if (!unstated_.empty()) return unstated_;
    if (!design.no_campaign.empty()) return design.no_campaign;
    if (!design.dynamics) return "the method has no dynamics";
    if (design.claims.empty()) return "the method makes no claims";
    if (!model::ends(design)) return "the problem gives none";
    if (gains.gains.size() + gains.gain_functions.size() < design.gains.size()) return "no gains";
    return "";
  }

  verify::Report verify_gains(const verify::Setup& setup) const {
    const verify::CampaignOptions campaign{options_.runs, options_.seed, options_.threads};
    verify::Report report = verify::run_campaign(setup, campaign);
    if (report.interrupted()) throw Interrupted(interruption_text(report));
    return report;
  }

  void write_campaign(const verify::Setup& setup, const verify::Report& report) {
    write_atomically(folder_ / "campaign.json",
                     io::to_text(io::to_json(campaign_record(report, hash_))));
    hybrid::Trajectory worst = verify::run_of(setup, report.seed, report.worst_run);
    write_atomically(folder_ / "worst-run.svg",
                     run_picture(*instance_.design, setup, report.worst_run, worst));
    if (report.verdict != model::CampaignVerdict::held)
      write_atomically(folder_ / "worst-run.csv", run_csv(setup, worst));
  }

  io::Json report(const model::Gains& gains, const std::optional<verify::Report>& campaign,
                  const JobResult& result) const {
    io::Json document = {{"problem", gains.problem_name},
                         {"folder", result.name},
                         {"exit", static_cast<int>(result.exit)},
                         {"verdict", to_string(gains.verdict)},
                         {"status", gains.solver.status}};
    if (gains.objective) document["objective"] = *gains.objective;
    document["campaign"] = campaign ? io::Json(to_string(campaign->verdict)) : io::Json();
    if (!campaign) document["no_campaign"] = why_no_campaign(gains);
    document["causes"] = result.causes;
    document["differences"] = result.differences;
    return document;
  }

  std::string summary(const model::Gains& gains, const std::optional<verify::Report>& campaign,
                      const JobResult& result) const {
    std::string text = synthesis_summary(gains);
    // Otherwise the message above says it.
    if (design::lacks_gains(*instance_.design, gains) && gains.solver.message.empty())
      text += "why         " + result.causes.front() + "\n";
    if (campaign) text += campaign_summary(*campaign, gains_words());
    if (instance_.design->expect || !result.differences.empty())
      text +=
          result.differences.empty() ? "expected    all as expected\n" : "expected    DIFFERENT:\n";
    for (const std::string& difference : result.differences) text += "  " + difference + "\n";
    return text;
  }

  model::Instance instance_;
  fs::path folder_;
  const JobOptions& options_;
  std::string& hash_;
  std::string unstated_;  ///< why a campaign would judge nothing
};

/// The path of a problem from the folder of its results; empty for standard input.
std::string path_from(const fs::path& folder, const fs::path& problem) {
  std::error_code error;
  if (problem == "-") return "";
  const fs::path path = fs::proximate(problem, folder, error);
  return error ? "" : path.string();
}

/// The last file of the folder; without gains the only one. A folder that cannot be written to is a
/// result too.
void write_job(const fs::path& problem, const fs::path& folder, JobResult& result) {
  try {
    if (result.gains_hash.empty()) prepare(folder);
    io::Json document = io::result_json(result.report, path_from(folder, problem),
                                        result.gains_hash, result.seconds);
    if (!result.fingerprint.empty()) document = with_fingerprint(std::move(document), result);
    write_atomically(folder / "result.json", io::to_text(document));
  } catch (const InputError& error) {
    if (result.report.contains("error")) return;  // which says more
    result.exit = ExitCode::bad_input;
    result.line = error.what();
  }
}

}  // namespace

std::string mark_of(ExitCode exit) {
  switch (exit) {
    case ExitCode::yes:
      return "ok";
    case ExitCode::no:
      return "NO";
    case ExitCode::bad_input:
      return "ERROR";
    case ExitCode::undecided:
      return "UNDECIDED";
    case ExitCode::fault:
      break;
  }
  return "FAULT";
}

JobResult run_job(const std::filesystem::path& problem, const std::string& name,
                  const std::filesystem::path& folder, const JobOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  JobResult result;
  result.name = name;
  // What has not begun may be kept.
  const bool begins = !is_stopping();
  try {
    if (!begins) throw Interrupted("interrupted before it began");
    Job(problem, folder, options, result.gains_hash).run(result);
  } catch (const Interrupted& stop) {
    set_interrupted(stop.what(), result);
  } catch (const Stopped&) {
    set_interrupted("interrupted", result);
  } catch (const InputError& error) {
    result.exit = ExitCode::bad_input;
    result.line = error.what();
  } catch (const std::exception& error) {
    result.exit = ExitCode::fault;
    result.line = error.what();
  }
  if (result.report.is_null())
    result.report = {
        {"folder", name}, {"exit", static_cast<int>(result.exit)}, {"error", result.line}};
  if (result.kept) return result;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!result.interrupted) write_job(problem, folder, result);
  if (result.interrupted && (begins || !options.resume)) clear(folder);
  return result;
}

}  // namespace gainsmith::app
