#include "ode/explicit_steps.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ode/dormand_prince.h"
#include "ode/step_control.h"
#include "ode/tolerances.h"

namespace gainsmith::ode {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr Index kAll = static_cast<Index>(kStages) + 4;
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kNever = std::numeric_limits<double>::infinity();

/// sum_j weights_j k_j.
template <class Weights, class Stages>
void add_up(const Weights& weights, const Stages& k, VectorXd& sum) {
  sum = weights[0] * k.col(0);
  for (std::size_t j = 1; j < weights.size(); ++j)
    if (weights[j] != 0) sum += weights[j] * k.col(static_cast<Index>(j));
}

/// Of e / allowed.
double mean_square(const VectorXd& e, const Eigen::ArrayXd& allowed) {
  return (e.array() / allowed).square().mean();
}

}  // namespace

ExplicitSteps::ExplicitSteps(GuardedRate& rate)
    : rate_(&rate), k_(rate.size(), kAll), terms_(rate.size(), kDegree + 1) {}

void ExplicitSteps::start(double t, const VectorXd& x, double last, double relative,
                          const VectorXd& absolute, double longest) {
  from_ = t_ = t;
  x_ = x;
  last_ = last;
  relative_ = relative;
  absolute_ = absolute;
  longest_ = longest;
  short_ = free_ = 0;
  has_first_ = false;
  h_ = 0;
  terms_.setZero();
  terms_.col(0) = x;
}

Eigen::ArrayXd ExplicitSteps::allowed(const VectorXd& other) const {
  const double least = forgives_ ? relative_ * x_.lpNorm<Eigen::Infinity>() : 0;
  return absolute_.array().max(least) + relative_ * x_.array().abs().max(other.array().abs());
}

double ExplicitSteps::first_length() {
  const double most = std::min(last_ - t_, longest_);
  const auto slope = k_.col(0).array().abs();
  const auto size = x_.array().abs();
  // An element changes in the time of x/x' or in that of x'/x'', whichever is longer.
  Eigen::ArrayXd lasts = (slope > 0).select(size / slope, most);
  const double first =
      std::clamp(0.01 * (size > 0).select(lasts, most).minCoeff(), 1e-6 * most, 0.01 * most);
  at_ = x_ + first * k_.col(0);
  if (!rate_->at(t_ + first, at_, k_.col(1).data())) return first;
  const auto changed = (k_.col(1) - k_.col(0)).array().abs();
  lasts = lasts.max((changed > 0).select(first * slope / changed, most));
  return std::clamp(0.3 * lasts.minCoeff(), first, most);
}

ExplicitSteps::Result ExplicitSteps::step() {
  if (!has_first_) {
    if (!rate_->at(t_, x_, k_.col(0).data())) return Result::failed;
    has_first_ = true;
    h_ = first_length();
  }
  forgives_ = false;
  for (bool rejected = false;; rejected = true) {
    const double rest = last_ - t_;
    double h = std::min(h_, longest_);
    if (h >= rest)
      h = rest;
    else if (2 * h > rest)
      h = rest / 2;
    if (h < rest && h <= 4 * kEpsilon * std::max(std::abs(t_), rest)) {
      // An element that has died down, or begins, is no reason to stop.
      if (forgives_) return Result::failed;
      forgives_ = true;
      h_ = first_length();
      continue;
    }
    if (!try_step(h)) {
      h_ = h / 4;
      continue;
    }
    auto [off, is_noise] = error(h);
    if (off <= 1) {
      if (!try_inner(h)) {
        h_ = h / 4;
        continue;
      }
      off = std::max(off, inner_error(h));
    }
    if (!(off <= 1)) {
      h_ = h * std::min(std::isfinite(off) ? step_factor(off) : 0.2, 0.9);
      continue;
    }
    const bool kept_short = is_kept_short(h, is_noise || forgives_);
    const double factor = step_factor(off);
    // A step that was cut at the end says little about how long the next one may be.
    h_ = std::max(h < h_ && !rejected ? h_ : 0, h * (rejected ? std::min(factor, 1.0) : factor));
    from_ = t_;
    t_ = h == rest ? last_ : t_ + h;
    x_ = next_;
    k_.col(0) = k_.col(kStages);
    return kept_short ? Result::stiff : Result::made;
  }
}

