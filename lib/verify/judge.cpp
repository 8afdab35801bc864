#include "verify/judge.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "verify/tolerances.h"

namespace gainsmith::verify {

namespace {

using claims::ClaimCheck;
using claims::Termination;
using claims::Track;

/// violated before undecided before held.
claims::Judgement worst_of(const std::vector<claims::Finding>& findings) {
  const auto any = [&](claims::Judgement judgement) {
    return std::ranges::count(findings, judgement, &claims::Finding::judgement) > 0;
  };
  if (any(claims::Judgement::violated)) return claims::Judgement::violated;
  return any(claims::Judgement::undecided) ? claims::Judgement::undecided : claims::Judgement::held;
}

RunVerdict verdict_on(const Track& track, const std::vector<ClaimCheck>& checks) {
  RunVerdict verdict;
  verdict.termination = track.termination;
  verdict.message = track.message;
  for (const ClaimCheck& check : checks) verdict.findings.push_back(check(track));
  verdict.judgement = worst_of(verdict.findings);
  return verdict;
}

/// Of a run that ends before its horizon a claim that holds so far is left open.
void leave_open(const Track& track, claims::Judgement open, claims::Finding& finding) {
  if (finding.violated() || (finding.undecided() && open == claims::Judgement::undecided)) return;
  finding.judgement = open;
  finding.ended = true;
  finding.t = track.t.back();
  finding.j = track.j.back();
}

/// The verdict on a run that is not repeated again.
RunVerdict last_verdict(const Track& track, const std::vector<ClaimCheck>& checks) {
  RunVerdict verdict = verdict_on(track, checks);
  verdict.repeated = true;
  if (verdict.unfinished()) {
    const claims::Judgement open = track.termination == Termination::lost
                                       ? claims::Judgement::undecided
                                       : claims::Judgement::violated;
    for (claims::Finding& finding : verdict.findings) leave_open(track, open, finding);
    if (verdict.judgement != claims::Judgement::violated) verdict.judgement = open;
  }
  verdict.confirmed = verdict.judgement == claims::Judgement::violated;
  return verdict;
}

/// A run repeated: what of it was decided before stays so, and as far as it went if it says the same.
RunVerdict with_decided(const RunVerdict& before, RunVerdict again) {
  if (before.unfinished()) return again;
  for (std::size_t i = 0; i < again.findings.size(); ++i)
    if (!before.findings[i].undecided() &&
        before.findings[i].judgement != again.findings[i].judgement)
      again.findings[i] = before.findings[i];
  if (!again.unfinished()) again.judgement = worst_of(again.findings);
  return again;
}

constexpr double kSharper = claims::kAccuracyOfOne / claims::kAccuracyOfMany;

/// Undecided, or violated by so little that it may be rounding; not where the run breaks off, which
/// violates each claim.
bool is_open(const RunVerdict& verdict, const claims::Finding& finding) {
  if (finding.undecided()) return true;
  return finding.violated() && verdict.termination != Termination::broken_off &&
         std::abs(finding.value - finding.bound) <= kDoubtful * finding.rounding;
}

}  // namespace

Judge::Judge(const Setup& setup)
    : event_count_(setup.events->system.dynamics.events.size()), tracks_(setup.judged()) {
  for (const claims::JudgedClaim& claim : setup.judged().judged) checks_.emplace_back(claim);
}

/// A track whose events are noted.
const Track& Judge::noted(const Track& track) {
  track_ = &track;
  happened_.resize(event_count_, 0);
  for (const claims::Move& move : track_->moves)
    if (move.jump) happened_[move.event] = 1;
  return *track_;
}

RunVerdict Judge::sharper(std::uint64_t seed, std::uint64_t run) {
  return last_verdict(noted(tracks_.run(seed, run, kSharper, 1)), checks_);
}

RunVerdict Judge::confirm(std::uint64_t seed, std::uint64_t run) {
  RunVerdict verdict = sharper(seed, run);
  decide(seed, run, true, verdict);
  return verdict;
}

void Judge::take_held(const std::vector<bool>& holds, RunVerdict& verdict) const {
  if (verdict.unfinished()) return;
  for (std::size_t c = 0; c < holds.size(); ++c)
    if (holds[c] && verdict.findings[c].undecided())
      verdict.findings[c] = checks_[c](*track_, true);
  verdict.judgement = worst_of(verdict.findings);
}

void Judge::decide(std::uint64_t seed, std::uint64_t run, bool in_31_digits, RunVerdict& verdict) {
  const auto is_open_one = [&](const claims::Finding& finding) {
    return is_open(verdict, finding);
  };
  if (std::ranges::none_of(verdict.findings, is_open_one)) return;
  std::optional<RunVerdict> again;
  const auto take = [&](const Track& track) {
    RunVerdict made = last_verdict(noted(track), checks_);
    if (made.termination != Termination::lost) again = std::move(made);
  };
  if (in_31_digits && tracks_.can_decide_in_31_digits()) take(tracks_.run_in_31_digits(seed, run));
  const bool is_known = again.has_value();
  if (!is_known && tracks_.is_integrated()) take(tracks_.run(seed, run, kSharper * kSharper, 1));
  for (std::size_t i = 0; i < verdict.findings.size(); ++i) {
    claims::Finding& finding = verdict.findings[i];
    const bool was_violated = finding.violated();
    const bool is_confirmed = is_known && was_violated && again->findings[i].violated();
    if (!is_open_one(finding) || is_confirmed) continue;
    if (again && (is_known || !was_violated)) finding = again->findings[i];
    if (was_violated && (!is_known || finding.undecided())) {
      finding.judgement = claims::Judgement::undecided;
      finding.disputed = true;
    }
  }
  if (again) {
    verdict.termination = again->termination;
    verdict.message = again->message;
  }
  if (again || !verdict.unfinished()) verdict.judgement = worst_of(verdict.findings);
  verdict.confirmed = verdict.judgement == claims::Judgement::violated;
}

RunVerdict Judge::operator()(std::uint64_t seed, std::uint64_t run,
                             const std::vector<bool>& holds) {
  happened_.assign(event_count_, 0);
  RunVerdict verdict = verdict_on(noted(tracks_.run(seed, run, 1)), checks_);
  take_held(holds, verdict);
  const bool open = std::ranges::any_of(verdict.findings, &claims::Finding::undecided);
  // A run that is repeated may go on where it ended before.
  if (open || verdict.unfinished()) {
    verdict = with_decided(verdict, sharper(seed, run));
    take_held(holds, verdict);
  }
  decide(seed, run, run < kIn31Digits, verdict);
  verdict.happened = happened_;
  return verdict;
}

}  // namespace gainsmith::verify
