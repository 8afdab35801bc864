#include "verify/tally.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace gainsmith::verify {

namespace {

using claims::Termination;

/// violated 2, undecided 1, held 0.
int rank_of(claims::Judgement judgement) {
  return judgement == claims::Judgement::violated    ? 2
         : judgement == claims::Judgement::undecided ? 1
                                                     : 0;
}

// A total order: what is violated for certain is worse than a run that is lost, which is worse than
// any other. Of equals the earlier run is worse.

bool is_worse(const WorstRun& a, const WorstRun& b) {
  const auto key = [](const WorstRun& worst) {
    return std::tuple(worst.judgement == claims::Judgement::violated,
                      worst.termination != Termination::horizon, rank_of(worst.judgement),
                      worst.score);
  };
  if (key(a) != key(b)) return key(a) > key(b);
  return a.run < b.run;
}

bool is_worse(const ClaimTally& a, const ClaimTally& b) {
  const auto key = [](const ClaimTally& tally) {
    return std::tuple(rank_of(tally.worst.judgement), tally.worst.score);
  };
  if (key(a) != key(b)) return key(a) > key(b);
  return a.run < b.run;
}

/// Sums of counts, the larger floor, the worse run.
void add_claim(const ClaimTally& more, ClaimTally& sum) {
  sum.violations += more.violations;
  sum.undecided += more.undecided;
  sum.floor = std::max(sum.floor, more.floor);
  if (!is_worse(more, sum)) return;
  sum.run = more.run;
  sum.worst = more.worst;
}

/// The one with the lower number.
template <class Run>
void keep_first(const std::optional<Run>& more, std::optional<Run>& first) {
  if (more && (!first || more->run < first->run)) first = more;
}

/// Mostly `more` comes last, or nearly so.
void merge_sorted(const std::vector<std::uint64_t>& more, std::vector<std::uint64_t>& sum) {
  if (more.empty()) return;
  const auto middle = static_cast<std::ptrdiff_t>(sum.size());
  sum.insert(sum.end(), more.begin(), more.end());
  const auto later = std::upper_bound(sum.begin(), sum.begin() + middle, more.front());
  std::inplace_merge(later, sum.begin() + middle, sum.end());
}

}  // namespace

/// The first undecided claim, if any.
UndecidedRun undecided_run(std::uint64_t run, Termination termination, const std::string& message,
                           const std::vector<claims::Finding>& findings) {
  UndecidedRun undecided{run, termination, message, 0, {}};
  const auto finding = std::ranges::find_if(findings, &claims::Finding::undecided);
  if (finding == findings.end()) return undecided;
  undecided.check = static_cast<std::size_t>(finding - findings.begin());
  undecided.finding = *finding;
  return undecided;
}

/// Counts of 0 or 1, and the run as the worst of itself.
Tally tally_of(std::uint64_t run, const RunVerdict& verdict) {
  Tally tally;
  tally.runs = 1;
  tally.violations = verdict.judgement == claims::Judgement::violated ? 1 : 0;
  tally.undecided = verdict.judgement == claims::Judgement::undecided ? 1 : 0;
  if (verdict.unfinished()) {
    tally.unfinished = 1;
    tally.first_unfinished = {run, verdict.termination, verdict.message};
  }
  if (tally.undecided > 0)
    tally.first_undecided =
        undecided_run(run, verdict.termination, verdict.message, verdict.findings);
  tally.repeated = verdict.repeated ? 1 : 0;
  tally.happened = verdict.happened;
  if (verdict.confirmed) tally.confirmed.push_back(run);
  double score = -std::numeric_limits<double>::infinity();
  for (const claims::Finding& finding : verdict.findings) {
    tally.claims.push_back(
        {finding.violated() ? 1U : 0U, finding.undecided() ? 1U : 0U, run, finding, finding.floor});
    if (finding.violated() || verdict.judgement != claims::Judgement::violated)
      score = std::max(score, finding.score);
  }
  tally.worst = {run, verdict.judgement, score, verdict.termination};
  return tally;
}

void add(const Tally& more, Tally& sum) {
  if (more.runs == 0) return;
  if (sum.runs == 0) {
    sum = more;
    return;
  }
  sum.runs += more.runs;
  sum.violations += more.violations;
  sum.undecided += more.undecided;
  sum.unfinished += more.unfinished;
  sum.repeated += more.repeated;
  sum.careful += more.careful;
  for (std::size_t k = 0; k < sum.open.size(); ++k) sum.open[k] += more.open[k];
  merge_sorted(more.confirmed, sum.confirmed);
  if (is_worse(*more.worst, *sum.worst)) sum.worst = more.worst;
  keep_first(more.first_unfinished, sum.first_unfinished);
  keep_first(more.first_undecided, sum.first_undecided);
  for (std::size_t i = 0; i < sum.claims.size(); ++i) add_claim(more.claims[i], sum.claims[i]);
  for (std::size_t e = 0; e < sum.happened.size(); ++e)
    sum.happened[e] = sum.happened[e] != 0 || more.happened[e] != 0 ? 1 : 0;
}

}  // namespace gainsmith::verify
