#include "verify/campaign.h"

#include <algorithm>
#include <limits>
#include <mutex>
#include <optional>
#include <tuple>

#include "base/error.h"
#include "base/parallel.h"
#include "verify/setup.h"
#include "verify/statistics.h"

namespace gainsmith::verify {

namespace {

using hybrid::Termination;

/// The worst of some runs for one claim.
struct ClaimTally {
  std::uint64_t violations = 0;
  std::optional<std::uint64_t> run;
  Finding worst;
};

/// The outcome of some consecutive runs.
struct Tally {
  std::uint64_t violations = 0;
  std::uint64_t unfinished = 0;
  std::optional<std::uint64_t> run;  ///< the worst
  bool violated = false;             ///< of that run
  double score = 0;
  Termination termination = Termination::horizon;
  std::string message;
  std::vector<ClaimTally> claims;
};

bool is_worse(const Tally& a, const Tally& b) {
  const auto key = [](const Tally& tally) {
    return std::tuple(tally.termination != Termination::horizon, tally.violated, tally.score);
  };
  return key(a) > key(b);
}

bool is_worse(const Finding& a, const Finding& b) {
  return std::tuple(a.violated, a.score) > std::tuple(b.violated, b.score);
}

/// Adds the outcome of later runs: of equals the earlier run stays.
void add(const Tally& later, Tally& sum) {
  if (!sum.run) {
    sum = later;
    return;
  }
  const Tally before = sum;
  if (is_worse(later, sum)) sum = later;
  sum.violations = before.violations + later.violations;
  sum.unfinished = before.unfinished + later.unfinished;
  sum.claims = before.claims;
  for (std::size_t i = 0; i < sum.claims.size(); ++i) {
    ClaimTally& claim = sum.claims[i];
    const std::uint64_t violations = claim.violations + later.claims[i].violations;
    if (is_worse(later.claims[i].worst, claim.worst)) claim = later.claims[i];
    claim.violations = violations;
  }
}

Tally judge(std::uint64_t run, const hybrid::Arc& arc, std::vector<ClaimCheck>& checks) {
  Tally tally;
  tally.run = run;
  tally.termination = arc.termination;
  tally.message = arc.message;
  tally.unfinished = arc.termination == Termination::horizon ? 0 : 1;
  tally.violated = tally.unfinished > 0;
  tally.score = -std::numeric_limits<double>::infinity();
  for (ClaimCheck& check : checks) {
    const Finding finding = check(arc);
    tally.violated = tally.violated || finding.violated;
    tally.claims.push_back({finding.violated ? 1U : 0U, run, finding});
  }
  for (const ClaimTally& claim : tally.claims)
    if (claim.worst.violated || !tally.violated)
      tally.score = std::max(tally.score, claim.worst.score);
  tally.violations = tally.violated ? 1 : 0;
  return tally;
}

/// Runs first, first + 1, ..., last - 1.
Tally judge_runs(const Setup& setup, std::uint64_t seed, std::uint64_t first, std::uint64_t last) {
  hybrid::Simulator simulator(setup.system, setup.scenario, setup.steps);
  std::vector<ClaimCheck> checks = make_checks(setup);
  Tally sum;
  for (std::uint64_t run = first; run < last; ++run)
    add(judge(run, simulator.run(seed, run), checks), sum);
  return sum;
}

/// All runs, in blocks that are handed to the threads and added up in order.
Tally judge_all(const Setup& setup, std::uint64_t seed, std::uint64_t runs,
                const CampaignOptions& options) {
  constexpr std::uint64_t kBlock = 64;
  std::vector<Tally> blocks((runs + kBlock - 1) / kBlock);
  std::mutex mutex;
  std::uint64_t done = 0;
  parallel_for(blocks.size(), options.threads, [&](std::size_t block) {
    const std::uint64_t first = block * kBlock;
    const std::uint64_t last = std::min(runs, first + kBlock);
    blocks[block] = judge_runs(setup, seed, first, last);
    if (!options.progress) return;
    const std::lock_guard lock(mutex);
    done += last - first;
    options.progress(done, runs);
  });
  Tally sum;
  for (const Tally& block : blocks) add(block, sum);
  return sum;
}

std::vector<CheckReport> report_checks(const Setup& setup, const Tally& tally) {
  std::vector<CheckReport> reports;
  std::size_t next = 0;
  for (const LinkedClaim& claim : setup.claims) {
    CheckReport report{claim.name, claim.kind, claim.stated(), claim.missing, 0, 0, {}};
    if (claim.stated()) {
      const ClaimTally& found = tally.claims[next++];
      report.violations = found.violations;
      report.worst_run = *found.run;
      report.worst = found.worst;
    }
    reports.push_back(std::move(report));
  }
  return reports;
}

void require_a_claim(const model::Design& design, const std::vector<LinkedClaim>& claims) {
  const Place place{design.method_file, 0, 0};
  if (claims.empty())
    throw InputError(place, "the method makes no claims, so there is nothing to verify");
  for (const LinkedClaim& claim : claims)
    if (claim.stated()) return;
  throw InputError(place, "no claim can be checked: there is no value for " +
                              claims.front().missing.front() + ", which '" + claims.front().name +
                              "' needs");
}

}  // namespace

Report run_campaign(const model::Instance& instance, const model::Gains& gains,
                    const CampaignOptions& options) {
  const model::Design& design = *instance.design;
  const Setup setup = make_setup(instance, gains);
  require_a_claim(design, setup.claims);
  Report report;
  report.runs = options.runs.value_or(design.campaign.runs);
  report.seed = options.seed.value_or(design.campaign.seed);
  if (report.runs == 0)
    throw InputError(design.campaign.place, "a campaign needs at least one run");

  const Tally tally = judge_all(setup, report.seed, report.runs, options);
  report.verdict =
      tally.violations > 0 ? model::CampaignVerdict::violated : model::CampaignVerdict::held;
  report.violations = tally.violations;
  report.unfinished = tally.unfinished;
  report.worst_run = *tally.run;
  report.worst_termination = tally.termination;
  report.worst_message = tally.message;
  report.horizon = setup.scenario.horizon;
  report.violation_probability =
      violation_probability_bound(report.violations, report.runs, report.confidence);
  report.checks = report_checks(setup, tally);
  return report;
}

}  // namespace gainsmith::verify