bool ExplicitSteps::try_step(double h) {
  for (std::size_t stage = 1; stage <= kStages; ++stage) {
    VectorXd& to = stage == kStages ? next_ : stage + 1 == kStages ? before_next_ : at_;
    add_up(kStageWeights[stage - 1], k_, to);
    to = x_ + h * to;
    if (!rate_->at(t_ + kStageTimes[stage] * h, to, k_.col(static_cast<Index>(stage)).data()))
      return false;
  }
  return true;
}

ExplicitSteps::Error ExplicitSteps::error(double h) const {
  const Eigen::ArrayXd scale = allowed(next_);
  VectorXd order5(x_.size());
  add_up(kErrorOfOrder5, k_, order5);
  StageWeights weights = kStageWeights.back();
  weights[0] -= kOrder3Of1;
  weights[8] -= kOrder3Of9;
  weights[11] -= kOrder3Of12;
  VectorXd order3(x_.size());
  add_up(weights, k_, order3);
  const double square5 = mean_square(order5, scale);
  const double square3 = mean_square(order3, scale);
  const double both = square5 + 0.01 * square3;
  if (!(both > 0)) return {};
  const double part = h * square5 / std::sqrt(both);
  // By their orders the first is far below the second. Where both hardly err this is rounding.
  return {part, part > 1e-3 && square5 > 0.1 * square3};
}

bool ExplicitSteps::try_inner(double h) {
  for (std::size_t i = 0; i < kInnerStages.size(); ++i) {
    const std::size_t stage = kStages + 1 + i;
    add_up(kInnerStages[i], k_, at_);
    at_ = x_ + h * at_;
    if (!rate_->at(t_ + kStageTimes[stage] * h, at_, k_.col(static_cast<Index>(stage)).data()))
      return false;
  }
  // x(t + s h) = t0 + s (t1 + (1 - s) (t2 + s (t3 + (1 - s) (t4 + ...)))), s in [0, 1]: by t0 to t3
  // it has x and f at both ends, and t4 to t7 follow from the stages.
  terms_.col(0) = x_;
  terms_.col(1) = next_ - x_;
  terms_.col(2) = h * k_.col(0) - terms_.col(1);
  terms_.col(3) = terms_.col(1) - h * k_.col(kStages) - terms_.col(2);
  for (std::size_t i = 0; i < kInnerTerms.size(); ++i) {
    add_up(kInnerTerms[i], k_, at_);
    terms_.col(4 + static_cast<Index>(i)) = h * at_;
  }
  return true;
}

/// kWithin |p'(s) - h f(p(s))| at s = 0.6, with p and p' by Horner's rule on the nested form.
double ExplicitSteps::inner_error(double h) {
  constexpr double share = 0.6;
  VectorXd value = terms_.col(kDegree);
  VectorXd slope = VectorXd::Zero(value.size());
  for (int term = kDegree - 1; term >= 0; --term) {
    const double factor = term % 2 == 0 ? share : 1 - share;
    slope = (term % 2 == 0 ? 1 : -1) * value + factor * slope;
    value = terms_.col(term) + factor * value;
  }
  if (!rate_->at(t_ + share * h, value, at_.data())) return kNever;
  return kWithin * std::sqrt(mean_square(slope - h * at_, allowed(next_)));
}

bool ExplicitSteps::is_kept_short(double h, bool by_noise) {
  // |h lambda| > 6.1, the limit of stability, for fifteen steps without six others in a row: as in
  // DOP853 (Hairer and Wanner: "Solving Ordinary Differential Equations II", section IV.2).
  const double moved = (next_ - before_next_).norm();
  const double changed = (k_.col(kStages) - k_.col(kStages - 1)).norm();
  if (by_noise || h * changed > 6.1 * moved) {
    free_ = 0;
    ++short_;
  } else if (++free_ == 6) {
    short_ = 0;
  }
  return short_ >= 15 && last_ - t_ > kManySteps * h;
}

void ExplicitSteps::within(double t, VectorXd& x) const {
  const double share = t_ > from_ ? (t - from_) / (t_ - from_) : 1;
  x = terms_.col(kDegree);
  for (int term = kDegree - 1; term >= 0; --term)
    x = terms_.col(term) + (term % 2 == 0 ? share : 1 - share) * x;
}

}  // namespace gainsmith::ode
