#include "judge/step.h"

#include <utility>

#include "expr/program/number_type.h"
#include "judge/tolerances.h"

namespace gainsmith::judge {

namespace {

/// Whether all changes are at most this share of what is allowed.
bool is_within(const numbers::Matrix& change, const Eigen::VectorXd& allowed, double share) {
  return (change.array().abs().colwise() / allowed.array() <= share).all();
}

}  // namespace

StepAgain::StepAgain(Texts& texts, const MovingElements& moving, const hybrid::DenseStep& step,
                     const Eigen::VectorXd& x, const Eigen::VectorXd& allowed)
    : texts_(&texts),
      moving_(&moving),
      step_(&step),
      x_(&x),
      allowed_(&allowed),
      h_(step.to - step.from),
      gauss_(
          static_cast<Eigen::Index>(moving.active.size()),
          [this](double t, const Eigen::VectorXd& y, Eigen::VectorXd& out) { rate(t, y, out); }) {}

std::optional<StepAgain::Quarters> StepAgain::operator()() {
  const auto agrees = [&](const std::optional<Quarters>& found) {
    return found && is_within(recorded_quarters() - *found, *allowed_, kCertain);
  };
  // A step that agrees needs no other witness. One that does not is judged by the texts alone.
  compiled_ = is_compiled_right();
  std::optional<Quarters> first = halves();
  if (agrees(first)) return first;
  if (std::exchange(compiled_, false)) {
    first = halves();
    if (agrees(first)) return first;
  }
  const std::optional<Quarters> finer = settled(first);
  return finer ? finer : straight();
}

/// h |rate of the texts - rate of the programs| <= kCertain allowed, at both ends.
bool StepAgain::is_compiled_right() {
  Eigen::VectorXd of_text, of_program;
  try {
    for (const double t : {step_->from, step_->to}) {
      const Eigen::VectorXd x = (*step_)(t);
      texts_->rate(x, of_text);
      texts_->compiled_rate(x, of_program);
      const Eigen::VectorXd difference = h_ * (of_text - of_program)(moving_->active);
      if (!is_within(difference, *allowed_, kCertain)) return false;
    }
  } catch (const expr::EvaluationError&) {
    return false;
  }
  return true;
}

void StepAgain::rate(double t, const Eigen::VectorXd& y, Eigen::VectorXd& out) {
  all_ = *x_ + moving_->clocks * (t - step_->from);
  all_(moving_->active) = y;
  if (compiled_)
    texts_->compiled_rate(all_, rates_);
  else
    texts_->rate(all_, rates_);
  out = rates_(moving_->active);
}

std::optional<Eigen::VectorXd> StepAgain::gauss(double t, const Eigen::VectorXd& y, double h) {
  return gauss_.step(t, y, h, *allowed_, [this](double at) { return recorded(at); });
}

std::optional<StepAgain::Quarters> StepAgain::halves() {
  Quarters result(moving_->active.size(), 4);
  Eigen::VectorXd y = (*x_)(moving_->active);
  for (int half = 0; half < 2; ++half) {
    const double t = step_->from + 0.5 * half * h_;
    const auto quarter = gauss(t, y, h_ / 4);
    const auto end = gauss(t, y, h_ / 2);
    if (!quarter || !end) return std::nullopt;
    result.col(2 * half) = *quarter;
    result.col(2 * half + 1) = y = *end;
  }
  return result;
}

StepAgain::Quarters StepAgain::recorded_quarters() const {
  Quarters result(moving_->active.size(), 4);
  for (int k = 0; k < 4; ++k)
    result.col(k) = recorded(k == 3 ? step_->to : step_->from + 0.25 * (k + 1) * h_);
  return result;
}

std::optional<StepAgain::Quarters> StepAgain::advance(int count) {
  Quarters result(moving_->active.size(), 4);
  Eigen::VectorXd y = (*x_)(moving_->active);
  for (int k = 0; k < count; ++k) {
    const auto next = gauss(step_->from + k * h_ / count, y, h_ / count);
    if (!next) return std::nullopt;
    y = *next;
    if ((4 * (k + 1)) % count == 0) result.col(4 * (k + 1) / count - 1) = y;
  }
  return result;
}

std::optional<StepAgain::Quarters> StepAgain::settled(std::optional<Quarters> coarse) {
  for (int count = 4; count <= kMostParts; count *= 2) {
    std::optional<Quarters> fine = advance(count);
    if (coarse && fine && is_within(*fine - *coarse, *allowed_, kCertain)) return fine;
    coarse = std::move(fine);
  }
  return std::nullopt;
}

/// x + t x'(middle), when h |x'| is within kCertain of what is allowed at both ends.
std::optional<StepAgain::Quarters> StepAgain::straight() {
  Eigen::VectorXd rate, middle;
  try {
    texts_->rate((*step_)(step_->from + h_ / 2), middle);
    for (const double t : {step_->from, step_->to}) {
      texts_->rate((*step_)(t), rate);
      if (!is_within(h_ * rate(moving_->active), *allowed_, kCertain)) return std::nullopt;
    }
  } catch (const expr::EvaluationError&) {
    return std::nullopt;
  }
  Quarters result(moving_->active.size(), 4);
  for (int k = 0; k < 4; ++k)
    result.col(k) = (*x_)(moving_->active) + 0.25 * (k + 1) * h_ * middle(moving_->active);
  return result;
}

}  // namespace gainsmith::judge
