#include "claims/claim_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "base/unit_roundoff.h"
#include "claims/tolerances.h"

namespace gainsmith::claims {

namespace {

bool is_number(const Bounded& value) { return !std::isnan(value.value); }

/// Whether a sample is there for the sake of one value.
bool is_own(const Track& track, std::size_t sample) {
  return !track.sampled_for.empty() && track.sampled_for[sample] != Track::kForAll;
}

/// The part of a value at the start below which what is undecided is noise, by the accuracy of the
/// integration.
double noise_floor(double accuracy) { return std::max(accuracy, kNoiseOfRuns); }

/// What is certain of value <= bound. `holds`: it is known to be so.
Judgement compare(const Bounded& value, const Bounded& bound, bool holds) {
  if (holds) return Judgement::held;
  if (!is_number(value) || !is_number(bound)) return Judgement::undecided;
  const double excess = value.value - bound.value;
  // The subtraction rounds by u |excess|; twice that is a bound.
  const double rounding = value.bound + bound.bound + 2 * kUnitRoundoff * std::abs(excess);
  if (excess > rounding) return Judgement::violated;
  if (excess <= -rounding || (excess <= 0 && value.bound + bound.bound == 0))
    return Judgement::held;
  return Judgement::undecided;
}

/// score = (value - bound)/|scale|; infinite where that is no number or a violation has the scale
/// 0.
Finding finding_at(const Track& track, std::size_t sample, const Bounded& value,
                   const Bounded& bound, double scale, Judgement judgement) {
  Finding finding;
  finding.judgement = judgement;
  finding.value = value.value;
  finding.bound = bound.value;
  // What overflowed bounds nothing; a difference of two such is no number.
  finding.rounding = value.bound + bound.bound;
  if (std::isnan(finding.rounding)) finding.rounding = std::numeric_limits<double>::infinity();
  finding.t = track.t[sample];
  finding.j = track.j[sample];
  const double excess = value.value - bound.value;
  const bool violated = judgement == Judgement::violated;
  if (std::isnan(excess) || (violated && scale == 0)) {
    finding.score = std::numeric_limits<double>::infinity();
  } else {
    finding.score = scale == 0 ? -1 : excess / std::abs(scale);
  }
  return finding;
}

}  // namespace

Finding ClaimCheck::operator()(const Track& track, bool holds) const {
  Finding finding = judged(track, holds || claim_->always);
  finding.tolerance = claim_->tolerance;
  return finding;
}

Finding ClaimCheck::judged(const Track& track, bool holds) const {
  switch (claim_->kind) {
    case model::ClaimKind::nonincreasing:
      return nonincreasing(track, holds);
    case model::ClaimKind::cost:
      return cost(track, holds);
    case model::ClaimKind::shrinks:
      return shrinks(track, holds);
    case model::ClaimKind::below:
    case model::ClaimKind::above:
      return bounded(track, holds);
  }
  return {};
}

/// What must not be exceeded, and what the tolerance forgives: a part of a size, known up to an
/// error.
Bounded ClaimCheck::eased(const Bounded& bound, double size, double error) const {
  if (claim_->tolerance == 0) return bound;
  const double forgiven = claim_->tolerance * size;
  const double rounded = kUnitRoundoff * (forgiven + std::abs(bound.value));
  return {bound.value + forgiven, bound.bound + claim_->tolerance * error + 2 * rounded};
}

/// Whether it may lie so near the one before that no value has changed in between.
bool ClaimCheck::is_crowded(const Track& track, std::size_t sample) const {
  return is_own(track, sample) ||
         (!track.within_instant.empty() && track.within_instant[sample] != 0);
}

/// Whether it is there for the sake of another.
bool ClaimCheck::is_of_another(const Track& track, std::size_t sample) const {
  return is_own(track, sample) && track.sampled_for[sample] != claim_->value;
}

bool ClaimCheck::counts(const Track& track, std::size_t sample) const {
  const bool is_jump = sample > 0 && track.moves[sample - 1].jump;
  if (!is_after(track.t[sample], is_jump, claim_->after) || is_of_another(track, sample))
    return false;
  return !claim_->over || (is_jump && track.moves[sample - 1].event == *claim_->over);
}

std::vector<Bounded> ClaimCheck::values(const Track& track) const {
  std::vector<Bounded> values;
  for (std::size_t k = 0; k < track.samples(); ++k)
    values.push_back(k > 0 && claim_->is_still && !track.moves[k - 1].jump
                         ? values.back()
                         : track.at(k, claim_->value));
  return values;
}

/// Whether the value is a constant that a jump has taken, as the end of a clip: it has the same bits
/// whatever the errors, and nothing of it is computed.
bool ClaimCheck::is_chosen(const Track& track, std::size_t sample, const Bounded& value) const {
  const auto at = sample * static_cast<std::size_t>(track.size);
  return !track.is_fixed.empty() &&
         track.is_fixed[at + static_cast<std::size_t>(claim_->value)] != 0 &&
         value.bound <= 8 * kUnitRoundoff * std::abs(value.value);
}

/// Whether the value at a sample may differ from that at one before, the last that counts.
bool ClaimCheck::may_change(const Track& track, std::size_t before, std::size_t sample,
                            const std::vector<Bounded>& v) const {
  if (claim_->over) return true;
  bool jump = false;
  bool varies = false;
  for (std::size_t k = before; k < sample; ++k) {
    jump = jump || track.moves[k].jump;
    varies = varies || track.moves[k].jump || !claim_->is_still;
  }
  if (!varies) return false;
  const auto is_fixed = [&](std::size_t k) {
    const auto size = static_cast<std::size_t>(track.size);
    return !track.is_fixed.empty() &&
           track.is_fixed[k * size + static_cast<std::size_t>(claim_->value)] != 0;
  };
  const bool same = v[sample].value == v[before].value;
  if (is_fixed(sample) && is_fixed(before) && same) return false;
  // Jumps of others leave it bit by bit.
  return !(jump && same);
}

Finding ClaimCheck::nonincreasing(const Track& track, bool holds) const {
  const std::vector<Bounded> v = values(track);
  std::size_t first = 0;
  while (first < v.size() && !counts(track, first)) ++first;
  if (first == v.size()) return nothing_counts(track);
  const double scale = v[first].value;
  const double floor = kFloorOfAccuracy * track.accuracy;
  Bounded low = v[first];   // with the smallest value - bound
  Bounded high = v[first];  // with the smallest value + bound
  std::size_t last = first;
  std::optional<Finding> worst;
  double noise = 0;
  for (std::size_t k = first + 1; k < v.size(); ++k) {
    if (!counts(track, k)) continue;
    const bool moves = may_change(track, last, k, v);
    last = k;
    if (!moves) continue;
    Judgement judgement = compare(v[k], eased(high, std::abs(high.value), high.bound), holds);
    if (judgement != Judgement::violated) {
      judgement = compare(v[k], eased(low, std::abs(low.value), low.bound), holds);
      if (judgement == Judgement::violated) judgement = Judgement::undecided;
    }
    if (judgement == Judgement::undecided && is_crowded(track, k) && is_number(v[k]) &&
        v[k].value - high.value <= kGrown * (v[k].bound + high.bound))
      judgement = Judgement::held;
    const double top = std::abs(v[k].value) + v[k].bound;
    const double least = judgement == Judgement::undecided ? noise_floor(track.accuracy) : floor;
    if (judgement != Judgement::held && scale != 0 && top <= least * std::abs(scale)) {
      noise = std::max(noise, top / std::abs(scale));
    } else if (judgement != Judgement::held) {
      const Finding found = finding_at(track, k, v[k], high, scale, judgement);
      const auto rank = [](const Finding& finding) {
        return std::pair(finding.violated(), finding.score);
      };
      if (!worst || rank(found) > rank(*worst)) worst = found;
    }
    if (v[k].value - low.value < v[k].bound - low.bound) low = v[k];
    if (v[k].value - high.value < high.bound - v[k].bound) high = v[k];
  }
  if (!worst && !is_number(v[first]))
    worst = finding_at(track, first, v[first], v[first], scale, compare(v[first], v[first], holds));
  if (!worst) worst = finding_at(track, last, v[last], v[first], scale, Judgement::held);
  worst->floor = noise;
  return *worst;
}

Finding ClaimCheck::nothing_counts(const Track& track) const {
  Finding finding;
  finding.sampled = false;
  finding.score = -std::numeric_limits<double>::infinity();
  finding.t = track.t.back();
  finding.j = track.j.back();
  return finding;
}

/// The sizes of the terms of the value at samples that count, with their errors; 0 at the others.
/// Without terms they are those of the value itself.
std::vector<double> ClaimCheck::term_sizes(const Track& track,
                                           const std::vector<Bounded>& v) const {
  std::vector<double> sizes(v.size(), 0);
  for (std::size_t k = 0; k < v.size(); ++k) {
    if (!counts(track, k) || !is_number(v[k])) continue;
    const Bounded terms = claim_->terms ? track.at(k, *claim_->terms) : v[k];
    sizes[k] = std::abs(terms.value) + v[k].bound;
  }
  return sizes;
}

/// The value against the bound b at every sample that counts; `above` is `below` of what is
/// negated.
Finding ClaimCheck::bounded(const Track& track, bool holds) const {
  const std::vector<Bounded> v = values(track);
  const Bounded b = track.at(0, *claim_->bound);
  const bool above = claim_->kind == model::ClaimKind::above;
  // The same in all runs, so that their scores are compared as their values are.
  const double scale = b.value == 0 ? 1 : std::abs(b.value);
  const std::vector<double> sizes = b.value == 0 ? term_sizes(track, v) : std::vector<double>();
  double largest = 0;
  for (const double size : sizes)
    if (std::isfinite(size)) largest = std::max(largest, size);
  std::optional<Finding> worst;
  double noise = 0;
  bool leaves_bound = false;  // from a start that is the bound
  const auto rank = [](const Finding& finding) {
    return std::tuple(finding.violated(), finding.undecided(), finding.score);
  };
  for (std::size_t k = 0; k < v.size(); ++k) {
    if (!counts(track, k)) continue;
    Bounded value = v[k];
    // A start that is the bound, bit by bit, counts as equal; another one may be that of a text,
    // rounded.
    const bool is_exact = k == 0 ? value.bound == 0 : is_chosen(track, k, value);
    const bool is_bound = is_exact && value.value == b.value;
    if (k == 0 && value.bound == 0 && !is_bound)
      value.bound = 8 * kUnitRoundoff * std::abs(value.value);
    const bool zero = b.value == 0;
    const double size = zero ? sizes[k] : scale;
    const double error = zero ? 2 * value.bound : b.bound;
    const double beyond = above ? b.value - value.value : value.value - b.value;
    leaves_bound = is_bound || (leaves_bound && is_own(track, k));
    const bool is_equal = is_bound || (leaves_bound && beyond <= kGrown * value.bound);
    const Judgement judgement = above ? compare(b, eased(value, size, error), holds || is_equal)
                                      : compare(value, eased(b, size, error), holds || is_equal);
    Finding found = finding_at(track, k, above ? b : value, above ? value : b, scale, judgement);
    if (above) std::swap(found.value, found.bound);
    const double part = largest > 0 ? sizes[k] / largest : 1;
    const bool drowned =
        found.undecided() && is_number(v[k]) && part <= noise_floor(track.accuracy);
    const bool nothing =
        judgement != Judgement::held && (part <= kFloorOfAccuracy * track.accuracy || drowned);
    if (nothing) noise = std::max(noise, part);
    if (!nothing && (!worst || rank(found) > rank(*worst))) worst = found;
  }
  if (!worst) worst = nothing_counts(track);
  worst->floor = noise;
  return *worst;
}

Finding ClaimCheck::cost(const Track& track, bool holds) const {
  const Bounded bound = track.at(0, claim_->value);
  const Bounded most = eased(bound, std::abs(bound.value), bound.bound);
  const double scale = bound.value;
  std::optional<Finding> worst;
  const auto rank = [](const Finding& finding) {
    return std::tuple(finding.violated(), finding.undecided(), finding.score);
  };
  for (std::size_t k = 0; k < track.samples(); ++k) {
    if (is_of_another(track, k)) continue;
    const Bounded cost = track.at(k, *claim_->cost);
    const Finding found = finding_at(track, k, cost, bound, scale, compare(cost, most, holds));
    if (!worst || rank(found) > rank(*worst)) worst = found;
  }
  const bool held = !worst->violated() && !worst->undecided();
  const std::size_t last = track.samples() - 1;
  // Its start, 0, says nothing of a run.
  if (held && worst->value <= 0)
    worst = finding_at(track, last, track.at(last, *claim_->cost), bound, scale, Judgement::held);
  return *worst;
}

Finding ClaimCheck::shrinks(const Track& track, bool holds) const {
  const std::size_t last = track.samples() - 1;
  const Bounded start = track.at(0, claim_->value);
  const Bounded end = track.at(last, claim_->value);
  const Bounded factor = track.at(0, *claim_->factor);
  Bounded bound{factor.value * start.value, 0};
  const double size = std::abs(start.value);
  // |f s - f' s'| <= |f| ds + df (|s| + ds), and the rounding of the product.
  bound.bound = std::abs(factor.value) * start.bound + factor.bound * (size + start.bound) +
                kUnitRoundoff * std::abs(bound.value);
  const double scale = bound.value;
  const Bounded most = eased(bound, std::abs(bound.value), bound.bound);
  const bool nothing = start.value == 0;
  const bool lost = track.termination == Termination::lost;
  const Judgement judgement = lost      ? Judgement::undecided
                              : nothing ? Judgement::held
                                        : compare(end, most, holds);
  Finding found = finding_at(track, last, end, bound, nothing ? 0 : scale, judgement);
  found.ended = lost;
  return found;
}

}  // namespace gainsmith::claims
