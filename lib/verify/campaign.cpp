#include "verify/campaign.h"

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "base/stop.h"
#include "hybrid/idle.h"
#include "verify/pack_judge.h"
#include "verify/statistics.h"

namespace gainsmith::verify {

namespace {

using bounded::Termination;

/// The worst of some runs for one claim.
struct ClaimTally {
  std::uint64_t violations = 0;
  std::uint64_t undecided = 0;
  std::optional<std::uint64_t> run;
  claims::Finding worst;
  double floor = 0;
};

/// The outcome of some consecutive runs.
struct Tally {
  std::uint64_t runs = 0;
  std::uint64_t violations = 0;
  std::uint64_t undecided = 0;
  std::uint64_t unfinished = 0;
  std::uint64_t repeated = 0;
  std::uint64_t careful = 0;
  std::array<std::uint64_t, packs::kWhys> open{};
  std::vector<std::uint64_t> confirmed;
  std::optional<std::uint64_t> run;  ///< the worst
  claims::Judgement judgement = claims::Judgement::held;
  double score = 0;
  Termination termination = Termination::horizon;
  std::uint64_t unfinished_run = 0;  ///< the first
  Termination unfinished_termination = Termination::horizon;
  std::string unfinished_message;
  std::optional<UndecidedRun> first_undecided;
  std::vector<ClaimTally> claims;
  std::vector<char> happened;  ///< by event: whether it did in any of them
};

int rank_of(claims::Judgement judgement) {
  return judgement == claims::Judgement::violated    ? 2
         : judgement == claims::Judgement::undecided ? 1
                                                     : 0;
}

/// What is violated for certain is worse than a run that is lost, which is worse than any other.
bool is_worse(const Tally& a, const Tally& b) {
  const auto key = [](const Tally& tally) {
    return std::tuple(tally.judgement == claims::Judgement::violated,
                      tally.termination != Termination::horizon, rank_of(tally.judgement),
                      tally.score);
  };
  return key(a) > key(b);
}

bool is_worse(const claims::Finding& a, const claims::Finding& b) {
  return std::tuple(rank_of(a.judgement), a.score) > std::tuple(rank_of(b.judgement), b.score);
}

void add(const ClaimTally& later, ClaimTally& sum) {
  sum.violations += later.violations;
  sum.undecided += later.undecided;
  sum.floor = std::max(sum.floor, later.floor);
  if (!is_worse(later.worst, sum.worst)) return;
  sum.run = later.run;
  sum.worst = later.worst;
}

/// Adds the outcome of later runs: of equals the earlier run stays.
void add(const Tally& later, Tally& sum) {
  if (!later.run) return;
  if (!sum.run) {
    sum = later;
    return;
  }
  if (is_worse(later, sum)) {
    sum.run = later.run;
    sum.judgement = later.judgement;
    sum.score = later.score;
    sum.termination = later.termination;
  }
  if (sum.unfinished == 0 && later.unfinished > 0) {
    sum.unfinished_run = later.unfinished_run;
    sum.unfinished_termination = later.unfinished_termination;
    sum.unfinished_message = later.unfinished_message;
  }
  sum.runs += later.runs;
  sum.violations += later.violations;
  sum.undecided += later.undecided;
  sum.unfinished += later.unfinished;
  sum.repeated += later.repeated;
  sum.careful += later.careful;
  for (std::size_t k = 0; k < sum.open.size(); ++k) sum.open[k] += later.open[k];
  if (!sum.first_undecided) sum.first_undecided = later.first_undecided;
  for (std::size_t e = 0; e < sum.happened.size(); ++e)
    sum.happened[e] = sum.happened[e] != 0 || later.happened[e] != 0 ? 1 : 0;
  for (std::size_t i = 0; i < sum.claims.size(); ++i) add(later.claims[i], sum.claims[i]);
  sum.confirmed.insert(sum.confirmed.end(), later.confirmed.begin(), later.confirmed.end());
}

/// Its claim is counted among those that are stated.
UndecidedRun undecided_run(std::uint64_t run, const RunVerdict& verdict) {
  UndecidedRun undecided{run, verdict.termination, verdict.message, 0, {}};
  const auto finding = std::find_if(verdict.findings.begin(), verdict.findings.end(),
                                    [](const claims::Finding& one) { return one.undecided(); });
  if (finding == verdict.findings.end()) return undecided;
  undecided.check = static_cast<std::size_t>(finding - verdict.findings.begin());
  undecided.finding = *finding;
  return undecided;
}

Tally tally_of(std::uint64_t run, const RunVerdict& verdict) {
  Tally tally;
  tally.run = run;
  tally.runs = 1;
  tally.judgement = verdict.judgement;
  tally.termination = verdict.termination;
  tally.unfinished_run = run;
  tally.unfinished_termination = verdict.termination;
  tally.unfinished_message = verdict.message;
  tally.violations = verdict.judgement == claims::Judgement::violated ? 1 : 0;
  tally.undecided = verdict.judgement == claims::Judgement::undecided ? 1 : 0;
  tally.unfinished = verdict.unfinished() ? 1 : 0;
  if (tally.undecided > 0) tally.first_undecided = undecided_run(run, verdict);
  tally.repeated = verdict.repeated ? 1 : 0;
  tally.happened = verdict.happened;
  if (verdict.confirmed) tally.confirmed.push_back(run);
  tally.score = -std::numeric_limits<double>::infinity();
  for (const claims::Finding& finding : verdict.findings) {
    tally.claims.push_back(
        {finding.violated() ? 1U : 0U, finding.undecided() ? 1U : 0U, run, finding, finding.floor});
    if (finding.violated() || verdict.judgement != claims::Judgement::violated)
      tally.score = std::max(tally.score, finding.score);
  }
  return tally;
}

/// Runs first, first + 1, ..., last - 1, or those until the campaign is stopped.
Tally judge_runs(const Setup& setup, const Packs* packs, std::uint64_t seed, std::uint64_t first,
                 std::uint64_t last) {
  PackJudge judge(setup, packs);
  Tally sum;
  try {
    judge.begin(seed, first, last);
    for (std::uint64_t run = first; run < last; ++run) {
      check_stop();
      const CampaignVerdictOnRun made = judge(run);
      if (made.careful && !setup.sampled) check_stop();  // perhaps amid the run
      Tally tally = tally_of(run, made.verdict);
      tally.careful = made.careful ? 1 : 0;
      if (made.why) tally.open[static_cast<std::size_t>(*made.why)] = 1;
      add(tally, sum);
      Doing::step();
    }
  } catch (const Stopped&) {
    // Those that are done count.
  }
  return sum;
}

/// All runs, in blocks that are handed to the threads and added up in order; those runs that
/// are done when the campaign is stopped. Packs go on where they decide most of the first block.
Tally judge_all(const Setup& setup, const Packs* packs, std::uint64_t seed, std::uint64_t runs,
                const CampaignOptions& options) {
  constexpr std::uint64_t first_size = 64;
  const Doing doing("runs", runs);
  const std::uint64_t begun = packs != nullptr ? std::min(runs, first_size) : 0;
  Tally sum;
  if (begun > 0) sum = judge_runs(setup, packs, seed, 0, begun);
  if (2 * sum.careful > begun) packs = nullptr;
  const auto work_between = [&] {
    if (options.between && sum.runs > 0) options.between(sum.runs);
  };
  work_between();
  // Linear packs put runs of one law together.
  const std::uint64_t block_size = packs == nullptr ? 64 : packs->linear ? 2048 : 256;
  constexpr std::uint64_t most_blocks = 4096;  // at once, so that memory does not grow with runs
  const bool grows = options.between && packs == nullptr;
  std::uint64_t at_once = grows ? 1 : most_blocks;
  for (std::uint64_t from = begun; from < runs;) {
    const std::uint64_t to = std::min(runs, from + at_once * block_size);
    std::vector<Tally> blocks((to - from + block_size - 1) / block_size);
    try {
      parallel_for(blocks.size(), options.threads, [&](std::size_t block) {
        const std::uint64_t first = from + block * block_size;
        blocks[block] = judge_runs(setup, packs, seed, first, std::min(to, first + block_size));
      });
    } catch (const Stopped&) {
      // Blocks that were not begun are empty.
    }
    for (const Tally& block : blocks) add(block, sum);
    if (sum.runs < to) break;
    from = to;
    if (!grows || from == runs) continue;
    work_between();
    at_once = std::min(most_blocks, 2 * at_once);
  }
  return sum;
}

/// The worst run of each claim as the careful run finds it: packs say only a verdict and a score.
/// What is not certain to the careful run is undecided.
void repeat_worst(const Setup& setup, std::uint64_t seed, Tally& tally) {
  std::map<std::uint64_t, RunVerdict> again;
  std::set<std::uint64_t> opened;
  PackJudge judge(setup, nullptr);
  for (std::size_t c = 0; c < tally.claims.size(); ++c) {
    ClaimTally& claim = tally.claims[c];
    const auto [known, fresh] = again.try_emplace(*claim.run);
    if (fresh) known->second = judge.careful(seed, *claim.run);
    const claims::Finding& found = known->second.findings[c];
    require_agreement(*claim.run, claim.worst.judgement, found.judgement);
    if (found.undecided() && !claim.worst.undecided()) {
      const bool violated = claim.worst.violated();
      if (violated) --claim.violations;
      ++claim.undecided;
      if (opened.insert(*claim.run).second) {
        if (violated) --tally.violations;
        ++tally.undecided;
        const auto& before = tally.first_undecided;
        if (!before || *claim.run < before->run)
          tally.first_undecided = undecided_run(*claim.run, known->second);
      }
    }
    claim.worst = found;
  }
}

std::vector<CheckReport> report_checks(const Setup& setup, const Tally& tally) {
  std::vector<CheckReport> reports;
  std::size_t next = 0;
  for (const claims::Claim& claim : setup.claims()) {
    CheckReport report{claim.name, claim.kind, claim.stated(), claim.missing, 0, 0, 0, {}, 0};
    if (claim.stated()) {
      const ClaimTally& found = tally.claims[next++];
      report.violations = found.violations;
      report.undecided = found.undecided;
      report.floor = found.floor;
      report.worst_run = *found.run;
      report.worst = found.worst;
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

/// Repeats the worst runs and adds those that violate again. Whether the worst one does.
bool confirm_worst(const Setup& setup, std::uint64_t seed, Report& report) {
  std::vector<std::uint64_t> runs{report.worst_run};
  for (const CheckReport& check : report.checks)
    if (check.violations > 0) runs.push_back(check.worst_run);
  Judge judge(setup);
  for (const std::uint64_t run : runs) {
    const auto at = std::lower_bound(report.confirmed.begin(), report.confirmed.end(), run);
    if (at != report.confirmed.end() && *at == run) continue;
    ++report.repeated;
    if (judge.confirm(seed, run).confirmed) report.confirmed.insert(at, run);
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

void require_a_claim(const Place& place, const std::vector<claims::Claim>& claims) {
  if (claims.empty())
    throw InputError(place, "the method makes no claims, so there is nothing to verify");
  for (const claims::Claim& claim : claims)
    if (claim.stated()) return;
  throw InputError(place, "no claim can be checked: there is no value for " +
                              claims.front().missing.front() + ", which '" + claims.front().name +
                              "' needs");
}

}  // namespace

Report run_campaign(const Setup& setup, const CampaignOptions& options) {
  const model::RunTexts& texts = setup.events->texts;
  require_a_claim(texts.method, setup.claims());
  Report report;
  report.different = hybrid::different_runs(setup.events->system, setup.events->scenario);
  report.asked = options.runs.value_or(texts.campaign.runs);
  if (report.different) report.asked = std::min(report.asked, *report.different);
  report.seed = options.seed.value_or(texts.campaign.seed);
  if (report.asked == 0)
    throw InputError(texts.campaign.place, "a campaign needs at least one run");

  report.confidence = options.confidence;
  report.idle_observers = hybrid::idle_observers(setup.events->system.dynamics);
  const Packs packs = make_packs(setup, report.asked);
  Tally tally = judge_all(setup, packs ? &packs : nullptr, report.seed, report.asked, options);
  report.runs = tally.runs;
  report.horizon = setup.horizon();
  report.integrated = setup.integrated();
  report.verdict = model::CampaignVerdict::undecided;
  if (!tally.run) return report;
  if (packs) {
    const Concluding concluding;
    repeat_worst(setup, report.seed, tally);
  }
  report.violations = tally.violations;
  report.undecided = tally.undecided;
  report.unfinished = tally.unfinished;
  report.repeated = tally.repeated;
  if (packs) report.careful = tally.careful;
  report.open = tally.open;
  report.confirmed = tally.confirmed;
  report.worst_run = *tally.run;
  report.unfinished_run = tally.unfinished_run;
  report.unfinished_termination = tally.unfinished_termination;
  report.unfinished_message = tally.unfinished_message;
  if (!report.different)
    report.violation_probability = violation_probability_bound(report.violations + report.undecided,
                                                               report.runs, report.confidence);
  for (std::size_t e = 0; e < tally.happened.size(); ++e)
    if (tally.happened[e] == 0)
      report.silent_events.push_back(setup.events->system.dynamics.events[e].name);
  report.checks = report_checks(setup, tally);
  report.first_undecided = tally.first_undecided;
  if (report.first_undecided)
    report.first_undecided->check = place_of(report.checks, report.first_undecided->check);
  if (report.interrupted()) return report;
  bool confirmed = false;
  try {
    confirmed = report.violations > 0 && confirm_worst(setup, report.seed, report);
  } catch (const Stopped&) {
    return report;
  }
  if (confirmed) report.verdict = model::CampaignVerdict::violated;
  if (report.violations > 0 && !confirmed) {
    report.undecided += std::exchange(report.violations, 0);
    report.first_undecided = unconfirmed_run(report);
  }
  if (report.violations + report.undecided == 0) report.verdict = model::CampaignVerdict::held;
  return report;
}

}  // namespace gainsmith::verify
