#include "claims/run_tracks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/unit_roundoff.h"
#include "claims/tolerances.h"

namespace gainsmith::claims {

using Eigen::Index;
using Eigen::VectorXd;
using hybrid::Ending;

namespace {

/// The samples from which the bound of one is taken.
constexpr int kAround = 2 * kSamplesBeside + 1;
/// The samples around the k-th of all.
Index first_around(Index k, Index all) {
  return std::max<Index>(std::min<Index>(k - kAround / 2, all - kAround), 0);
}
Index last_around(Index k, Index all) {
  return std::min<Index>(first_around(k, all) + kAround, all);
}

bool is_whole(model::Dynamics::VariableKind kind) {
  using Kind = model::Dynamics::VariableKind;
  return kind == Kind::mode || kind == Kind::jumps || kind == Kind::count || kind == Kind::passes;
}

}  // namespace

RunTracks::RunTracks(const RunSetup& setup)
    : setup_(&setup),
      simulator_(setup.system, setup.scenario),
      costs_(setup.costs, setup.layout, setup.system.constants),
      doubts_(setup.system),
      rounds_(static_cast<std::size_t>(setup.system.whole), false) {
  const auto& variables = setup.system.dynamics.variables;
  for (std::size_t k = 0; k < variables.size(); ++k) {
    const hybrid::Slot& slot = setup.system.layout.slots[k];
    const auto first = rounds_.begin() + slot.offset;
    std::fill(first, first + slot.shape.size(), !is_whole(variables[k].kind));
  }
  for (Index e = 0; e < setup.system.size; ++e)
    if (setup.system.rests(e)) resting_.push_back(e);
  chosen_.resize(rounds_.size(), 0);
  functions_.reserve(setup.functions.size());  // the balls point into it
  for (const expr::Program& function : setup.functions) {
    functions_.emplace_back(function, setup.layout, setup.system.constants);
    balls_.emplace_back(function, functions_.back(), setup.layout, setup.constants);
  }
}

/// Whether a function is of a claim that a point is for.
bool RunTracks::counts(const SamplePoint& point, std::size_t function) const {
  if (rests_[function] != 0 || (amid_ && setup_->at_ends[function])) return false;
  return point.function == Track::kForAll || point.function == setup_->first_of_claim[function];
}

/// What comes next follows a jump of the event.
void RunTracks::come_to(std::size_t event) {
  for (const JudgedClaim& claim : setup_->judged)
    for (std::size_t k = 0; claim.over && k < rests_.size(); ++k)
      if (setup_->first_of_claim[k] == claim.value) rests_[k] = *claim.over != event ? 1 : 0;
}

/// Which functions are to be evaluated: not those whose variables are in both runs, bit by bit, what
/// they were at their last sample, as at the jump of another observer.
void RunTracks::find_fresh(const SamplePoint& point, const VectorXd& coarse, const VectorXd& fine,
                           const VectorXd& around) {
  for (std::size_t k = 0; k < functions_.size(); ++k) {
    fresh_[k] = false;
    if (!counts(point, k)) continue;
    std::vector<double>& at = sampled_[k].at;
    const std::vector<Index>& used = functions_[k].used();
    fresh_[k] = !sampled_[k].is_known;
    at.resize(3 * used.size());
    auto kept = at.begin();
    for (const VectorXd* values : {&coarse, &fine, &around})
      for (const Index e : used) {
        fresh_[k] = fresh_[k] || *kept != (*values)(e);
        *kept++ = (*values)(e);
      }
  }
}

VectorXd RunTracks::values(const VectorXd& x) {
  VectorXd result = VectorXd::Zero(static_cast<Index>(functions_.size()));
  for (std::size_t k = 0; k < functions_.size(); ++k)
    if (fresh_[k]) result(static_cast<Index>(k)) = functions_[k].number(x);
  return result;
}

/// x as rounding may have left it: exact flows and jumps round in both runs alike. Elements whose
/// numbers differ in the bit are rounded apart, so that a difference of two shows it.
VectorXd RunTracks::with_rounding(const VectorXd& x, int bit) const {
  VectorXd result = x;
  for (Index e = 0; e < x.size(); ++e) {
    if (!rounds(e, x(e)) || track_.samples() == 0) continue;
    const bool up = ((e >> bit) & 1) == 0;
    result(e) += (up ? 1 : -1) * rounding_of(x(e));
  }
  return result;
}

/// What the variables may be off by, where the two runs differ by so much at samples around.
VectorXd RunTracks::errors(const VectorXd& fine, const VectorXd& around) const {
  VectorXd result = error_factor(setup_->system) * around;
  for (Index e = 0; e < fine.size(); ++e)
    if (rounds(e, fine(e))) result(e) += rounding_of(fine(e));
  return result;
}

/// The bits `pattern`, `pattern` + `stride`, ... of the numbers of elements are rounded apart.
void RunTracks::append(const SamplePoint& point, std::int64_t j, const VectorXd& coarse,
                       const VectorXd& fine, const VectorXd& around, int pattern, int stride,
                       bool within_instant) {
  parting_->see(point.t, fine, coarse);
  if (in_31_digits_)
    rounding_31_ = std::fmax(rounding_31_, k31Error * fine.lpNorm<Eigen::Infinity>());
  find_fresh(point, coarse, fine, around);
  VectorXd value = values(fine);
  VectorXd rounded = VectorXd::Zero(value.size());
  for (int bit = pattern; bit == 0 || (fine.size() - 1) >> bit > 0; bit += stride)
    rounded = rounded.cwiseMax((values(with_rounding(fine, bit)) - value).cwiseAbs());
  VectorXd difference = (values(coarse) - value).cwiseAbs().cwiseMax(rounded);
  rounded /= (4 + rounded_) * kUnitRoundoff;
  VectorXd error = errors(fine, around);
  // What has parted may be anywhere in its range: a branch that both runs take says nothing.
  for (Index e = 0; e < error.size(); ++e)
    if (parting_->has_parted(e)) error(e) = std::fmax(error(e), parting_->range(e));
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < functions_.size(); ++k) {
    const auto row = static_cast<Index>(k);
    const bool is_followed = point.t <= functions_[k].followed_until;
    Sampled& last = sampled_[k];
    if (!counts(point, k) || !is_followed) {
      last.is_known = last.is_known && is_followed;
      track_.is_fixed.push_back(0);
      rounding_.push_back(is_followed ? 0 : kUnknown);
      difference(row) = 0;
      continue;
    }
    if (!fresh_[k]) {
      value(row) = last.value;
      difference(row) = last.difference;
      track_.is_fixed.push_back(last.is_fixed);
      rounding_.push_back(last.rounding);
      continue;
    }
    const bool is_open = !functions_[k].is_smooth() && balls_[k].is_open(fine, error);
    track_.is_fixed.push_back(!is_open && difference(row) == 0 ? 1 : 0);
    if (!is_open) {
      rounding_.push_back(balls_[k].rounding(fine));
      const double size = std::fmax(rounded(row), rounding_.back() / kUnitRoundoff);
      if (differs(k, value(row), difference(row), size)) {
        difference(row) = std::fmax(difference(row), difference_between(k, coarse, fine));
        part(k);
      }
      if (has_parted(k)) difference(row) = kUnknown;
      last.is_known = true;
      last.value = value(row);
      last.difference = difference(row);
      last.rounding = rounding_.back();
      last.is_fixed = track_.is_fixed.back();
      continue;
    }
    last.is_known = false;
    const Bounded hull = balls_[k].hull(fine, error);
    double bound = hull.bound;
    // The start is as it is drawn: an error of 0 is 0 there.
    if (track_.samples() == 0 && !std::isnan(value(row)))
      bound += std::abs(hull.value - value(row));
    else if (!std::isnan(hull.value))
      value(row) = hull.value;
    difference(row) = has_parted(k) ? kUnknown : 0;
    rounding_.push_back(bound);
  }
  track_.t.push_back(point.t);
  track_.sampled_for.push_back(point.function);
  track_.within_instant.push_back(within_instant ? 1 : 0);
  track_.j.push_back(j);
  track_.values.insert(track_.values.end(), value.data(), value.data() + value.size());
  track_.bounds.insert(track_.bounds.end(), difference.data(),
                       difference.data() + difference.size());
}

