#include "claims/claim_check.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <type_traits>
#include <utility>

#include "claims/tolerances.h"

namespace gainsmith::claims {

namespace {

using bounded::Bounded;
using bounded::Track;
using Eigen::Index;

template <class Scalar>
constexpr bool is_double = std::is_same_v<Scalar, double>;

template <class Scalar>
int digits_of() {
  return is_double<Scalar> ? kDoubleDigits : kQuadDigits;
}

template <class Scalar>
bool is_number(const Bounded<Scalar>& value) {
  using std::isnan;
  return !isnan(value.value);
}

/// What is certain of value <= bound.
template <class Scalar>
Judgement compare(const Bounded<Scalar>& value, const Bounded<Scalar>& bound) {
  if (!is_number(value) || !is_number(bound))
    return is_double<Scalar> ? Judgement::undecided : Judgement::violated;
  const double excess = static_cast<double>(value.value - bound.value);
  const double rounding = (value.bound + bound.bound) * bounded::kBoundSlack +
                          2 * bounded::unit_roundoff<Scalar>() * std::abs(excess);
  if (excess > rounding) return Judgement::violated;
  if (excess <= -rounding || (excess <= 0 && value.bound + bound.bound == 0))
    return Judgement::held;
  return Judgement::undecided;
}

template <class Scalar>
Finding finding_at(const Track<Scalar>& track, std::size_t sample, const Bounded<Scalar>& value,
                   const Bounded<Scalar>& bound, double scale, Judgement judgement) {
  Finding finding;
  finding.judgement = judgement;
  finding.value = static_cast<double>(value.value);
  finding.bound = static_cast<double>(bound.value);
  // What overflowed bounds nothing; a difference of two such is no number.
  finding.rounding = value.bound + bound.bound;
  if (std::isnan(finding.rounding)) finding.rounding = bounded::no_bound();
  finding.t = track.t[sample];
  finding.j = track.j[sample];
  finding.digits = digits_of<Scalar>();
  finding.estimated = track.accuracy > 0;
  const double excess = static_cast<double>(value.value - bound.value);
  const bool violated = judgement == Judgement::violated;
  if (std::isnan(excess) || (violated && scale == 0)) {
    finding.score = bounded::no_bound();
  } else {
    finding.score = scale == 0 ? -1 : excess / std::abs(scale);
  }
  return finding;
}

template <class Scalar>
Bounded<Scalar> sum(const Bounded<Scalar>& a, const Bounded<Scalar>& b) {
  Bounded<Scalar> result{a.value + b.value, a.bound + b.bound};
  if (a.value != Scalar(0) && b.value != Scalar(0))
    result.bound += bounded::unit_roundoff<Scalar>() * bounded::size_of(result.value);
  return result;
}

template <class Scalar>
std::optional<Value<Scalar>> make_value(const std::optional<JudgedFunction>& function,
                                        const bounded::BoundedSystem<Scalar>& system) {
  if (!function) return std::nullopt;
  return Value<Scalar>(*function, system);
}

}  // namespace

std::string to_string(Judgement judgement) {
  switch (judgement) {
    case Judgement::held:
      return "held";
    case Judgement::violated:
      return "violated";
    case Judgement::undecided:
      return "undecided";
  }
  return "?";
}

JudgedClaim judged_claim(const Claim& claim, const std::function<JudgedFunction()>& next) {
  JudgedClaim judged;
  judged.name = claim.name;
  judged.kind = claim.kind;
  judged.value = next();
  if (claim.flow_cost) judged.flow_cost = next();
  if (claim.jump_cost) judged.jump_cost = next();
  if (claim.factor) judged.factor = next();
  if (claim.bound) judged.bound = next();
  judged.after = claim.after;
  judged.over = claim.over;
  judged.tolerance = claim.tolerance;
  return judged;
}

template <class Scalar>
ClaimCheck<Scalar>::ClaimCheck(const JudgedClaim& claim,
                               const bounded::BoundedSystem<Scalar>& system)
    : claim_(&claim),
      system_(&system),
      value_(claim.value, system),
      jump_cost_(make_value(claim.jump_cost, system)),
      factor_(make_value(claim.factor, system)),
      bound_(make_value(claim.bound, system)),
      terms_(make_value(claim.terms, system)) {
  if (claim.flow_cost && !claim.integral && !claim.accumulated)
    flow_cost_.emplace(*claim.flow_cost, system);
}

template <class Scalar>
Finding ClaimCheck<Scalar>::operator()(const Track& track) {
  Finding finding = judged(track);
  finding.tolerance = claim_->tolerance;
  return finding;
}

template <class Scalar>
Finding ClaimCheck<Scalar>::judged(const Track& track) {
  switch (claim_->kind) {
    case model::ClaimKind::nonincreasing:
      return nonincreasing(track);
    case model::ClaimKind::cost:
      return cost(track);
    case model::ClaimKind::shrinks:
      return shrinks(track);
    case model::ClaimKind::below:
    case model::ClaimKind::above:
      return bounded(track);
  }
  return {};
}

/// What must not be exceeded, and what the tolerance forgives: a part of a size, known up to an
/// error.
template <class Scalar>
Bounded<Scalar> ClaimCheck<Scalar>::eased(const Bounded& bound, double size, double error) const {
  if (claim_->tolerance == 0) return bound;
  const double forgiven = claim_->tolerance * size;
  const double rounded = bounded::unit_roundoff<double>() * forgiven +
                         bounded::unit_roundoff<Scalar>() * bounded::size_of(bound.value);
  return {bound.value + Scalar(forgiven), bound.bound + claim_->tolerance * error + 2 * rounded};
}

/// Whether a sample is there for the sake of one value.
template <class Scalar>
bool ClaimCheck<Scalar>::is_own(const Track& track, std::size_t sample) const {
  return !track.sampled_for.empty() && track.sampled_for[sample] != Track::kForAll;
}

/// Whether it may lie so near the one before that no value has changed in between.
template <class Scalar>
bool ClaimCheck<Scalar>::is_crowded(const Track& track, std::size_t sample) const {
  return is_own(track, sample) ||
         (!track.within_instant.empty() && track.within_instant[sample] != 0);
}

/// Whether it is there for the sake of another.
template <class Scalar>
bool ClaimCheck<Scalar>::is_of_another(const Track& track, std::size_t sample) const {
  return is_own(track, sample) && track.sampled_for[sample] != claim_->sampled_for;
}

template <class Scalar>
bool ClaimCheck<Scalar>::counts(const Track& track, std::size_t sample) const {
  if (track.t[sample] < claim_->after || is_of_another(track, sample)) return false;
  if (!claim_->over) return true;
  return sample > 0 && track.moves[sample - 1].jump &&
         track.moves[sample - 1].event == *claim_->over;
}

template <class Scalar>
std::vector<Bounded<Scalar>> ClaimCheck<Scalar>::values(const Track& track) {
  std::vector<Bounded> values;
  for (std::size_t k = 0; k < track.samples(); ++k)
    values.push_back(k > 0 && !claim_->value.varies(track.moves[k - 1].jump) ? values.back()
                                                                             : value_(track, k));
  return values;
}

/// Whether the value at a sample may differ from that at one before, the last that counts.
template <class Scalar>
bool ClaimCheck<Scalar>::may_change(const Track& track, std::size_t before, std::size_t sample,
                                    const std::vector<Bounded>& v) const {
  if (claim_->over) return true;
  bool jump = false;
  bool varies = false;
  for (std::size_t k = before; k < sample; ++k) {
    jump = jump || track.moves[k].jump;
    varies = varies || claim_->value.varies(track.moves[k].jump);
  }
  if (!varies) return false;
  const auto is_fixed = [&](std::size_t k) {
    const auto size = static_cast<std::size_t>(track.size);
    return !track.is_fixed.empty() &&
           track.is_fixed[k * size + static_cast<std::size_t>(claim_->sampled_for)] != 0;
  };
  const bool same = v[sample].value == v[before].value;
  if (is_fixed(sample) && is_fixed(before) && same) return false;
  // Jumps of others leave it bit by bit.
  return !(jump && track.accuracy > 0 && same);
}

namespace {

/// The part of a value at the start below which what is undecided is noise, by the accuracy of the
/// integration; 0: flows are not integrated.
double noise_floor(double accuracy) { return accuracy > 0 ? std::max(accuracy, kNoiseOfRuns) : 0; }

}  // namespace

template <class Scalar>
Finding ClaimCheck<Scalar>::nonincreasing(const Track& track) {
  const std::vector<Bounded> v = values(track);
  std::size_t first = 0;
  while (first < v.size() && !counts(track, first)) ++first;
  if (first == v.size()) return nothing_counts(track);
  const double scale = static_cast<double>(v[first].value);
  const bool integrated = track.accuracy > 0;
  const double floor = integrated          ? kFloorOfAccuracy * track.accuracy
                       : is_double<Scalar> ? 0
                                           : kFloorOfDigits;
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
    Judgement judgement = compare(v[k], eased(high, bounded::size_of(high.value), high.bound));
    if (judgement != Judgement::violated) {
      judgement = compare(v[k], eased(low, bounded::size_of(low.value), low.bound));
      if (judgement == Judgement::violated) judgement = Judgement::undecided;
    }
    if (judgement == Judgement::undecided && is_crowded(track, k) && is_number(v[k]) &&
        static_cast<double>(v[k].value - high.value) <= kGrown * (v[k].bound + high.bound))
      judgement = Judgement::held;
    const double top = bounded::size_of(v[k].value) + v[k].bound;
    const double least = judgement == Judgement::undecided
                             ? std::max(floor, noise_floor(track.accuracy))
                         : integrated ? floor
                                      : 0;
    if (judgement != Judgement::held && scale != 0 && top <= least * std::abs(scale)) {
      noise = std::max(noise, top / std::abs(scale));
    } else if (judgement != Judgement::held) {
      const Finding found = finding_at(track, k, v[k], high, scale, judgement);
      const auto rank = [](const Finding& one) { return std::pair(one.violated(), one.score); };
      if (!worst || rank(found) > rank(*worst)) worst = found;
    }
    if (v[k].value - low.value < Scalar(v[k].bound - low.bound)) low = v[k];
    if (v[k].value - high.value < Scalar(high.bound - v[k].bound)) high = v[k];
  }
  if (!worst && !is_number(v[first]))
    worst = finding_at(track, first, v[first], v[first], scale, compare(v[first], v[first]));
  if (!worst) worst = finding_at(track, last, v[last], v[first], scale, Judgement::held);
  worst->floor = noise;
  return *worst;
}

