#include "claims/twin_runs.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/number.h"
#include "base/stop.h"
#include "claims/parting.h"
#include "claims/sample_points.h"
#include "claims/tolerances.h"
#include "ode/tolerances.h"

namespace gainsmith::claims {

using Eigen::Index;

namespace {

/// Until when two runs have the same events: where one of the last two flows ends, if not to `end`.
double certain_end(const TwinParts& parts, double end) {
  if (parts.whole || parts.parts.empty()) return parts.whole ? end : 0;
  if (const auto* jump = std::get_if<TwinJump>(&parts.parts.back())) return jump->jump->t;
  const auto& last = std::get<TwinFlow>(parts.parts.back());
  return last.twin == nullptr ? last.flow->from() : std::min(last.flow->to(), last.twin->to());
}

}  // namespace

double TwinRun::steps() const {
  std::size_t count = 0;
  for (const auto& part : run.parts)
    if (const auto* flow = std::get_if<hybrid::FlowPiece>(&part)) count += flow->steps.size();
  return static_cast<double>(count);
}

std::string TwinRun::unknown(double until, const std::vector<Index>& elements,
                             const hybrid::System& system) const {
  double first = certain;
  std::string why = doubt;
  for (const Index e : elements)
    if (parted(e) < first) {
      first = parted(e);
      why = "t = " + brief(first) + ": its errors have grown to the size of " +
            system.element_name(e);
    }
  return until >= first ? why : "";
}

TwinRun TwinRuns::operator()(std::uint64_t seed, std::uint64_t run, double usual, double factor) {
  const simulate::Accuracy accuracy = setup_->accuracy(usual, factor * kSharper);
  simulate::Accuracy coarser = setup_->accuracy(usual, factor);
  coarser.longest = accuracy.longest / ode::kShorter;
  return made(seed, run, accuracy, coarser);
}

TwinRun TwinRuns::in_31_digits(std::uint64_t seed, std::uint64_t run, double usual) {
  simulate::Accuracy accuracy = setup_->accuracy(usual, kSharper);
  accuracy.in_31_digits = true;
  return made(seed, run, accuracy, accuracy);
}

TwinRun TwinRuns::made(std::uint64_t seed, std::uint64_t run, const simulate::Accuracy& accuracy,
                       const simulate::Accuracy& coarser) {
  TwinRun result;
  if (!setup_->system.affine) result.accuracy = accuracy.relative;
  result.run = simulator_.run(seed, run, accuracy);
  result.twin = simulator_.run(seed, run, coarser, {}, 0);
  check_stop();
  // The turning points are those of the second run.
  const TwinParts parts = pair_twins(result.twin, result.run, setup_->system, doubts_.maps());
  compare(parts, accuracy, result);
  const bool same = parts.whole && result.run.ending == result.twin.ending &&
                    std::abs(result.run.end - result.twin.end) <= kInstantOfRun * result.run.end;
  if (!same) {
    result.certain = certain_end(parts, std::min(result.run.end, result.twin.end));
    result.doubt =
        "t = " + brief(result.certain) + ": which events happen, and when, hangs on the accuracy";
  }
  if (auto doubt = doubts_.first(result.twin, parts); doubt && doubt->t < result.certain) {
    result.certain = doubt->t;
    result.doubt = std::move(doubt->why);
  }
  return result;
}

/// At the ends of all steps, and before and after jumps.
void TwinRuns::compare(const TwinParts& twins, const simulate::Accuracy& accuracy,
                       TwinRun& result) const {
  Parting parting(result.run.start, accuracy.relative, accuracy.absolute);
  for (const auto& part : twins.parts) {
    if (const auto* jump = std::get_if<TwinJump>(&part)) {
      parting.see(jump->jump->t, jump->jump->before, jump->twin_before);
      parting.see(jump->jump->t, jump->jump->after, jump->twin_after);
      continue;
    }
    const auto& flow = std::get<TwinFlow>(part);
    const double from = flow.flow->from();
    const double length = flow.twin != nullptr ? flow.twin->to() - flow.twin->from() : 0;
    for (const hybrid::DenseStep& step : flow.flow->steps) {
      // One of two flows that lead to other events is longer.
      if (flow.twin != nullptr && step.to - from > (1 + kInstantOfRun) * length) break;
      const bool last = step.to == flow.flow->to();
      parting.see(step.to, last ? flow.flow->end : step(step.to),
                  flow.twin_at(length > 0 ? std::min((step.to - from) / length, 1.0) : 1));
    }
  }
  result.parted = parting.since();
}

}  // namespace gainsmith::claims
