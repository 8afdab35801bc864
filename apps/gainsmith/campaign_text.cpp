#include "gainsmith/campaign_text.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "base/scalars.h"
#include "base/version.h"
#include "gainsmith/notes.h"

namespace gainsmith::app {

namespace {

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
  record.looked_at = check.worst.looked;
  record.violations = check.violations;
  record.undecided = check.undecided;
  record.worst_run = check.worst_run;
  record.worst = {finite(check.worst.score),
                  finite(check.worst.value),
                  finite(check.worst.bound),
                  finite(check.worst.rounding),
                  check.worst.t,
                  check.worst.j};
  record.tolerance = check.worst.tolerance;
  record.checked_down_to = check.floor;
  return record;
}

std::string runs_text(std::uint64_t runs) {
  return fmt::format("{} run{}", runs, runs == 1 ? "" : "s");
}

/// Why nothing is certain of an undecided comparison.
std::string uncertainty_text(model::ClaimKind kind, const claims::Finding& worst) {
  if (worst.estimated && !std::isfinite(worst.rounding))
    return "               nothing is certain: two runs that differ in accuracy and in their last "
           "places have parted by then,\n               or the text branches more often than can "
           "be "
           "searched\n";
  const std::string how =
      worst.estimated ? "by two integrations" : fmt::format("in {} digits", worst.digits);
  const std::string known =
      std::isfinite(worst.rounding)
          ? fmt::format("known to {} {}", brief(worst.rounding, 2), how)
          : fmt::format("{} the bound on the error is larger than all numbers", how);
  return fmt::format("               {}: nothing is certain of {} {} {}\n", known,
                     brief(worst.value),
                     kind == model::ClaimKind::above ? ">=" : "<=", brief(worst.bound));
}

/// `width`: of the names.
std::string check_text(const verify::CheckReport& check, std::size_t width) {
  if (!check.stated)
    return fmt::format("  {:<{}} not stated: no value for {}\n", check.name, width,
                       fmt::join(check.missing, ", "));
  if (!check.worst.looked && !check.worst.ended)
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
      fmt::format("  {:<{}} {:<17} {:<8}  {} run {}: {} against {} at (t, j) = ({}, {})\n",
                  check.name, width, kind_text(check.kind), verdict, held ? "nearest" : "worst",
                  check.worst_run, brief(worst.value), brief(worst.bound), brief(worst.t), worst.j);
  if (worst.ended)
    text += "               undecided: the run ends there, before the horizon\n";
  else if (worst.undecided())
    text += uncertainty_text(check.kind, worst);
  if (worst.tolerance > 0)
    text += fmt::format("               within a tolerance of {} {}\n", brief(worst.tolerance),
                        bounded && worst.bound == 0 ? "of the largest terms" : "of the bound");
  if (check.floor > 0)
    text += fmt::format("               checked down to {} of the {}: the {} no larger drop\n",
                        brief(check.floor, 2), bounded ? "largest terms" : "start",
                        worst.estimated ? "integration shows" : "digits show");
  return text;
}

/// Why the first run that did not reach the horizon ended.
std::string ending_text(const verify::Report& report) {
  const std::string& message = report.unfinished_message;
  if (report.unfinished_termination == bounded::Termination::lost && !message.empty())
    return message;
  return to_string(report.unfinished_termination) + (message.empty() ? "" : ", " + message);
}

/// What stopped an undecided campaign, and what to try.
std::string undecided_text(const verify::Report& report, const std::string& gains_file) {
  if (report.close == 0) return "";
  return fmt::format(
      "  {} of {} {} undecided: what {} lies closer together than the {}\n"
      "  try         a claim that asks for a little less (tolerance: 1e-6) or begins later (after: "
      "1), a "
      "shorter\n"
      "              campaign.horizon, or claims written in differences of states (z - zh); see\n"
      "              gainsmith simulate {} --run {} --seed {}\n",
      report.close, runs_text(report.runs), report.close == 1 ? "is" : "are",
      report.close == 1 ? "it compares" : "they compare",
      report.integrated ? "errors of integration"
                        : fmt::format("rounding of {} digits", kQuadDigits),
      gains_file, report.worst_run, report.seed);
}

}  // namespace

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
  if (report.unfinished > 0) record.first_unfinished = {report.unfinished_run, ending_text(report)};
  record.worst_run = report.worst_run;
  record.repeated = report.repeated;
  record.integrated = report.integrated;
  record.confirmed = report.confirmed;
  record.different_runs = report.different;
  if (!report.different) {
    record.confidence = report.confidence;
    record.violation_probability = report.violation_probability;
  }
  record.notes = notes_on(report);
  for (const verify::CheckReport& check : report.checks)
    record.checks.push_back(claim_record(check));
  record.runs_asked = report.asked;
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
  return text + fmt::format("; --runs {} gives a verdict in the time that was spent", report.runs);
}

std::string campaign_line(const model::CampaignRecord& record) {
  if (record.runs < record.runs_asked) return "undecided: " + record.message;
  if (record.verdict == model::CampaignVerdict::held)
    return fmt::format("held in {}{}", runs_text(record.runs),
                       record.different_runs ? " (nothing is drawn)" : "");
  if (record.verdict == model::CampaignVerdict::violated)
    return fmt::format(
        "violated in {} of {}, worst {}, confirmed {}", record.violations, runs_text(record.runs),
        record.worst_run,
        record.integrated ? "more accurately" : fmt::format("in {} digits", kQuadDigits));
  return fmt::format("undecided in {} of {}", record.undecided + record.violations,
                     runs_text(record.runs));
}

std::string campaign_summary(const verify::Report& report, const std::string& gains_file) {
  std::string text =
      fmt::format("campaign    {} (seed {}, horizon {})\n",
                  campaign_line(campaign_record(report, "")), report.seed, brief(report.horizon));
  if (report.runs == 0) return text;
  std::size_t width = 12;
  for (const verify::CheckReport& check : report.checks) width = std::max(width, check.name.size());
  for (const verify::CheckReport& check : report.checks) text += check_text(check, width);
  if (report.unfinished > 0)
    text += fmt::format("  {} did not reach the horizon; run {}: {}\n",
                        runs_text(report.unfinished), report.unfinished_run, ending_text(report));
  text += undecided_text(report, gains_file);
  for (const std::string& note : notes_on(report)) text += "  note        " + note + "\n";
  if (report.violation_probability < 1)
    text += fmt::format("  with {} % confidence at most {} of such runs violate\n",
                        brief(100 * report.confidence), brief(report.violation_probability, 3));
  return text + fmt::format("  replay      gainsmith simulate {} --run {} --seed {}\n", gains_file,
                            report.worst_run, report.seed);
}

}  // namespace gainsmith::app