/// What the value is off by between the two runs at most, where they differ by little of its
/// variables but by much of its range: it need not lie between its values at both.
double RunTracks::difference_between(std::size_t function, const VectorXd& coarse,
                                     const VectorXd& fine) {
  double most = 0;
  const double value = functions_[function].number(fine);
  for (const double share : {0.25, 0.5, 0.75}) {
    const double between = functions_[function].number(fine + share * (coarse - fine));
    most = std::fmax(most, std::abs(between - value));
  }
  return most;
}

bool RunTracks::differs(std::size_t function, double value, double difference, double size) {
  const auto claim = static_cast<std::size_t>(setup_->first_of_claim[function]);
  Range& range = ranges_[function];
  range.low = range.seen ? std::fmin(range.low, value) : value;
  range.high = range.seen ? std::fmax(range.high, value) : value;
  range.seen = true;
  sizes_[claim] = std::fmax(sizes_[claim], std::fmax(std::abs(value), size));
  // A value that is nothing but errors of its terms goes on to be known to them.
  return difference > kParted * (range.high - range.low) &&
         difference > kPartedAccuracy * track_.accuracy * sizes_[claim];
}

void RunTracks::part(std::size_t function) {
  if (std::ranges::any_of(functions_[function].used(),
                          [&](Index variable) { return parting_->has_parted(variable); }))
    parted_[static_cast<std::size_t>(setup_->first_of_claim[function])] = 1;
}

