#include "gainsmith/worst_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/number.h"
#include "gainsmith/campaign_text.h"
#include "io/json/given_run_json.h"
#include "model/stated_file.h"

namespace gainsmith::app {

namespace {

/// A search proves no claim: what it does not find is not held.
std::string verdict_word(const verify::WorstReport& report) {
  if (report.interrupted) return "interrupted";
  switch (report.verdict) {
    case model::CampaignVerdict::violated:
      return "violated";
    case model::CampaignVerdict::undecided:
      return "undecided";
    case model::CampaignVerdict::held:
      return "no violation found";
  }
  return "?";
}

/// A violation that was not repeated yet is none.
std::string claim_word(const verify::WorstReport& report, const claims::Finding& finding) {
  if (report.interrupted) return finding.violated() ? "not confirmed" : "held so far";
  return finding.violated() ? "violated" : finding.undecided() ? "undecided" : "not violated";
}

std::string claim_text(const verify::WorstReport& report, std::size_t number, std::size_t width) {
  const claims::NamedFinding& claim = report.claims[number];
  const claims::Finding& finding = claim.finding;
  std::string text = fmt::format("  {:<{}} {:<17} {:<13}  ", claim.name, width,
                                 kind_text(claim.kind), claim_word(report, finding));
  if (!finding.sampled && !finding.ended)
    return text + "no run reaches the time or event of the claim\n";
  if (finding.ended) return text + "the run " + end_text(finding) + "\n";
  return text + fmt::format("worst: {} against {} at (t, j) = ({}, {})\n", brief(finding.value),
                            brief(finding.bound), brief(finding.t), finding.j);
}

std::string given_text(const hybrid::GivenRun& run, const model::Design& design) {
  return io::to_json(run, *design.dynamics).dump();
}

std::string lengths_text(const verify::PeriodicLengths& lengths) {
  std::string text;
  for (const double length : lengths.lengths) text += (text.empty() ? "" : ", ") + brief(length);
  return fmt::format("  linear part  {} by a factor of {} a jump when the lengths {} repeat{}\n",
                     lengths.growth > 1 ? "grows" : "decays most slowly, of what was tried,",
                     brief(lengths.growth), text, lengths.growth > 1 ? ": unstable" : "");
}

}  // namespace

std::string worst_summary(const verify::WorstReport& report, const model::Design& design,
                          const std::string& gains_file) {
  std::string text =
      fmt::format("worst       {} ({} runs tried, seed {}, horizon {})\n", verdict_word(report),
                  report.runs, report.seed, brief(report.horizon));
  std::size_t width = 12;
  for (const auto& claim : report.claims) width = std::max(width, claim.name.size());
  for (std::size_t c = 0; c < report.claims.size(); ++c) {
    text += claim_text(report, c, width);
    text += fmt::format("    replay    gainsmith simulate {} --given {}\n", gains_file,
                        model::quoted(given_text(report.given[c], design)));
  }
  for (const auto& [name, symbols] : report.missing)
    text += fmt::format("  {:<{}} not stated: no value for {}\n", name, width,
                        fmt::join(symbols, ", "));
  if (report.lengths && !report.lengths->lengths.empty()) text += lengths_text(*report.lengths);
  if (report.verdict != model::CampaignVerdict::violated && !report.interrupted)
    text +=
        "  note        that nothing was found shows nothing: runs that were not tried may be "
        "worse\n";
  return text;
}

io::Json worst_json(const verify::WorstReport& report, const model::Design& design) {
  io::Json claims = io::Json::array();
  for (std::size_t c = 0; c < report.claims.size(); ++c) {
    const claims::NamedFinding& claim = report.claims[c];
    const claims::Finding& finding = claim.finding;
    claims.push_back({{"name", claim.name},
                      {"claim", kind_text(claim.kind)},
                      {"verdict", claim_word(report, finding)},
                      {"value", io::finite_or_null(finding.value)},
                      {"bound", io::finite_or_null(finding.bound)},
                      {"t", finding.t},
                      {"j", finding.j},
                      {"given", io::to_json(report.given[c], *design.dynamics)}});
  }
  io::Json json = {{"verdict", verdict_word(report)},
                   {"runs", report.runs},
                   {"seed", report.seed},
                   {"horizon", report.horizon},
                   {"claims", claims}};
  if (report.lengths)
    json["linear_part"] = {{"lengths", report.lengths->lengths},
                           {"growth", report.lengths->growth}};
  return json;
}

}  // namespace gainsmith::app
