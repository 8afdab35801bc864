#include "hybrid/judged_flow.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "expr/number_type.h"

namespace gainsmith::hybrid::judging {

namespace {

using V = model::Dynamics::VariableKind;

constexpr double kRounding = 1e-13;
constexpr double kRoundingOfAccuracy = 1e-4;
constexpr double kJoint = 1e-12;  ///< between a sum of polynomials and a recorded value
constexpr double kFactor = 100;   ///< of the accuracy
constexpr int kFinest = 256;      ///< Gauss steps in one step
constexpr int kInner = 16;        ///< points in a step

bool is_clock(V kind) { return kind == V::time || kind == V::since || kind == V::left; }

}  // namespace

Eigen::VectorXd step_sizes(const JudgedTexts& texts, const DenseStep& step) {
  return texts.by_variable(step.coefficients.cwiseAbs().rowwise().sum());
}

Eigen::VectorXd time_rounding_at(JudgedTexts& texts, double t, const Eigen::VectorXd& x) {
  Eigen::VectorXd rate;
  try {
    texts.rate(x, rate);
  } catch (const expr::EvaluationError&) {
    return Eigen::VectorXd::Zero(x.size());
  }
  return time_rounding(t, t) * rate.cwiseAbs();
}

Eigen::VectorXd rounding_at(JudgedTexts& texts, double t, const Eigen::VectorXd& x,
                            const Eigen::VectorXd& sizes) {
  Eigen::VectorXd result = kRounding * sizes + kRoundingOfAccuracy * texts.accuracy(sizes) +
                           time_rounding_at(texts, t, x);
  const std::vector<bool> flowing = texts.flowing(x);
  for (std::size_t v = 0; v < flowing.size(); ++v)
    if (!flowing[v] && !is_clock(texts.dynamics.variables[v].kind)) texts.part(result, v).setZero();
  return result;
}

FlowCheck::FlowCheck(JudgedTexts& texts, Faults& faults)
    : texts_(texts), faults_(faults), clocks_(Eigen::VectorXd::Zero(texts.layout.size)) {
  for (std::size_t v = 0; v < texts.dynamics.variables.size(); ++v)
    if (is_clock(texts.dynamics.variables[v].kind))
      texts.part(clocks_, v).setConstant(texts.is(v, V::left) ? -1 : 1);
}

Eigen::VectorXd FlowCheck::active_part(const Eigen::VectorXd& x) const { return x(active_); }

void FlowCheck::report(double t, const std::string& what, const Eigen::VectorXd& size,
                       const Eigen::VectorXd& allowed) {
  for (const Slot& slot : texts_.layout.slots)
    for (Eigen::Index i = slot.offset; i < slot.offset + slot.shape.size(); ++i)
      faults_.check(part_, t, what + ": " + slot.name, size(i), allowed(i));
}

void FlowCheck::operator()(std::size_t part, const FlowPiece& piece) {
  part_ = part;
  flowing_ = texts_.flowing(piece.start);
  active_.clear();
  for (std::size_t v = 0; v < flowing_.size(); ++v)
    for (Eigen::Index i = 0; flowing_[v] && i < texts_.layout.slots[v].shape.size(); ++i)
      active_.push_back(texts_.layout.slots[v].offset + i);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(texts_.layout.size);
  Eigen::VectorXd largest = sum;
  Eigen::VectorXd x = piece.start;
  for (const DenseStep& step : piece.steps) {
    const Eigen::VectorXd sizes = step_sizes(texts_, step);
    largest = largest.cwiseMax(sizes);
    Eigen::VectorXd from = step(step.from);
    check_joint(x, step.from, from, sizes, &step != &piece.steps.front());
    check_rest(step, from, sizes);
    texts_.settle(piece.start, from);
    check_step(step, from, sizes, sum);
    x = step(step.to);
  }
  check_joint(x, piece.to(), piece.end, largest, false);
  const double steps = static_cast<double>(piece.steps.size());
  report(piece.to(), "a flow drifts away from its text", sum.cwiseAbs(),
         (kFactor + 10 * steps) * texts_.accuracy(largest) +
             time_rounding_at(texts_, piece.to(), piece.end));
}

void FlowCheck::check_joint(const Eigen::VectorXd& x, double t, const Eigen::VectorXd& next,
                            const Eigen::VectorXd& sizes, bool inner) {
  Eigen::VectorXd difference = (next - x).cwiseAbs();
  for (std::size_t v = 0; inner && v < flowing_.size(); ++v)
    if (texts_.is(v, V::noise)) {
      const auto& every = texts_.noise[texts_.dynamics.variables[v].of].every;
      if (every && same_time(std::round(t / *every) * *every, t))
        texts_.part(difference, v).setZero();
    }
  report(t, "the steps of a flow do not join", difference,
         kJoint * sizes + kRoundingOfAccuracy * texts_.accuracy(sizes) +
             time_rounding_at(texts_, t, next));
}

void FlowCheck::check_rest(const DenseStep& step, const Eigen::VectorXd& x,
                           const Eigen::VectorXd& sizes) {
  const Eigen::VectorXd clock_allowed =
      4 * kRounding * sizes.array() + time_rounding(step.from, step.to);
  for (int k = 0; k <= kInner; ++k) {
    const double t = k == kInner ? step.to : step.from + (step.to - step.from) * (k + 0.5) / kInner;
    const Eigen::VectorXd moved = step(t) - x;
    for (std::size_t v = 0; v < flowing_.size(); ++v) {
      const Slot& slot = texts_.layout.slots[v];
      if (flowing_[v]) continue;
      for (Eigen::Index i = slot.offset; i < slot.offset + slot.shape.size(); ++i) {
        const bool clock = is_clock(texts_.dynamics.variables[v].kind);
        const double off = std::abs(moved(i) - clocks_(i) * (t - step.from));
        faults_.check(
            part_, t,
            (clock ? "a clock does not run at its rate: " : "flows, but rests: ") + slot.name, off,
            clock ? clock_allowed(i) : 1e-14 * sizes(i));
      }
    }
  }
}

std::optional<FlowCheck::Quarters> FlowCheck::advance(const DenseStep& step,
                                                      const Eigen::VectorXd& x, int count,
                                                      const Eigen::VectorXd& allowed) {
  Eigen::VectorXd all = x;
  Eigen::VectorXd rates(x.size());
  const auto rate = [&](double t, const Eigen::VectorXd& y, Eigen::VectorXd& out) {
    all = x + clocks_ * (t - step.from);
    all(active_) = y;
    texts_.rate(all, rates);
    out = rates(active_);
  };
  const auto guess = [&](double t) { return active_part(step(t)); };
  GaussIntegrator gauss(static_cast<Eigen::Index>(active_.size()), rate);
  const double h = (step.to - step.from) / count;
  Quarters result(active_.size(), 4);
  Eigen::VectorXd y = active_part(x);
  for (int k = 0; k < count; ++k) {
    const auto next = gauss.step(step.from + k * h, y, h, allowed, guess);
    if (!next) return std::nullopt;
    y = *next;
    if ((4 * (k + 1)) % count == 0) result.col(4 * (k + 1) / count - 1) = y;
  }
  return result;
}

std::optional<FlowCheck::Quarters> FlowCheck::settled(const DenseStep& step,
                                                      const Eigen::VectorXd& x,
                                                      const Eigen::VectorXd& allowed) {
  std::optional<Quarters> coarse = advance(step, x, 2, allowed);
  for (int count = 4; count <= kFinest; count *= 2) {
    std::optional<Quarters> fine = advance(step, x, count, allowed);
    if (coarse && fine) {
      // Two steps have no values at the first and the third quarter.
      numbers::Matrix change = (*fine - *coarse).cwiseAbs();
      if (count == 4) change.col(0).setZero(), change.col(2).setZero();
      if ((change.array().colwise() / allowed.array() <= 0.1).all()) return fine;
    }
    coarse = std::move(fine);
  }
  return std::nullopt;
}

std::optional<FlowCheck::Quarters> FlowCheck::straight(const DenseStep& step,
                                                       const Eigen::VectorXd& x,
                                                       const Eigen::VectorXd& allowed) {
  const double h = step.to - step.from;
  Eigen::VectorXd rate, middle;
  try {
    texts_.rate(step(step.from + h / 2), middle);
    for (const double t : {step.from, step.to}) {
      texts_.rate(step(t), rate);
      if ((h * active_part(rate).array().abs() > 0.1 * allowed.array()).any()) return std::nullopt;
    }
  } catch (const expr::EvaluationError&) {
    return std::nullopt;
  }
  Quarters result(active_.size(), 4);
  for (int k = 1; k <= 4; ++k)
    result.col(k - 1) = active_part(x) + 0.25 * k * h * active_part(middle);
  return result;
}

void FlowCheck::check_step(const DenseStep& step, const Eigen::VectorXd& x,
                           const Eigen::VectorXd& sizes, Eigen::VectorXd& sum) {
  if (active_.empty()) return;
  const Eigen::VectorXd allowed =
      kFactor * texts_.accuracy(sizes) + time_rounding_at(texts_, step.to, step(step.to));
  std::optional<Quarters> again = settled(step, x, active_part(allowed));
  if (!again) again = straight(step, x, active_part(allowed));
  if (!again) {
    faults_.add(part_, step.from, "a step of the flow could not be integrated again");
    return;
  }
  for (int k = 1; k <= 4; ++k) {
    const double t = k == 4 ? step.to : step.from + (step.to - step.from) * 0.25 * k;
    Eigen::VectorXd difference = Eigen::VectorXd::Zero(x.size());
    difference(active_) = active_part(step(t)) - again->col(k - 1);
    report(t, "a flow does not follow its text", difference.cwiseAbs(), allowed);
    if (k == 4) sum += difference;
  }
}

}  // namespace gainsmith::hybrid::judging