void RunTracks::add_flow(const TwinFlow& flow, const hybrid::Trajectory& run, double certain) {
  const hybrid::FlowPiece& fine = *flow.flow;
  if (!in_31_digits_) rounded_ += static_cast<double>(fine.steps.size());
  const std::vector<SamplePoint> points =
      points_along(fine, setup_->sample_points, functions_, rises_);
  std::vector<VectorXd> coarse_x;
  std::vector<VectorXd> fine_x;
  for (const SamplePoint& point : points) {
    coarse_x.push_back(flow.twin_at(point.share));
    fine_x.push_back(state_at(fine, point.share));
  }
  const auto count = static_cast<Index>(points.size());
  const bool within_instant = fine.to() - fine.from() <= kInstantOfRun * run.end;
  for (Index k = 0; k < count; ++k) {
    const SamplePoint& point = points[static_cast<std::size_t>(k)];
    if (point.t >= certain) break;
    VectorXd difference = VectorXd::Zero(fine.start.size());
    for (Index other = first_around(k, count); other < last_around(k, count); ++other) {
      const auto at = static_cast<std::size_t>(other);
      difference = difference.cwiseMax((coarse_x[at] - fine_x[at]).cwiseAbs());
    }
    track_.moves.push_back({});
    const auto at = static_cast<std::size_t>(k);
    append(point, fine.j, coarse_x[at], fine_x[at], difference, static_cast<int>((k + 1) % kAround),
           kAround, within_instant);
  }
}