template <class Scalar>
Finding ClaimCheck<Scalar>::nothing_counts(const Track& track) const {
  Finding finding;
  finding.looked = false;
  finding.score = -bounded::no_bound();
  finding.t = track.t.back();
  finding.j = track.j.back();
  finding.digits = digits_of<Scalar>();
  finding.estimated = track.accuracy > 0;
  return finding;
}

/// The sizes of the terms of the value at samples that count, with their errors; 0 at the others.
/// Without terms they are those of the value itself.
template <class Scalar>
std::vector<double> ClaimCheck<Scalar>::term_sizes(const Track& track,
                                                   const std::vector<Bounded>& v) {
  std::vector<double> sizes(v.size(), 0);
  for (std::size_t k = 0; k < v.size(); ++k) {
    if (!counts(track, k) || !is_number(v[k])) continue;
    const Bounded terms = terms_ ? (*terms_)(track, k) : v[k];
    sizes[k] = bounded::size_of(terms.value) + v[k].bound;
  }
  return sizes;
}

/// The value against the bound b at every sample that counts; `above` is `below` of what is
/// negated.
template <class Scalar>
Finding ClaimCheck<Scalar>::bounded(const Track& track) {
  const std::vector<Bounded> v = values(track);
  const Bounded b = (*bound_)(track, 0);
  const bool above = claim_->kind == model::ClaimKind::above;
  // The same in all runs, so that their scores are compared as their values are.
  const double scale = b.value == Scalar(0) ? 1 : bounded::size_of(b.value);
  const std::vector<double> sizes =
      b.value == Scalar(0) ? term_sizes(track, v) : std::vector<double>();
  double largest = 0;
  for (const double size : sizes)
    if (std::isfinite(size)) largest = std::max(largest, size);
  std::optional<Finding> worst;
  double noise = 0;
  const auto rank = [](const Finding& one) {
    return std::tuple(one.violated(), one.undecided(), one.score);
  };
  for (std::size_t k = 0; k < v.size(); ++k) {
    if (!counts(track, k)) continue;
    const bool zero = b.value == Scalar(0);
    const double size = zero ? sizes[k] : scale;
    const double error = zero ? 2 * v[k].bound : b.bound;
    const Judgement judgement =
        above ? compare(b, eased(v[k], size, error)) : compare(v[k], eased(b, size, error));
    Finding found = finding_at(track, k, above ? b : v[k], above ? v[k] : b, scale, judgement);
    if (above) std::swap(found.value, found.bound);
    const double part = largest > 0 ? sizes[k] / largest : 1;
    const bool drowned =
        found.undecided() && is_number(v[k]) && part <= noise_floor(track.accuracy);
    const bool nothing = judgement != Judgement::held && track.accuracy > 0 &&
                         (part <= kFloorOfAccuracy * track.accuracy || drowned);
    if (nothing) noise = std::max(noise, part);
    if (!nothing && (!worst || rank(found) > rank(*worst))) worst = found;
  }
  if (!worst) worst = nothing_counts(track);
  worst->floor = noise;
  return *worst;
}

