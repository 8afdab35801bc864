#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "base/stop.h"
#include "statistics/sample_bounds.h"
#include "verify/campaign.h"

namespace gainsmith::verify {

namespace {

/// Puts what the careful run finds in the place of what packs said of the worst run of each claim:
/// they know only a verdict and a score. What is not certain to the careful run is undecided.
void take_careful(const CampaignPart& part, Tally& tally) {
  std::vector<std::uint64_t> opened;
  for (std::size_t c = 0; c < tally.claims.size(); ++c) {
    ClaimTally& claim = tally.claims[c];
    const auto known = part.repeats.find(claim.run);
    if (known == part.repeats.end() || !known->second.careful) {
      if (tally.runs < part.facts.asked || is_stopping()) continue;  // stopped before
      throw std::logic_error("a worst run was not repeated");
    }
    const Repeat::Careful& again = *known->second.careful;
    const claims::Finding& found = again.findings.at(c);
    if (found.undecided() && !claim.worst.undecided()) {
      const bool violated = claim.worst.violated();
      if (violated) --claim.violations;
      ++claim.undecided;
      if (std::find(opened.begin(), opened.end(), claim.run) == opened.end()) {
        opened.push_back(claim.run);
        if (violated) --tally.violations;
        ++tally.undecided;
        const auto& before = tally.first_undecided;
        if (!before || claim.run < before->run)
          tally.first_undecided =
              undecided_run(claim.run, again.termination, again.message, again.findings);
      }
    }
    claim.worst = found;
  }
}

/// One report a claim, in the order of the method; those of claims that are not stated hold no
/// runs.
std::vector<CheckReport> report_checks(const CampaignPart& part, const Tally& tally) {
  std::vector<CheckReport> reports;
  std::size_t next = 0;
  for (const ClaimFacts& claim : part.facts.claims) {
    CheckReport report;
    report.name = claim.name;
    report.kind = claim.kind;
    report.stated = claim.stated();
    report.missing = claim.missing;
    if (claim.stated()) {
      const ClaimTally& found = tally.claims[next++];
      report.violations = found.violations;
      report.undecided = found.undecided;
      report.floor = found.floor;
      report.worst_run = found.run;
      report.worst = found.worst;
      const auto known = part.repeats.find(found.run);
      report.measured = !part.facts.many_at_once ||
                        (known != part.repeats.end() && known->second.careful.has_value());
    }
    reports.push_back(std::move(report));
  }
  return reports;
}

/// The place among all claims of the one that is number `stated` of those that are stated.
std::size_t place_of(const std::vector<CheckReport>& checks, std::size_t stated) {
  std::size_t place = 0;
  for (std::size_t seen = 0; place < checks.size(); ++place)
    if (checks[place].stated && seen++ == stated) break;
  return place;
}

/// The worst run, whose violation its repetition does not show.
UndecidedRun unconfirmed_run(const Report& report) {
  UndecidedRun undecided;
  undecided.run = report.worst_run;
  for (std::size_t k = 0; k < report.checks.size(); ++k)
    if (report.checks[k].worst.disputed && report.checks[k].worst_run == report.worst_run) {
      undecided.check = k;
      undecided.finding = report.checks[k].worst;
      break;
    }
  return undecided;
}

/// Adds the worst runs that violate when repeated. Whether the worst one does; none where that is not
/// known.
std::optional<bool> confirm_worst(const CampaignPart& part, Report& report) {
  std::vector<std::uint64_t> runs{report.worst_run};
  for (const CheckReport& check : report.checks)
    if (check.violations > 0) runs.push_back(check.worst_run);
  for (const std::uint64_t run : runs) {
    const auto at = std::lower_bound(report.confirmed.begin(), report.confirmed.end(), run);
    if (at != report.confirmed.end() && *at == run) continue;
    const auto known = part.repeats.find(run);
    if (known == part.repeats.end() || !known->second.confirmed) return std::nullopt;
    ++report.repeated;
    if (*known->second.confirmed) report.confirmed.insert(at, run);
  }
  // What the more accurate run does not show is not certain.
  for (CheckReport& check : report.checks) {
    const bool shown =
        std::binary_search(report.confirmed.begin(), report.confirmed.end(), check.worst_run);
    if (check.violations == 0 || shown) continue;
    check.undecided += std::exchange(check.violations, 0);
    check.worst.judgement = claims::Judgement::undecided;
    check.worst.disputed = true;
  }
  return std::binary_search(report.confirmed.begin(), report.confirmed.end(), report.worst_run);
}

/// The counts of the tally, and the events that happened in no run.
void take_counts(const CampaignPart& part, const Tally& tally, Report& report) {
  report.violations = tally.violations;
  report.undecided = tally.undecided;
  report.unfinished = tally.unfinished;
  report.repeated = tally.repeated;
  if (part.facts.many_at_once) report.careful = tally.careful;
  report.open = tally.open;
  report.confirmed = tally.confirmed;
  report.worst_run = tally.worst->run;
  if (tally.first_unfinished) {
    report.unfinished_run = tally.first_unfinished->run;
    report.unfinished_termination = tally.first_unfinished->termination;
    report.unfinished_message = tally.first_unfinished->message;
  }
  for (std::size_t e = 0; e < tally.happened.size(); ++e)
    if (tally.happened[e] == 0 && !part.facts.events[e].empty())
      report.silent_events.push_back(part.facts.events[e]);
}

/// Where the first violation ends the campaign, the runs before it decide: how many they are says as
/// much of the probability as runs whose number was fixed (Bernoulli trials up to the first success).
double probability_bound(const Report& report) {
  const std::uint64_t last = report.ended ? 1 : 0;
  // An undecided run counts as a violation, which keeps the bound valid.
  return statistics::violation_probability_bound(report.violations + report.undecided - last,
                                                 report.runs - last, report.confidence);
}

}  // namespace

/// Verdict: violated when the worst run violates again; held when no run is violated or undecided
/// and all were made; otherwise undecided.
Report conclude(const CampaignPart& part) {
  const CampaignFacts& facts = part.facts;
  Report report;
  report.verdict = model::CampaignVerdict::undecided;
  report.different = facts.different;
  report.asked = facts.asked;
  report.seed = facts.seed;
  report.confidence = facts.confidence;
  report.doubts = facts.doubts;
  report.horizon = facts.horizon;
  report.runs = part.tally.runs;
  report.ended = part.ended();
  if (report.runs == 0) return report;
  Tally tally = part.tally;
  if (facts.many_at_once) take_careful(part, tally);
  take_counts(part, tally, report);
  if (!report.different) report.violation_probability = probability_bound(report);
  report.checks = report_checks(part, tally);
  report.first_undecided = tally.first_undecided;
  if (report.first_undecided)
    report.first_undecided->check = place_of(report.checks, report.first_undecided->check);
  // More runs take no violation back.
  if (report.interrupted() && report.violations == 0) return report;
  const std::optional<bool> confirmed =
      report.violations > 0 ? confirm_worst(part, report) : std::optional(false);
  if (!confirmed) return report;
  if (*confirmed) report.verdict = model::CampaignVerdict::violated;
  for (std::size_t c = 0; *confirmed && c < report.checks.size(); ++c)
    if (report.checks[c].violations > 0 && report.growing.empty())
      report.growing = facts.claims[c].growing;
  if (report.violations > 0 && !*confirmed) {
    report.undecided += std::exchange(report.violations, 0);
    report.first_undecided = unconfirmed_run(report);
  }
  if (report.violations + report.undecided == 0 && !report.interrupted())
    report.verdict = model::CampaignVerdict::held;
  return report;
}

}  // namespace gainsmith::verify
