#include "packs/lane_set.h"

#include <algorithm>
#include <bit>

#include "base/stop.h"

namespace gainsmith::packs {

using lanes::kLanes;
using model::Dynamics;
using VariableKind = Dynamics::VariableKind;

namespace {

/// So many lanes step without the others: a step costs the same for few.
constexpr int kMostLanes = 7 * static_cast<int>(kLanes) / 8;

/// Tried one after the other, the coarsest first: it decides most runs at the least cost.
constexpr PackAccuracy kAccuracies[] = {{kFirstRelative, kFirstAbsolute},
                                        {kAgainRelative, kAgainAbsolute},
                                        {kLastRelative, kLastAbsolute}};

}  // namespace

LaneSet::LaneSet(const PackSystem& pack)
    : pack_(pack),
      horizon_(pack.scenario->horizon),
      step_(*pack.step),
      point_(*pack.point),
      coarse_point_(*pack.coarse_point),
      between_points_(*pack.between_points),
      polynomials_(*pack.polynomials),
      begin_(*pack.start),
      coarse_(pack.whole),
      fine_(pack.whole),
      coarse_end_(pack.whole),
      fine_middle_(pack.whole),
      fine_end_(pack.whole),
      between_(pack.whole),
      lengths_(1),
      errors_(1),
      scratch_(Eigen::VectorXd::Zero(pack.system->whole)) {
  for (LanePoint* point :
       {&start_, &coarse_start_, &middle_, &end_, &coarse_at_end_, &quarter_, &three_quarters_})
    for (std::size_t r = 0; r < point->of.size(); ++r) point->of[r] = LaneValues(rows_of(r));
  for (const PackEvent& event : pack.events) {
    jumps_.emplace_back(*event.jump);
    lost_.emplace_back();
    if (event.lost) lost_.back().emplace(*event.lost);
  }
  set_by_jumps_ = set_by_jumps(*pack.system);
  find_clock_elements();
  is_crossing_.assign(pack.watches.size(), false);
  in_condition_.assign(pack.watches.size(), 0);
  for (const PackEvent& event : pack.events)
    if (event.when) mark(*event.when, in_condition_);
  for (std::size_t e = 0; e < pack.events.size(); ++e) {
    if (pack.events[e].crossing) is_crossing_[pack.events[e].crossing->watch] = true;
    ends_in_zeno_ = ends_in_zeno_ || !pack.system->has_clock(e);
  }
}

/// A run that is open is made again to the next accuracy, and left open after the last.
void LaneSet::run(std::uint64_t seed, std::uint64_t first, std::vector<PackVerdict>& verdicts) {
  seed_ = seed;
  first_ = first;
  verdicts_.swap(verdicts);
  for (const PackAccuracy& accuracy : kAccuracies) {
    waiting_.clear();
    for (std::size_t k = verdicts_.size(); k-- > 0;)
      if (verdicts_[k].open) waiting_.push_back(first + k);
    if (!waiting_.empty()) run_waiting(accuracy);
  }
  verdicts_.swap(verdicts);
}

void LaneSet::run_waiting(const PackAccuracy& accuracy) {
  accuracy_ = &accuracy;
  std::fill_n(step_.input(pack_.whole + 1), kLanes, accuracy.relative);
  std::fill_n(step_.input(pack_.whole + 2), kLanes, accuracy.absolute);
  lanes_.clear();
  lanes_.resize(kLanes);
  while (true) {
    check_stop();
    const std::uint32_t stepping = in(Phase::step);
    if (std::popcount(stepping) >= kMostLanes) {
      step_all(stepping);
      continue;
    }
    // Those that step wait for the others.
    refill();
    if (const std::uint32_t jumping = in(Phase::jump)) {
      jump_all(jumping);
    } else if (const std::uint32_t due = in(Phase::evaluate)) {
      evaluate_all(due);
    } else if (stepping != 0) {
      step_all(stepping);
    } else {
      break;
    }
  }
}

std::size_t LaneSet::rows_of(std::size_t result) const {
  switch (result) {
    case PackSystem::rates:
      return pack_.rows.size();
    case PackSystem::claim_values:
    case PackSystem::claim_rates:
    case PackSystem::claim_terms:
      return pack_.claims.size();
    case PackSystem::extras: {
      std::size_t count = pack_.flats.size() + pack_.kinks.size();
      for (const PackClaim& claim : pack_.claims)
        count += claim.branches.size() + claim.roots.size();
      return count;
    }
    default:
      return pack_.watches.size();
  }
}

/// The elements that clocks fill: time, `since` an event, `left` to it.
void LaneSet::find_clock_elements() {
  since_.resize(pack_.events.size());
  left_.resize(pack_.events.size());
  const auto& variables = pack_.system->dynamics.variables;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const auto at = static_cast<std::size_t>(pack_.system->layout.slots[i].offset);
    if (variables[i].kind == VariableKind::time) times_.push_back(at);
    if (variables[i].kind == VariableKind::since) since_[variables[i].of].push_back(at);
    if (variables[i].kind == VariableKind::left) left_[variables[i].of].push_back(at);
  }
}

