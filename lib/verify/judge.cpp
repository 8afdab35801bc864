#include "verify/judge.h"

#include <algorithm>
#include <utility>

namespace gainsmith::verify {

namespace {

using bounded::Termination;
using Rounding = bounded::ClockedSimulator::Rounding;

/// Whether the run left the range of the states for certain.
template <class Scalar>
bool is_certain_end(const bounded::Track<Scalar>& track) {
  if (track.termination == Termination::lost) return false;
  if (track.termination != Termination::diverged) return true;
  const std::size_t last = track.samples() - 1;
  for (Eigen::Index i = 0; i < track.size; ++i) {
    const double size = bounded::size_of(track.state(last)(i));
    if (size > hybrid::kLargestState && track.bound(last)(i) <= size / 2) return true;
  }
  return false;
}

claims::Judgement worst_of(const std::vector<claims::Finding>& findings) {
  const auto any = [&](claims::Judgement judgement) {
    return std::any_of(findings.begin(), findings.end(),
                       [&](const claims::Finding& one) { return one.judgement == judgement; });
  };
  if (any(claims::Judgement::violated)) return claims::Judgement::violated;
  return any(claims::Judgement::undecided) ? claims::Judgement::undecided : claims::Judgement::held;
}

template <class Scalar>
RunVerdict verdict_on(const bounded::Track<Scalar>& track,
                      std::vector<claims::ClaimCheck<Scalar>>& checks) {
  RunVerdict verdict;
  verdict.termination = track.termination;
  verdict.message = track.message;
  for (claims::ClaimCheck<Scalar>& check : checks) verdict.findings.push_back(check(track));
  verdict.judgement = worst_of(verdict.findings);
  return verdict;
}

/// Of a run that ends before its horizon a claim that holds so far is left open.
template <class Scalar>
void leave_open(const bounded::Track<Scalar>& track, claims::Judgement open,
                claims::Finding& finding) {
  if (finding.violated() || (finding.undecided() && open == claims::Judgement::undecided)) return;
  finding.judgement = open;
  finding.ended = true;
  finding.t = track.t.back();
  finding.j = track.j.back();
}

/// The verdict on a run that is not repeated again.
template <class Scalar>
RunVerdict last_verdict(const bounded::Track<Scalar>& track,
                        std::vector<claims::ClaimCheck<Scalar>>& checks) {
  RunVerdict verdict = verdict_on(track, checks);
  verdict.repeated = true;
  if (verdict.unfinished()) {
    const claims::Judgement open =
        is_certain_end(track) ? claims::Judgement::violated : claims::Judgement::undecided;
    for (claims::Finding& finding : verdict.findings) leave_open(track, open, finding);
    if (verdict.judgement != claims::Judgement::violated) verdict.judgement = open;
  }
  verdict.confirmed = verdict.judgement == claims::Judgement::violated;
  return verdict;
}

/// What both runs say; undecided where they differ.
RunVerdict agreed(RunVerdict one, const RunVerdict& other) {
  for (std::size_t i = 0; i < one.findings.size(); ++i)
    if (one.findings[i].judgement != other.findings[i].judgement) {
      one.findings[i].judgement = claims::Judgement::undecided;
      one.findings[i].disputed = true;
    }
  if (one.judgement != other.judgement) one.judgement = claims::Judgement::undecided;
  one.confirmed = one.judgement == claims::Judgement::violated;
  return one;
}

/// A run repeated: what of it was decided before stays so.
RunVerdict with_decided(const RunVerdict& before, RunVerdict again) {
  if (before.unfinished()) return again;
  for (std::size_t i = 0; i < again.findings.size(); ++i)
    if (!before.findings[i].undecided()) again.findings[i] = before.findings[i];
  if (!again.unfinished()) again.judgement = worst_of(again.findings);
  return again;
}

}  // namespace

Judge::Judge(const Setup& setup) : event_count_(setup.events->system.dynamics.events.size()) {
  if (!setup.sampled) {
    events_.emplace(setup.judged());
    checks_ = make_checks(setup.judged().judged, *setup.judged().narrow);
    return;
  }
  const SampledSetup& sampled = *setup.sampled;
  checks_ = make_checks(sampled.judged, *sampled.narrow);
  if (!sampled.steps) {
    clocked_.emplace(*sampled.system, setup.events->scenario, sampled.coordinates, *sampled.flows);
    return;
  }
  narrow_.emplace(*sampled.system, setup.events->scenario, *sampled.steps, *sampled.narrow);
  wide_.emplace(*sampled.system, setup.events->scenario, *sampled.steps, *sampled.wide);
  wide_checks_ = make_checks(sampled.judged, *sampled.wide);
}

const bounded::Track<double>& Judge::track(std::uint64_t seed, std::uint64_t run) {
  if (events_) return events_->run(seed, run, 1);
  return clocked_ ? clocked_->run(seed, run, kAccuracyOfMany) : narrow_->run(seed, run);
}

RunVerdict Judge::confirm(std::uint64_t seed, std::uint64_t run) {
  if (events_) {
    constexpr double sharper = kAccuracyOfOne / kAccuracyOfMany;
    RunVerdict verdict = last_verdict(noted(events_->run(seed, run, sharper)), checks_);
    if (verdict.judgement != claims::Judgement::undecided ||
        !events_->can_decide_more(sharper * sharper))
      return verdict;
    return with_decided(verdict,
                        last_verdict(noted(events_->run(seed, run, sharper * sharper)), checks_));
  }
  if (!clocked_) return last_verdict(noted(wide_->run(seed, run)), wide_checks_);
  const auto rounded = [&](Rounding rounding) {
    return last_verdict(noted(clocked_->run(seed, run, kAccuracyOfOne, rounding)), checks_);
  };
  return agreed(rounded(Rounding::up), rounded(Rounding::down));
}

RunVerdict Judge::operator()(std::uint64_t seed, std::uint64_t run) {
  happened_.assign(event_count_, 0);
  RunVerdict verdict = verdict_on(noted(track(seed, run)), checks_);
  const bool open = std::any_of(verdict.findings.begin(), verdict.findings.end(),
                                [](const claims::Finding& one) { return one.undecided(); });
  // A run that is repeated may go on where it ended before.
  if (open || verdict.unfinished()) verdict = with_decided(verdict, confirm(seed, run));
  verdict.happened = happened_;
  return verdict;
}

}  // namespace gainsmith::verify