void RunTracks::add_jump(const TwinParts& twins, std::size_t at) {
  const auto& [jump, before, after, t] = std::get<TwinJump>(twins.parts[at]);
  if (!in_31_digits_) rounded_ += 1;
  come_to(jump->event);
  parting_->compute(jump->terms);
  // What is computed anew rounds again, also where it has the same bits.
  for (std::size_t k = 0; k < functions_.size(); ++k)
    if (std::ranges::any_of(functions_[k].used(),
                            [&](Index e) { return e < jump->terms.size() && jump->terms(e) > 0; }))
      sampled_[k].is_known = false;
  for (const Index e : resting_)
    if (const double terms = jump->terms(e); terms != 0)
      chosen_[static_cast<std::size_t>(e)] =
          terms == hybrid::kConstantTerms && after(e) == jump->after(e) ? 1 : 0;
  track_.moves.push_back({true, jump->event});
  append({1, jump->t}, jump->j + 1, after, jump->after, (after - jump->after).cwiseAbs(), 0, 1);
}

/// A rise within the noise of a run is never certain.
RiseLimits RunTracks::limits_of_rises(const VectorXd& start, double accuracy) {
  RiseLimits limits;
  const bool exact = setup_->system.affine;
  limits.noise = exact ? kValueRounding : kLeastRise * accuracy;
  limits.agreement = exact ? kExactAgreement : kErrorOfDifference * accuracy;
  limits.floor = VectorXd::Zero(static_cast<Index>(functions_.size()));
  for (const SamplePoints::Falling& falling : setup_->sample_points.falling)
    if (falling.after == 0)
      limits.floor(static_cast<Index>(falling.function)) =
          kFloorOfAccuracy * accuracy * std::abs(functions_[falling.function].number(start));
  return limits;
}

bool RunTracks::add_parts(const hybrid::Trajectory& coarse, const hybrid::Trajectory& fine) {
  append({0, 0}, 0, coarse.start, fine.start, (coarse.start - fine.start).cwiseAbs(), 0, 1);
  const TwinParts twins = pair_twins(fine, coarse, setup_->system, doubts_.maps());
  const auto doubt = doubts_.first(fine, twins);
  widen(0);
  std::size_t first = 1;
  std::size_t last = twins.parts.size();  // flow
  while (last > 0 && !std::holds_alternative<TwinFlow>(twins.parts[last - 1])) --last;
  for (std::size_t k = 0; k < twins.parts.size() && doubt_.empty(); ++k) {
    amid_ = k + 1 < last;
    if (doubt && doubt->part == k) doubt_ = doubt->why;
    if (const auto* flow = std::get_if<TwinFlow>(&twins.parts[k])) {
      add_flow(*flow, fine, doubt_.empty() ? std::numeric_limits<double>::infinity() : doubt->t);
      continue;
    }
    if (!doubt_.empty()) break;
    widen(first);
    first = track_.samples();
    add_jump(twins, k);
  }
  widen(first);
  return twins.whole && doubt_.empty();
}

/// Of the samples of one flow, once all are there.
void RunTracks::widen(std::size_t first) {
  const auto size = track_.size;
  const auto count = static_cast<Index>(track_.samples() - first);
  const Index skipped = static_cast<Index>(first) * size;
  Eigen::Map<numbers::Matrix> bounds(track_.bounds.data() + skipped, size, count);
  const Eigen::Map<const numbers::Matrix> rounding(rounding_.data() + skipped, size, count);
  const numbers::Matrix own = bounds;
  const double factor = error_factor(setup_->system);
  std::vector<Index> seen;  // the samples that count for a function
  for (Index f = 0; f < size; ++f) {
    seen.clear();
    for (Index k = 0; k < count; ++k) {
      const SamplePoint point{0, 0, track_.sampled_for[first + static_cast<std::size_t>(k)]};
      if (counts(point, static_cast<std::size_t>(f))) seen.push_back(k);
    }
    const auto all = static_cast<Index>(seen.size());
    for (Index i = 0; i < all; ++i) {
      const Index k = seen[static_cast<std::size_t>(i)];
      double around = 0;
      for (Index other = first_around(i, all); other < last_around(i, all); ++other)
        around = std::fmax(around, own(f, seen[static_cast<std::size_t>(other)]));
      const double value =
          track_.at(first + static_cast<std::size_t>(k), static_cast<int>(f)).value;
      // The start is as it is drawn.
      const bool is_exact = first + static_cast<std::size_t>(k) == 0 || is_exact_whole(value);
      if (around == 0 && rounding(f, k) == 0 && is_exact) continue;
      bounds(f, k) = factor * around + 8 * kUnitRoundoff * std::abs(value) + rounding(f, k);
    }
  }
}

