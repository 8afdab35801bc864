#include "gainsmith/campaign_text.h"

#include <fmt/format.h>

#include "base/number.h"

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
  result["violations"] = check.violations;
  result["worst_run"] = check.worst_run;
  result["worst"] = {{"score", io::finite_or_null(check.worst.score)},
                     {"value", io::finite_or_null(check.worst.value)},
                     {"bound", io::finite_or_null(check.worst.bound)},
                     {"t", check.worst.t},
                     {"j", check.worst.j}};
  return result;
}

std::string check_text(const verify::CheckReport& check) {
  if (!check.stated)
    return fmt::format("  {:<12} not stated: no value for {}\n", check.name,
                       fmt::join(check.missing, ", "));
  const verify::Finding& worst = check.worst;
  return fmt::format(
      "  {:<12} {:<17} {:<8}  {} run {}: {} against {} at (t, j) = ({}, {})\n", check.name,
      kind_text(check.kind),
      check.violations == 0 ? "held" : fmt::format("violated in {} runs", check.violations),
      check.violations == 0 ? "nearest" : "worst", check.worst_run, brief(worst.value),
      brief(worst.bound), brief(worst.t), worst.j);
}

}  // namespace

io::Json campaign_json(const verify::Report& report) {
  io::Json checks = io::Json::array();
  for (const verify::CheckReport& check : report.checks) checks.push_back(check_json(check));
  return {{"verdict", to_string(report.verdict)},
          {"runs", report.runs},
          {"seed", report.seed},
          {"horizon", report.horizon},
          {"violations", report.violations},
          {"unfinished", report.unfinished},
          {"worst_run", report.worst_run},
          {"confidence", report.confidence},
          {"violation_probability_at_most", report.violation_probability},
          {"checks", checks}};
}

std::string campaign_line(const verify::Report& report) {
  if (report.verdict == model::CampaignVerdict::held)
    return fmt::format("held in {} runs", report.runs);
  return fmt::format("violated in {} of {} runs, worst {}", report.violations, report.runs,
                     report.worst_run);
}

std::string campaign_summary(const verify::Report& report, const std::string& gains_file) {
  std::string text = fmt::format("campaign    {} (seed {}, horizon {})\n", campaign_line(report),
                                 report.seed, brief(report.horizon));
  for (const verify::CheckReport& check : report.checks) text += check_text(check);
  if (report.unfinished > 0)
    text += fmt::format("  {} runs did not reach the horizon; run {}: {}{}\n", report.unfinished,
                        report.worst_run, to_string(report.worst_termination),
                        report.worst_message.empty() ? "" : ", " + report.worst_message);
  text += fmt::format("  with {} % confidence at most {} of such runs violate\n",
                      brief(100 * report.confidence), brief(report.violation_probability, 3));
  return text + fmt::format("  replay      gainsmith simulate {} --run {} --seed {}\n", gains_file,
                            report.worst_run, report.seed);
}

}  // namespace gainsmith::app
