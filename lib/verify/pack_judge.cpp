#include "verify/pack_judge.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "verify/tolerances.h"

namespace gainsmith::verify {

using claims::Judgement;

std::unique_ptr<const linear::LinearSystem> make_linear_packs(const Setup& setup) {
  if (!setup.linear) return nullptr;
  auto model = linear::make_linear_model(*setup.linear->system, setup.events->scenario,
                                         setup.linear->coordinates, setup.events->claims);
  return model ? linear::make_linear_system(std::move(*model)) : nullptr;
}

void require_agreement(std::uint64_t run, Judgement packs, Judgement careful) {
  if (packs == careful || packs == Judgement::undecided || careful == Judgement::undecided) return;
  throw std::logic_error(
      fmt::format("run {}: {} as one of many runs at once, but {} as a careful run; this is a "
                  "fault of gainsmith",
                  run, to_string(packs), to_string(careful)));
}

Packs make_packs(const Setup& setup, std::uint64_t runs) {
  Packs made;
  made.linear = make_linear_packs(setup);
  // Peaks next to a bound are followed by steps.
  const bool is_whole =
      made.linear && std::ranges::none_of(made.linear->model.claims, linear::is_bounded);
  if (is_whole || runs < kFewestInPacks) return made;
  const claims::RunSetup& events = setup.judged();
  const simulate::Accuracy accuracy = events.accuracy(claims::kAccuracyOfMany);
  const Eigen::VectorXd absolute =
      accuracy.absolute_of.size() > 0
          ? accuracy.absolute_of
          : Eigen::VectorXd(Eigen::VectorXd::Constant(events.system.size, accuracy.absolute));
  made.any = packs::make_pack_system(events.system, events.scenario, events.claims,
                                     accuracy.relative, absolute);
  if (made.any && !made.linear) made.flights = flights::make_flights(*made.any, events.claims);
  return made;
}

PackJudge::PackJudge(const Setup& setup, const Packs* packs) : setup_(&setup) {
  if (packs == nullptr) return;
  if (packs->linear) {
    linear_.emplace(*packs->linear);
    const auto& claims = packs->linear->model.claims;
    for (std::size_t c = 0; c < claims.size(); ++c)
      if (linear::is_bounded(claims[c])) bounded_.push_back(c);
  }
  if (packs->any) packs_.emplace(*packs->any);
  if (packs->flights) flights_.emplace(*packs->any, *packs->flights);
}

void PackJudge::begin(std::uint64_t seed, std::uint64_t first, std::uint64_t last) {
  seed_ = seed;
  first_ = first;
  verdicts_.clear();
  if (linear_) {
    verdicts_ = linear_->run(seed, first, last);
    reopen_nearest();
  } else if (flights_) {
    verdicts_ = flights_->run(seed, first, last);
  } else if (packs_) {
    verdicts_.resize(static_cast<std::size_t>(last - first));
  }
  if (packs_) packs_->decide(seed, first, verdicts_);
}

/// Of peaks linear packs know bounds alone. So runs that may be the nearest to a bound of this range
/// are left open.
void PackJudge::reopen_nearest() {
  for (const std::size_t c : bounded_) {
    double largest = -std::numeric_limits<double>::infinity();
    for (const packs::PackVerdict& verdict : verdicts_)
      if (!verdict.open)
        largest = std::max(largest, verdict.findings[c].value - verdict.findings[c].rounding);
    for (packs::PackVerdict& verdict : verdicts_)
      if (!verdict.open && verdict.findings[c].value + verdict.findings[c].rounding > largest)
        verdict.open = verdict.nearest = true;
  }
}

void PackJudge::begin_as(const PackJudge& prepared) {
  seed_ = prepared.seed_;
  first_ = prepared.first_;
  verdicts_ = prepared.verdicts_;
}

bool PackJudge::is_repeated(std::uint64_t run) const {
  if (run % kSampled != 0) return false;
  // Of proved errors the square numbers alone.
  const std::uint64_t number = run / kSampled;
  const auto root = static_cast<std::uint64_t>(std::sqrt(static_cast<double>(number)));
  return !linear_ || root * root == number;
}

std::uint64_t PackJudge::careful_count() const {
  std::uint64_t count = 0;
  for (std::size_t k = 0; k < verdicts_.size(); ++k)
    if (verdicts_[k].open || is_repeated(first_ + k)) ++count;
  return count;
}

RunVerdict PackJudge::careful(std::uint64_t seed, std::uint64_t run,
                              const std::vector<bool>& holds) {
  if (!judge_) judge_.emplace(*setup_);
  return (*judge_)(seed, run, holds);
}

namespace {

/// The claims that a proof says to hold.
std::vector<bool> held(const std::vector<claims::Finding>& findings) {
  std::vector<bool> holds;
  holds.reserve(findings.size());
  for (const claims::Finding& finding : findings)
    holds.push_back(finding.judgement == Judgement::held);
  return holds;
}

}  // namespace

RunVerdict verdict_on_run(Judge& judge, const linear::LinearSystem* linear, std::uint64_t seed,
                          std::uint64_t run) {
  std::vector<bool> holds;
  if (linear != nullptr) {
    const packs::PackVerdict pack = packs::LinearRunner(*linear).run(seed, run, run + 1).front();
    if (!pack.open) holds = held(pack.findings);
  }
  return judge(seed, run, holds);
}

CampaignVerdictOnRun PackJudge::operator()(std::uint64_t run) {
  if (!linear_ && !packs_) return {careful(seed_, run), true, {}};
  const packs::PackVerdict& pack = verdicts_[static_cast<std::size_t>(run - first_)];
  // Which runs are the nearest depends on how a campaign is cut: they do not count as open.
  if (pack.open && pack.nearest) return {careful(seed_, run), false, {}};
  if (pack.open) return {careful(seed_, run), true, pack.why};
  RunVerdict verdict;
  verdict.judgement = pack.violated() ? Judgement::violated : Judgement::held;
  verdict.happened = pack.happened;
  verdict.findings = pack.findings;
  if (!is_repeated(run)) return {std::move(verdict), false, {}};
  RunVerdict again =
      careful(seed_, run, pack.proved ? held(verdict.findings) : std::vector<bool>());
  for (std::size_t c = 0; c < again.findings.size(); ++c)
    require_agreement(run, verdict.findings[c].judgement, again.findings[c].judgement);
  return {std::move(again), true, {}};
}

}  // namespace gainsmith::verify
