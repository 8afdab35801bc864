#include "verify/judge.h"

#include <algorithm>

namespace gainsmith::verify {

namespace {

using hybrid::Termination;

/// Whether the run left the range of the states for certain.
bool is_certain_end(const hybrid::Track<DoubleDouble>& track) {
  if (track.termination != Termination::diverged) return true;
  const std::size_t last = track.samples() - 1;
  for (Eigen::Index i = 0; i < track.size; ++i) {
    const double size = hybrid::size_of(track.state(last)(i));
    if (size > 1e150 && track.bound(last)(i) <= size / 2) return true;
  }
  return false;
}

Judgement worst_of(const std::vector<Finding>& findings) {
  const auto any = [&](Judgement judgement) {
    return std::any_of(findings.begin(), findings.end(),
                       [&](const Finding& one) { return one.judgement == judgement; });
  };
  if (any(Judgement::violated)) return Judgement::violated;
  return any(Judgement::undecided) ? Judgement::undecided : Judgement::held;
}

}  // namespace

Judge::Judge(const Setup& setup)
    : narrow_(setup.system, setup.scenario, setup.steps, *setup.narrow),
      wide_(setup.system, setup.scenario, setup.steps, *setup.wide),
      checks_(make_checks(setup, *setup.narrow)),
      wide_checks_(make_checks(setup, *setup.wide)) {}

RunVerdict Judge::confirm(std::uint64_t seed, std::uint64_t run) {
  const hybrid::Track<DoubleDouble>& track = wide_.run(seed, run);
  RunVerdict verdict;
  verdict.repeated = true;
  verdict.termination = track.termination;
  verdict.message = track.message;
  for (ClaimCheck<DoubleDouble>& check : wide_checks_) verdict.findings.push_back(check(track));
  verdict.judgement = worst_of(verdict.findings);
  if (verdict.unfinished() && verdict.judgement != Judgement::violated)
    verdict.judgement = is_certain_end(track) ? Judgement::violated : Judgement::undecided;
  verdict.confirmed = verdict.judgement == Judgement::violated;
  return verdict;
}

RunVerdict Judge::operator()(std::uint64_t seed, std::uint64_t run) {
  const hybrid::Track<double>& track = narrow_.run(seed, run);
  if (track.termination != Termination::horizon) return confirm(seed, run);
  RunVerdict verdict;
  for (ClaimCheck<double>& check : checks_) verdict.findings.push_back(check(track));
  verdict.judgement = worst_of(verdict.findings);
  const bool open = std::any_of(verdict.findings.begin(), verdict.findings.end(),
                                [](const Finding& one) { return one.undecided(); });
  if (!open) return verdict;
  RunVerdict wide = confirm(seed, run);
  for (std::size_t i = 0; i < wide.findings.size(); ++i)
    if (!verdict.findings[i].undecided()) wide.findings[i] = verdict.findings[i];
  if (!wide.unfinished()) wide.judgement = worst_of(wide.findings);
  return wide;
}

}  // namespace gainsmith::verify