template <class Scalar>
Bounded<Scalar> ClaimCheck<Scalar>::rest_cost(const Track& track, std::size_t move) {
  const bounded::Series<Scalar>& series = system_->steps.rest_integrals[*claim_->integral];
  const double sigma = series.share(track.moves[move].step.length);
  series.sum(sigma, rest_form_.matrix);
  // As if all errors of the sum were rounding of its elements.
  const double share = sigma / bounded::unit_roundoff<Scalar>();
  rest_form_.sizes.resize(series.errors.rows(), series.errors.cols());
  for (Index e = 0; e < series.errors.size(); ++e)
    rest_form_.sizes(e) = bounded::size_of(rest_form_.matrix(e)) + share * series.errors(e);
  return bounded::value_of<Scalar>(rest_form_, track.state(move), track.bound(move));
}

template <class Scalar>
Bounded<Scalar> ClaimCheck<Scalar>::step_cost(const Track& track, std::size_t move) {
  if (!claim_->flow_cost || claim_->accumulated) return {};
  if (flow_cost_) return (*flow_cost_)(track, move);
  const bounded::FlowStep& step = track.moves[move].step;
  if (step.level == bounded::FlowStep::kRest) return rest_cost(track, move);
  const auto& integrals = system_->steps.integrals[*claim_->integral];
  return bounded::value_of<Scalar>(integrals[static_cast<std::size_t>(step.level)],
                                   track.state(move), track.bound(move));
}

