#include "packs/claim_lane.h"

#include <algorithm>
#include <cmath>

#include "base/unit_roundoff.h"
#include "base/whole_number.h"
#include "claims/tolerances.h"
#include "hybrid/tolerances.h"
#include "packs/tolerances.h"

namespace gainsmith::packs {

namespace {

using model::ClaimKind;

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Where a value branches it goes up and down no faster than at the points.
double rise_at_branch(const StepSamples& samples) {
  return samples.length / 2 *
         std::max({std::abs(samples.start.rate), std::abs(samples.middle.rate),
                   std::abs(samples.end.rate)});
}

/// How far rounding may lead a value astray: 8 units of it, and kTermRounding of the sum of the
/// absolute values of its terms, which cancellation leaves visible.
double rounding(double value, double terms) {
  return 8 * kUnitRoundoff * std::abs(value) + hybrid::kTermRounding * terms;
}

}  // namespace

/// A norm that is compared once is compared by its square, which is smooth at 0: v^2 <= limit^2.
/// The error of the limit becomes 2 |limit| times as large.
void ClaimLane::begin(const PackClaim& claim, const PackSystem& pack, const PackAccuracy& accuracy,
                      double limit, double terms) {
  *this = ClaimLane();
  claim_ = &claim;
  tolerance_ = claim.tolerance;
  accuracy_ = accuracy.relative * pack.accuracy;
  noise_ = pack.accuracy;
  factor_ = pack.error_factor;
  always_ = claim.always;
  sign_ = claim.kind == ClaimKind::above ? -1 : 1;
  limit_ = sign_ * limit;
  limit_error_ = hybrid::kTermRounding * terms;
  if (!std::isfinite(limit)) open_ = true;
  if (!claim.squared) return;
  // Norms are nowhere below 0, and at 0 the size of the terms counts.
  if (!(limit > 0)) open_ = true;
  limit_error_ *= 2 * std::abs(limit);
  limit_ *= std::abs(limit);
}

/// (v - limit)/|limit|, or v where the limit is 0; of squares (sqrt(v) - b)/b with b =
/// sqrt(|limit|), so that scores of a norm are those of the norm itself.
double ClaimLane::score_of(double value) const {
  if (!claim_->squared) return (value - limit_) / scale();
  const double bound = std::sqrt(scale());
  return sign_ * (std::sqrt(std::fmax(0, sign_ * value)) - bound) / bound;
}

/// Two runs that differ by a part of the range of a value have nothing to do with each other.
void ClaimLane::check_parting(double value, double difference, double terms) {
  least_ = seen_ ? std::fmin(least_, value) : value;
  most_ = seen_ ? std::fmax(most_, value) : value;
  size_ = std::fmax(size_, std::fmax(std::abs(value), terms));
  seen_ = true;
  if (difference > claims::kParted * (most_ - least_) &&
      difference > claims::kPartedAccuracy * accuracy_ * size_)
    open_ = true;
}

/// error = factor max(last three |fine - coarse|) + rounding + late. A whole number that rests
/// along flows and is equal in both runs is exact.
ClaimLane::Known ClaimLane::known(const Reading& reading, bool jumped) {
  const double difference = std::abs(reading.fine - reading.coarse);
  if (jumped) differences_.fill(0);
  differences_ = {differences_[1], differences_[2], difference};
  check_parting(reading.fine, difference, reading.terms);
  const double largest = *std::max_element(differences_.begin(), differences_.end());
  const bool is_count = claim_->rests && largest == 0 && is_exact_whole(reading.fine);
  const double error =
      is_count ? 0 : factor_ * largest + rounding(reading.fine, reading.terms) + reading.late;
  if (!(error < kNever)) open_ = true;
  return {sign_ * reading.fine, error};
}

/// A jump that changes the value by rounding alone is no rise.
void ClaimLane::at(double t, const Reading& reading, std::optional<std::size_t> event) {
  const bool is_jump = event.has_value();
  Known value = known(reading, is_jump);
  const bool is_bound = value.value == limit_ && reading.fine == reading.coarse;
  if (!is_jump && claim_->starts_exact && is_bound) value.error = 0;
  if (!claims::is_after(t, is_jump, claim_->after) || (claim_->over && event != claim_->over))
    return;
  const double change = sampled_ && is_jump && !claim_->over ? value.value - last_.value : kNever;
  const bool is_rounding = std::abs(change) <= rounding(value.value, reading.terms);
  compare(value, reading.terms, change == 0, is_rounding);
}

void ClaimLane::along(double t, const StepSamples& samples, const pieces::StepPolynomial& along,
                      const Reading& end, bool breaks, bool halved) {
  const Known value = known(end, false);
  if (claim_->over || !claims::is_after(t, false, claim_->after)) return;
  const bool stays = samples.start.rate == 0 && samples.middle.rate == 0 && samples.end.rate == 0;
  const bool same = (stays || end.fine == end.coarse) && sampled_ && value.value == last_.value &&
                    samples.middle.value == samples.start.value;
  if (!sampled_ || same) return compare(value, end.terms, same, halved);
  if (claim_->kind == ClaimKind::nonincreasing)
    compare({samples.middle.value, value.error}, end.terms, false, true);
  compare(value, end.terms, false, halved);
  compare_within(samples, sign_ < 0 ? along.negated() : along, value, end.terms, breaks);
}

/// A claim that branches on the step is bounded by its rates there. The step says too little of
/// `below` and `above` where this bound passes the limit, or leaves the score uncertain by half of
/// kScore.
bool ClaimLane::is_blurred(double t, const StepSamples& samples,
                           const pieces::StepPolynomial& along, const Reading& end) const {
  if (claim_->over || always_ || !claims::is_after(t, false, claim_->after)) return false;
  if (claim_->kind == ClaimKind::nonincreasing) return !violated_;
  if (claim_->kind != ClaimKind::below && claim_->kind != ClaimKind::above) return false;
  const double possible = (sign_ < 0 ? along.negated() : along).largest() +
                          std::max(along.error(), rise_at_branch(samples));
  const double known = std::max(score_, score_of(sign_ * end.fine));
  return possible > limit_ + forgiven(end.terms) ||
         score_of(possible) > known + kScore * (1 + std::abs(known)) / 2;
}

/// The value at a point where the claim is made.
void ClaimLane::compare(Known value, double terms, bool same, bool crowded) {
  last_ = value;
  if (!sampled_) {
    sampled_ = true;
    first_ = low_ = high_ = value;
    if (claim_->kind == ClaimKind::nonincreasing || claim_->kind == ClaimKind::shrinks) return;
  }
  if (same) return;
  if (claim_->kind == ClaimKind::nonincreasing) {
    const double above_high = value.value - high_.value - tolerance_ * std::abs(high_.value);
    const double above_low = value.value - low_.value - tolerance_ * std::abs(low_.value);
    const double size = std::abs(value.value) + value.error;
    const double scale = std::abs(first_.value);
    const bool violates = above_high > value.error + high_.error;
    const bool holds = above_low <= -(value.error + low_.error) ||
                       (above_low <= 0 && value.error + low_.error == 0) ||
                       (crowded && above_high <= claims::kGrown * (value.error + high_.error));
    const double least = violates ? claims::kFloorOfAccuracy * noise_ : noise_;
    if (!holds && scale != 0 && size <= least * scale) {
      floor_ = std::max(floor_, size / scale);
    } else if (violates) {
      violated_ = true;
      const double part = (value.value - high_.value) / scale;
      score_ = scale == 0 ? kNever : std::max(score_, part);
    } else if (!holds && !violated_) {
      open_ = true;
    }
    if (value.value - value.error < low_.value - low_.error) low_ = value;
    if (value.value + value.error < high_.value + high_.error) high_ = value;
    return;
  }
  if (claim_->kind == ClaimKind::shrinks) return;
  const double excess = value.value - limit_ - forgiven(terms);
  const double error = value.error + limit_error_;
  score_ = std::max(score_, score_of(value.value));
  if (excess > error) violated_ = true;
  const bool is_close = std::abs(excess) <= error && !(excess <= 0 && error == 0);
  if (is_close && !violated_) open_ = true;
}

/// The value between the points of a step. `along`: as it is compared, with sign_.
void ClaimLane::compare_within(const StepSamples& samples, const pieces::StepPolynomial& along,
                               Known end, double terms, bool breaks) {
  const double error =
      end.error + limit_error_ + std::max(along.error(), breaks ? rise_at_branch(samples) : 0);
  if (claim_->kind == ClaimKind::shrinks) return;
  if (claim_->kind == ClaimKind::nonincreasing) {
    if (violated_) return;
    const double allowed = std::fmax(claims::kGrown * end.error, rounding(along.largest(), terms));
    const double left = low_.value + tolerance_ * std::abs(low_.value) - samples.start.value;
    // The rate is off by four times what the value is over a step.
    if (!breaks &&
        (along.falls(4 * along.error()) || (along.rise() <= allowed && along.error() <= allowed) ||
         along.rise() + along.error() + end.error + low_.error <= left))
      return;
    if (std::abs(along.largest()) + error <= noise_ * std::abs(first_.value)) return;
    open_ = true;
    return;
  }
  const double most = limit_ + forgiven(terms);
  if (breaks) possible_score_ = std::max(possible_score_, score_of(along.largest() + error));
  const bool may_exceed = along.largest() + error > most;
  if (!may_exceed && score_of(along.largest()) <= score_) return;
  // From a start that has been compared; noise drawn anew makes a start that has not.
  const bool is_known = score_of(along.coefficients().front()) <= score_;
  if (is_known && !breaks && along.falls(4 * along.error())) return;
  const pieces::StepPolynomial::Highest highest = along.highest();
  score_ = std::max(score_, score_of(highest.attained));
  // The careful run compares costs at samples alone.
  if (highest.attained - error > most && claim_->kind != ClaimKind::cost) violated_ = true;
  // A violation at a point is certain without what lies between.
  const bool certain = violated_ || end.value - most > end.error + limit_error_;
  if (highest.most + error > most && !certain) open_ = true;
}

claims::Finding ClaimLane::finding() const {
  claims::Finding finding;
  finding.judgement = violated_ && !always_ ? claims::Judgement::violated : claims::Judgement::held;
  finding.sampled = sampled_;
  finding.score = score_;
  finding.floor = floor_;
  finding.tolerance = tolerance_;
  return finding;
}

/// Takes over the course of a run that was made in closed form, and compares its end.
void ClaimLane::finish(const Course& course) {
  sampled_ = course.sampled;
  violated_ = course.violated;
  floor_ = course.floor;
  first_ = {course.first, course.first_error};
  last_ = {course.last, course.last_error};
  const bool is_bounded = claim_->kind == ClaimKind::below || claim_->kind == ClaimKind::above;
  if (sampled_ && is_bounded) score_ = score_of(course.peak);
  finish();
}

void ClaimLane::finish() {
  if (!sampled_ || open_) return;
  // How near a run comes is what the worst one is chosen by.
  if (possible_score_ > score_ + kScore * (1 + std::abs(score_))) open_ = true;
  const double scale = std::abs(first_.value);
  if (claim_->kind == ClaimKind::cost && limit_ == 0) score_ = violated_ ? kNever : -1;
  // A cost that is never positive, as far as that is known: the whole of it counts.
  if (claim_->kind == ClaimKind::cost && limit_ > 0 && score_ <= -1 + noise_)
    score_ = (last_.value - limit_) / limit_;
  if (claim_->kind == ClaimKind::nonincreasing && !violated_)
    score_ = scale == 0 ? -1 : (last_.value - first_.value) / scale;
  if (claim_->kind != ClaimKind::shrinks) return;
  const double goal = limit_ * first_.value;
  if (first_.value == 0) {
    score_ = -1;
    return;
  }
  const double error = last_.error + std::abs(limit_) * first_.error;
  const double excess = last_.value - goal - tolerance_ * std::abs(goal);
  score_ = goal == 0 ? kNever : (last_.value - goal) / std::abs(goal);
  if (claim_->squared && goal > 0) score_ = std::sqrt(std::fmax(0, last_.value) / goal) - 1;
  if (excess > error) violated_ = true;
  if (std::abs(excess) <= error) open_ = true;
}

}  // namespace gainsmith::packs