void LaneSet::refill() {
  for (std::size_t l = 0; l < kLanes; ++l) {
    if (lanes_[l] || waiting_.empty()) continue;
    const std::uint64_t run = waiting_.back();
    waiting_.pop_back();
    lanes_[l].emplace(pack_, seed_, run);
    scratch_ = hybrid::draw_start(*pack_.system, *pack_.scenario, seed_, run);
    for (std::size_t k = 0; k < pack_.system->noise.size(); ++k) lanes_[l]->noise.draw(k, scratch_);
    for (std::size_t k = 0; k < pack_.whole; ++k)
      coarse_.at(k, l) = fine_.at(k, l) = scratch_(static_cast<Eigen::Index>(k));
    lanes_[l]->wanted = kFirstStep * horizon_;
    fill_clocks(l);
  }
}

void LaneSet::leave_open(std::size_t l) {
  verdicts_[static_cast<std::size_t>(lanes_[l]->run_number - first_)].why = why_;
  lanes_[l].reset();
}

void LaneSet::finish(std::size_t l) {
  PackLane& lane = *lanes_[l];
  PackVerdict& verdict = verdicts_[static_cast<std::size_t>(lane.run_number - first_)];
  const bool nearest = verdict.nearest;
  verdict = {};
  verdict.open = false;
  verdict.nearest = nearest;
  for (ClaimLane& claim : lane.claims) {
    claim.finish();
    verdict.open = verdict.open || claim.open();
    if (claim.open()) verdict.why = Why::claim;
    verdict.findings.push_back(claim.finding());
  }
  verdict.happened = lane.happened;
  lanes_[l].reset();
}

void LaneSet::fill_clocks(std::size_t l) {
  const PackLane& lane = *lanes_[l];
  for (const std::size_t element : times_) set(element, l, lane.t);
  for (std::size_t e = 0; e < left_.size(); ++e)
    for (const std::size_t element : left_[e])
      set(element, l, std::max(lane.clocks.due(e) - lane.t, 0.0));
}

void LaneSet::evaluate(lanes::LaneMachine& by, const LaneValues& values, LanePoint& seen,
                       std::uint32_t active) {
  std::copy_n(values.row(0), values.rows() * kLanes, by.input(0));
  by.run(active);
  seen.faults = by.faults();
  for (std::size_t r = 0; r < seen.of.size(); ++r)
    for (std::size_t k = 0; k < by.size(r); ++k)
      std::copy_n(by.result(r, k), kLanes, seen.of[r].row(k));
}

std::uint32_t LaneSet::begin_claims(std::uint32_t mask) {
  std::uint32_t fresh = 0;
  each(mask, [&](std::size_t l) { fresh |= lanes_[l]->fresh ? 1U << l : 0; });
  if (fresh == 0) return 0;
  std::copy_n(fine_.row(0), fine_.rows() * kLanes, begin_.input(0));
  begin_.run(fresh);
  each(fresh, [&](std::size_t l) {
    for (std::size_t c = 0; c < pack_.claims.size(); ++c)
      lanes_[l]->claims[c].begin(pack_.claims[c], pack_, *accuracy_,
                                 begin_.result(PackSystem::limits, c)[l],
                                 begin_.result(PackSystem::limit_terms, c)[l]);
  });
  return begin_.faults() & fresh;
}

/// Both runs are evaluated in full, also with the rates of the coarser one, which moves by them at
/// roots.
void LaneSet::evaluate_all(std::uint32_t mask) {
  evaluate(point_, fine_, middle_, mask);
  evaluate(point_, coarse_, end_, mask);
  const std::uint32_t faults = middle_.faults | end_.faults | begin_claims(mask);
  const LaneMask all(mask);
  start_.copy(middle_, all);
  coarse_start_.copy(end_, all);
  each(mask, [&](std::size_t l) {
    const bool fault = (faults >> l & 1U) != 0 && !open(Why::no_value);
    const bool endless = ++lanes_[l]->evaluations > kMostAtOneInstant && !open(Why::jumps);
    if (fault || endless || !settle(l)) leave_open(l);
  });
}

}  // namespace gainsmith::packs