template <class Scalar>
std::vector<Bounded<Scalar>> ClaimCheck<Scalar>::running_cost(const Track& track) {
  std::vector<Bounded> cost(track.samples());
  for (std::size_t k = 0; k + 1 < track.samples(); ++k) {
    Bounded more;
    if (!track.moves[k].jump) {
      more = step_cost(track, k);
    } else if (jump_cost_) {
      more = (*jump_cost_)(track, k);
    }
    cost[k + 1] = sum(cost[k], more);
  }
  if (!claim_->accumulated) return cost;
  for (std::size_t k = 0; k < track.samples(); ++k)
    cost[k] =
        sum(cost[k], {track.state(k)(*claim_->accumulated), track.bound(k)(*claim_->accumulated)});
  return cost;
}

template <class Scalar>
Finding ClaimCheck<Scalar>::cost(const Track& track) {
  const std::vector<Bounded> c = running_cost(track);
  const Bounded bound = value_(track, 0);
  const Bounded most = eased(bound, bounded::size_of(bound.value), bound.bound);
  const double scale = static_cast<double>(bound.value);
  std::optional<Finding> worst;
  const auto rank = [](const Finding& one) {
    return std::tuple(one.violated(), one.undecided(), one.score);
  };
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (is_of_another(track, k)) continue;
    const Finding found = finding_at(track, k, c[k], bound, scale, compare(c[k], most));
    if (!worst || rank(found) > rank(*worst)) worst = found;
  }
  const bool held = !worst->violated() && !worst->undecided();
  const std::size_t last = c.size() - 1;
  // Its start, 0, says nothing of a run.
  if (held && worst->value <= 0)
    worst = finding_at(track, last, c[last], bound, scale, Judgement::held);
  return *worst;
}

template <class Scalar>
Finding ClaimCheck<Scalar>::shrinks(const Track& track) {
  const std::size_t last = track.samples() - 1;
  const Bounded start = value_(track, 0);
  const Bounded end = value_(track, last);
  const Bounded factor = (*factor_)(track, 0);
  Bounded bound{factor.value * start.value, 0};
  const double size = bounded::size_of(start.value);
  bound.bound = bounded::size_of(factor.value) * start.bound + factor.bound * (size + start.bound) +
                bounded::unit_roundoff<Scalar>() * bounded::size_of(bound.value);
  const double scale = static_cast<double>(bound.value);
  const Bounded most = eased(bound, bounded::size_of(bound.value), bound.bound);
  const bool nothing = start.value == Scalar(0);
  const bool lost = track.termination == bounded::Termination::lost;
  const Judgement judgement = lost      ? Judgement::undecided
                              : nothing ? Judgement::held
                                        : compare(end, most);
  Finding found = finding_at(track, last, end, bound, nothing ? 0 : scale, judgement);
  found.ended = lost;
  return found;
}

template class ClaimCheck<double>;
template class ClaimCheck<DoubleDouble>;

}  // namespace gainsmith::claims