void RunTracks::end(const hybrid::Trajectory& coarse, const hybrid::Trajectory& fine,
                    bool certain) {
  track_.message = fine.message;
  const bool same = certain && coarse.ending == fine.ending &&
                    std::abs(coarse.end - fine.end) <= kInstantOfRun * fine.end;
  const bool complete = is_complete(fine.ending);
  ended_early_ = same && !complete;
  const bool breaks = fine.ending == Ending::escaped || fine.ending == Ending::undefined ||
                      fine.ending == Ending::stuck;
  // Two integrations need not escape at the same time.
  const bool both_escape =
      doubt_.empty() && coarse.ending == Ending::escaped && fine.ending == Ending::escaped;
  if (same && complete) {
    track_.termination = Termination::horizon;
  } else if ((same && breaks) || both_escape) {
    track_.termination = Termination::broken_off;
  } else {
    track_.termination = Termination::lost;
    if (!doubt_.empty())
      track_.message = doubt_;
    else if (!same)
      track_.message = "which events happen, and when, hangs on the accuracy" +
                       (fine.message.empty() ? "" : "; " + fine.message);
  }
}

const Track& RunTracks::run(std::uint64_t seed, std::uint64_t run, double factor,
                            std::uint64_t twin) {
  const simulate::Accuracy accuracy = setup_->accuracy(kAccuracyOfMany, factor);
  return compare(seed, run, accuracy, accuracy.times(kSharper), twin);
}

const Track& RunTracks::run_in_31_digits(std::uint64_t seed, std::uint64_t run) {
  // Below that accuracy values do not count, as in a run that is integrated to it.
  simulate::Accuracy accuracy = setup_->accuracy(kAccuracyOfOne, kSharper);
  accuracy.in_31_digits = true;
  return compare(seed, run, accuracy, accuracy, 0);
}

const Track& RunTracks::compare(std::uint64_t seed, std::uint64_t run,
                                const simulate::Accuracy& accuracy,
                                const simulate::Accuracy& sharper, std::uint64_t twin) {
  track_.clear();
  track_.size = static_cast<Index>(functions_.size());
  track_.accuracy = accuracy.relative;
  in_31_digits_ = accuracy.in_31_digits;
  rounded_ = rounding_31_ = 0;
  rounding_.clear();
  hybrid::Trajectory coarse = simulator_.run(seed, run, accuracy);
  hybrid::Trajectory fine = simulator_.run(seed, run, sharper, {}, twin);
  costs_.add_to(coarse, true);
  costs_.add_to(fine, false);
  parting_.emplace(fine.start, accuracy.relative, 0);
  for (const auto& [of, from] : setup_->scenario.differences)
    parting_->relate(setup_->system.layout.slots[of], setup_->system.layout.slots[from]);
  chosen_.assign(rounds_.size(), 0);
  rises_ = limits_of_rises(fine.start, accuracy.relative);
  amid_ = false;
  ranges_.assign(functions_.size(), {});
  sizes_.assign(functions_.size(), 0);
  parted_.assign(functions_.size(), 0);
  rests_.assign(functions_.size(), 0);
  sampled_.assign(functions_.size(), {});
  fresh_.assign(functions_.size(), false);
  for (RunValue& function : functions_)
    function.followed_until = std::numeric_limits<double>::infinity();
  doubt_.clear();
  const bool certain = add_parts(coarse, fine);
  end(coarse, fine, certain);
  return track_;
}

}  // namespace gainsmith::claims
