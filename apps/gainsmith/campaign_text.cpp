#include "gainsmith/campaign_text.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "base/scalars.h"
#include "base/version.h"
#include "gainsmith/advice.h"
#include "gainsmith/notes.h"
#include "model/stated_file.h"

namespace gainsmith::app {

namespace {

constexpr const char* kLongerHorizon =
    "the end of a run is compared with its start: a longer campaign.horizon leaves more time to a "
    "value that decays";

/// What JSON has no number for has no value.
std::optional<double> finite(double value) {
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

model::ClaimRecord claim_record(const verify::CheckReport& check) {
  model::ClaimRecord record;
  record.name = check.name;
  record.kind = kind_text(check.kind);
  record.stated = check.stated;
  record.missing = check.missing;
  record.sampled = check.worst.sampled;
  record.violations = check.violations;
  record.undecided = check.undecided;
  record.worst_run = check.worst_run;
  const auto measured = [&](double value) { return check.measured ? finite(value) : std::nullopt; };
  record.worst = {finite(check.worst.score),
                  measured(check.worst.value),
                  measured(check.worst.bound),
                  measured(check.worst.rounding),
                  check.worst.t,
                  check.worst.j};
  record.tolerance = check.worst.tolerance;
  record.checked_down_to = check.floor;
  return record;
}

/// `gains_file`: as a word of the command, with its settings.
std::string replay_command(const std::string& gains_file, std::uint64_t run, std::uint64_t seed) {
  return fmt::format("gainsmith simulate {} --run {} --seed {} -o run.csv", gains_file, run, seed);
}

std::string runs_text(std::uint64_t runs) {
  return fmt::format("{} run{}", runs, runs == 1 ? "" : "s");
}

/// Whether nothing is known of the value any more.
bool has_parted(const claims::Finding& finding) {
  return !std::isnan(finding.value) && !std::isfinite(finding.rounding);
}

/// Whether there is none.
bool has_no_value(const claims::Finding& finding) {
  return std::isnan(finding.value) || std::isnan(finding.bound);
}

/// With as many digits as tell them apart.
std::pair<std::string, std::string> told_apart(double value, double bound) {
  constexpr int kUsual = 6, kMost = 17;
  for (int digits = kUsual; digits < kMost; ++digits)
    if (auto one = brief(value, digits), other = brief(bound, digits);
        one != other || value == bound)
      return {one, other};
  return {brief(value, kMost), brief(bound, kMost)};
}

/// Why nothing is certain of an undecided comparison.
std::string uncertainty_text(model::ClaimKind kind, const claims::Finding& finding) {
  if (finding.disputed)
    return "one computation of the run violates it, another, more accurate or rounded otherwise, "
           "does not";
  if (has_no_value(finding)) return "the claim has no value there";
  if (has_parted(finding))
    return "two computations that differ in accuracy and in their last places have parted by "
           "then, or the text branches too often";
  const std::string value = brief(finding.value), bound = brief(finding.bound);
  if (value == bound)
    return fmt::format("equal to its bound as far as two integrations tell, to {}: a tie",
                       brief(finding.rounding, 2));
  return fmt::format("known to {} by two integrations: nothing is certain of {} {} {}",
                     brief(finding.rounding, 2), value,
                     kind == model::ClaimKind::above ? ">=" : "<=", bound);
}

/// `width`: of the names.
std::string check_text(const verify::CheckReport& check, std::size_t width) {
  if (!check.stated)
    return fmt::format("  {:<{}} not stated: no value for {}\n", check.name, width,
                       fmt::join(check.missing, ", "));
  if (!check.worst.sampled && !check.worst.ended)
    return fmt::format(
        "  {:<{}} {:<17} held      never checked: no run reaches the time or event "
        "of the claim\n",
        check.name, width, kind_text(check.kind));
  const claims::Finding& worst = check.worst;
  const bool bounded =
      check.kind == model::ClaimKind::below || check.kind == model::ClaimKind::above;
  const bool held = check.violations == 0 && check.undecided == 0;
  const std::string verdict =
      check.violations > 0  ? fmt::format("violated in {}", runs_text(check.violations))
      : check.undecided > 0 ? fmt::format("undecided in {}", runs_text(check.undecided))
                            : "held";
  std::string text =
      fmt::format("  {:<{}} {:<17} {:<8}  ", check.name, width, kind_text(check.kind), verdict);
  if (!check.measured)
    return text + fmt::format("{} run {}, stopped before its values were known\n",
                              held ? "nearest" : "worst", check.worst_run);
  if (worst.ended) return text + fmt::format("run {} {}\n", check.worst_run, end_text(worst));
  const auto [value, bound] = told_apart(worst.value, worst.bound);
  text += fmt::format("{} run {}: {} against {} at (t, j) = ({}, {})\n", held ? "nearest" : "worst",
                      check.worst_run, value, bound, brief(worst.t), worst.j);
  if (check.kind == model::ClaimKind::shrinks && worst.violated())
    text += fmt::format("               {}\n", kLongerHorizon);
  if (worst.undecided()) text += "               " + uncertainty_text(check.kind, worst) + "\n";
  if (worst.tolerance > 0)
    text += fmt::format("               within a tolerance of {} {}\n", brief(worst.tolerance),
                        bounded && worst.bound == 0 ? "of the largest terms" : "of the bound");
  if (check.floor > 0)
    text += fmt::format(
        "               checked down to {} of the {}: the integration shows no larger drop\n",
        brief(check.floor, 2), bounded ? "largest terms" : "start");
  return text;
}

/// Why a run did not reach the horizon.
std::string ending_text(claims::Termination termination, const std::string& message) {
  if (termination == claims::Termination::lost && !message.empty()) return message;
  return to_string(termination) + (message.empty() ? "" : ", " + message);
}

std::string unfinished_text(const verify::Report& report) {
  return ending_text(report.unfinished_termination, report.unfinished_message);
}

/// Why the first undecided run is undecided.
std::string reason_text(const verify::Report& report) {
  const verify::UndecidedRun& first = *report.first_undecided;
  const claims::Finding& finding = first.finding;
  if (first.termination != claims::Termination::horizon)
    return fmt::format("it ends at t = {}, before the horizon: {}", brief(finding.t),
                       ending_text(first.termination, first.message));
  const verify::CheckReport& check = report.checks[first.check];
  return fmt::format("{} at (t, j) = ({}, {}): {}", check.name, brief(finding.t), finding.j,
                     uncertainty_text(check.kind, finding));
}

/// What may decide the first undecided run, which reaches the horizon.
std::string advice_text(const verify::Report& report) {
  if (has_no_value(report.first_undecided->finding)) return "";
  if (has_parted(report.first_undecided->finding))
    return "  try         a shorter campaign.horizon, or claims written in differences of states "
           "(z - zh)\n";
  return "  try         a claim that asks for a little less (tolerance: 1e-6) or begins later "
         "(after: 1), a shorter\n"
         "              campaign.horizon, or claims written in differences of states (z - zh)\n";
}

bool is_first_undecided(const verify::Report& report, std::uint64_t run) {
  return report.first_undecided && report.first_undecided->run == run;
}

std::string undecided_text(const verify::Report& report, const std::string& gains_file) {
  if (!report.first_undecided) return "";
  const verify::UndecidedRun& first = *report.first_undecided;
  std::string text =
      fmt::format("  {} of {} undecided; {} run {}: {}\n", report.undecided, runs_text(report.runs),
                  report.undecided == 1 ? "it is" : "first", first.run, reason_text(report));
  if (first.termination == claims::Termination::horizon) text += advice_text(report);
  if (first.run != report.worst_run)
    text += fmt::format("  see         gainsmith simulate {} --run {} --seed {}\n", gains_file,
                        first.run, report.seed);
  return text;
}

/// What the worst run of a violated claim did.
std::string violation_text(const verify::CheckReport& check, const verify::Report& report) {
  const claims::Finding& worst = check.worst;
  if (!worst.ended)
    return fmt::format("{} against {} at (t, j) = ({}, {}) of run {}", brief(worst.value),
                       brief(worst.bound), brief(worst.t), worst.j, check.worst_run);
  return fmt::format("run {} {}; run {}: {}", check.worst_run, end_text(worst),
                     report.unfinished_run, unfinished_text(report));
}

}  // namespace

std::string kind_text(model::ClaimKind kind) {
  switch (kind) {
    case model::ClaimKind::nonincreasing:
      return "never increases";
    case model::ClaimKind::cost:
      return "cost stays below";
    case model::ClaimKind::shrinks:
      return "shrinks";
    case model::ClaimKind::below:
      return "stays below";
    case model::ClaimKind::above:
      return "stays above";
  }
  return "?";
}

std::string end_text(const claims::Finding& finding) {
  return fmt::format("ended at (t, j) = ({}, {}), before {}", brief(finding.t), finding.j,
                     finding.violated() ? "its horizon" : "the claim could be decided");
}

ExitCode campaign_exit(model::CampaignVerdict verdict) {
  switch (verdict) {
    case model::CampaignVerdict::held:
      return ExitCode::yes;
    case model::CampaignVerdict::violated:
      return ExitCode::no;
    case model::CampaignVerdict::undecided:
      return ExitCode::undecided;
  }
  return ExitCode::fault;
}

model::CampaignRecord campaign_record(const verify::Report& report, const std::string& gains_hash) {
  model::CampaignRecord record;
  record.verdict = report.verdict;
  record.runs = report.runs;
  record.seed = report.seed;
  record.horizon = report.horizon;
  record.violations = report.violations;
  record.undecided = report.undecided;
  record.unfinished = report.unfinished;
  if (report.unfinished > 0)
    record.first_unfinished = {report.unfinished_run, unfinished_text(report)};
  if (report.first_undecided)
    record.first_undecided = {report.first_undecided->run, reason_text(report)};
  record.worst_run = report.worst_run;
  record.repeated = report.repeated;
  record.confirmed = report.confirmed;
  record.different_runs = report.different;
  if (!report.different) {
    record.confidence = report.confidence;
    record.violation_probability = report.violation_probability;
  }
  record.notes = notes_on(report);
  for (const verify::CheckReport& check : report.checks)
    record.checks.push_back(claim_record(check));
  record.runs_asked = report.ended ? report.runs : report.asked;
  if (report.interrupted()) record.message = interruption_text(report);
  record.version = kVersion;
  record.gains_hash = gains_hash;
  return record;
}

std::string interruption_text(const verify::Report& report) {
  std::string text = fmt::format("interrupted after {} of {} runs", report.runs, report.asked);
  if (report.runs == 0) return text;
  text += fmt::format(": {} held", report.runs - report.violations - report.undecided);
  if (report.violations > 0) text += fmt::format(", {} violated", report.violations);
  if (report.undecided > 0) text += fmt::format(", {} undecided", report.undecided);
  if (report.verdict == model::CampaignVerdict::violated) return text;
  return text + fmt::format("; --runs {} gives a verdict in the time that was spent", report.runs);
}

std::string campaign_line(const model::CampaignRecord& record) {
  if (record.runs < record.runs_asked)
    return (record.verdict == model::CampaignVerdict::violated ? "violated: " : "undecided: ") +
           record.message;
  const std::string worst = record.runs > 1 ? fmt::format(", worst run {}", record.worst_run) : "";
  if (record.verdict == model::CampaignVerdict::held)
    return fmt::format("held in {}{}{}", runs_text(record.runs),
                       record.different_runs ? " (nothing is drawn)" : "", worst);
  if (record.verdict == model::CampaignVerdict::violated)
    return fmt::format("violated in {} of {}{}, confirmed more accurately", record.violations,
                       runs_text(record.runs), worst);
  return fmt::format("undecided in {} of {}{}", record.undecided + record.violations,
                     runs_text(record.runs), worst);
}

std::vector<std::string> campaign_causes(const verify::Report& report,
                                         const std::string& gains_file) {
  const auto replay = [&](std::uint64_t run) {
    return "; replay: " + replay_command(gains_file, run, report.seed);
  };
  std::vector<std::string> causes;
  if (report.verdict == model::CampaignVerdict::undecided && report.first_undecided)
    causes.push_back(
        fmt::format("undecided: run {}: {}", report.first_undecided->run, reason_text(report)) +
        replay(report.first_undecided->run));
  if (report.verdict != model::CampaignVerdict::violated) return causes;
  std::vector<const verify::CheckReport*> violated;
  for (const verify::CheckReport& check : report.checks)
    if (check.violations > 0) violated.push_back(&check);
  std::stable_sort(violated.begin(), violated.end(),
                   [](const auto* a, const auto* b) { return a->worst.score > b->worst.score; });
  for (const verify::CheckReport* check : violated)
    causes.push_back(
        fmt::format("claim {} ({}) violated in {}: ", check->name, kind_text(check->kind),
                    runs_text(check->violations)) +
        violation_text(*check, report) +
        (check->kind == model::ClaimKind::shrinks ? fmt::format("; {}", kLongerHorizon) : "") +
        replay(check->worst_run));
  if (!report.growing.empty()) causes.push_back(report.growing);
  return causes;
}

std::string campaign_summary(const verify::Report& report, const std::string& gains_file) {
  std::string text =
      fmt::format("campaign    {} (seed {}, horizon {})\n",
                  campaign_line(campaign_record(report, "")), report.seed, brief(report.horizon));
  if (report.runs == 0) return text;
  std::size_t width = 12;
  for (const verify::CheckReport& check : report.checks) width = std::max(width, check.name.size());
  for (const verify::CheckReport& check : report.checks) text += check_text(check, width);
  if (report.unfinished > 0 && is_first_undecided(report, report.unfinished_run))
    text += fmt::format("  {} did not reach the horizon\n", runs_text(report.unfinished));
  else if (report.unfinished > 0)
    text +=
        fmt::format("  {} did not reach the horizon; run {}: {}\n", runs_text(report.unfinished),
                    report.unfinished_run, unfinished_text(report));
  if (!report.growing.empty()) text += "  why         " + report.growing + "\n";
  text += undecided_text(report, gains_file);
  for (const std::string& note : notes_on(report)) text += "  note        " + note + "\n";
  if (report.violation_probability < 1)
    text += fmt::format("  with {} % confidence at most {} of such runs violate\n",
                        brief(100 * report.confidence), brief(report.violation_probability, 3));
  return text + "  replay      " + replay_command(gains_file, report.worst_run, report.seed) + "\n";
}

}  // namespace gainsmith::app
