#include "gainsmith/campaign_text.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "base/scalars.h"
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

io::Json check_json(const verify::CheckReport& check) {
  io::Json result = {
      {"claim", check.name}, {"kind", kind_text(check.kind)}, {"stated", check.stated}};
  if (!check.stated) {
    result["missing"] = check.missing;
    return result;
  }
  result["looked_at"] = check.worst.looked;
  result["violations"] = check.violations;
  result["undecided"] = check.undecided;
  result["worst_run"] = check.worst_run;
  result["worst"] = {{"score", io::finite_or_null(check.worst.score)},
                     {"value", io::finite_or_null(check.worst.value)},
                     {"bound", io::finite_or_null(check.worst.bound)},
                     {"rounding", io::finite_or_null(check.worst.rounding)},
                     {"t", check.worst.t},
                     {"j", check.worst.j}};
  if (check.worst.tolerance > 0) result["tolerance"] = check.worst.tolerance;
  if (check.floor > 0) result["checked_down_to"] = check.floor;
  return result;
}

std::string runs_text(std::uint64_t runs) {
  return fmt::format("{} run{}", runs, runs == 1 ? "" : "s");
}

/// Why nothing is certain of an undecided comparison.
std::string uncertainty_text(model::ClaimKind kind, const claims::Finding& worst) {
  if (worst.estimated && !std::isfinite(worst.rounding))
    return "               nothing is certain: two runs that differ in accuracy and in their last "
           "places have parted by then,\n               or the text branches more often than can be "
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
      "  try         a claim that asks for a little less (tolerance: 1e-6) or begins later (after: 1), a "
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

io::Json campaign_json(const verify::Report& report) {
  io::Json checks = io::Json::array();
  for (const verify::CheckReport& check : report.checks) checks.push_back(check_json(check));
  io::Json document = {
      {"verdict", to_string(report.verdict)},
      {"runs", report.runs},
      {"seed", report.seed},
      {"horizon", report.horizon},
      {"status", to_string(report.verdict)},
      {"violations", report.violations},
      {"undecided", report.undecided},
      {"unfinished", report.unfinished},
      {"worst_run", report.worst_run},
      {report.integrated ? "repeated" : "repeated_in_31_digits", report.repeated},
      {report.integrated ? "confirmed" : "confirmed_in_31_digits", report.confirmed},
      {"different_runs", report.different ? io::Json(*report.different) : io::Json()},
      {"confidence", report.different ? io::Json() : io::Json(report.confidence)},
      {"violation_probability_at_most",
       report.different ? io::Json() : io::Json(report.violation_probability)},
      {"notes", notes_on(report)},
      {"checks", checks}};
  if (report.interrupted()) {
    document["runs_asked"] = report.asked;
    document["message"] = interruption_text(report);
  }
  return document;
}

std::string interruption_text(const verify::Report& report) {
  std::string text = fmt::format("interrupted after {} of {} runs", report.runs, report.asked);
  if (report.runs == 0) return text;
  text += fmt::format(": {} held", report.runs - report.violations - report.undecided);
  if (report.violations > 0) text += fmt::format(", {} violated", report.violations);
  if (report.undecided > 0) text += fmt::format(", {} undecided", report.undecided);
  return text + fmt::format("; --runs {} gives a verdict in the time that was spent", report.runs);
}

std::string campaign_line(const verify::Report& report) {
  if (report.interrupted()) return "undecided: " + interruption_text(report);
  if (report.verdict == model::CampaignVerdict::held)
    return fmt::format("held in {}{}", runs_text(report.runs),
                       report.different ? " (nothing is drawn)" : "");
  if (report.verdict == model::CampaignVerdict::violated)
    return fmt::format(
        "violated in {} of {}, worst {}, confirmed {}", report.violations, runs_text(report.runs),
        report.worst_run,
        report.integrated ? "more accurately" : fmt::format("in {} digits", kQuadDigits));
  return fmt::format("undecided in {} of {}", report.undecided + report.violations,
                     runs_text(report.runs));
}

std::string campaign_summary(const verify::Report& report, const std::string& gains_file) {
  std::string text = fmt::format("campaign    {} (seed {}, horizon {})\n", campaign_line(report),
                                 report.seed, brief(report.horizon));
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
