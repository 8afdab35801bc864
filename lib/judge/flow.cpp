#include "judge/flow.h"

#include <algorithm>
#include <cmath>

#include "expr/program/number_type.h"
#include "judge/measured.h"
#include "judge/tolerances.h"

namespace gainsmith::judge {

namespace {

using V = model::Dynamics::VariableKind;

/// Points of a step at which what rests is checked.
constexpr int inner_points = 16;

bool is_clock(V kind) { return kind == V::time || kind == V::since || kind == V::left; }

}  // namespace

/// sum_k |c_k| by element, since |T_k| <= 1 on the step.
Eigen::VectorXd step_sizes(const Texts& texts, const hybrid::DenseStep& step) {
  return texts.by_variable(step.coefficients.cwiseAbs().rowwise().sum());
}

Eigen::VectorXd time_rounding_at(Texts& texts, double t, const Eigen::VectorXd& x) {
  Eigen::VectorXd rate;
  try {
    texts.rate(x, rate);
  } catch (const expr::EvaluationError&) {
    return Eigen::VectorXd::Zero(x.size());
  }
  return time_rounding(t, t) * rate.cwiseAbs();
}

Eigen::VectorXd rounding_at(Texts& texts, double t, const Eigen::VectorXd& x,
                            const Eigen::VectorXd& sizes) {
  Eigen::VectorXd result = kRounding * sizes + hybrid::kOfAccuracy * texts.accuracy(sizes) +
                           time_rounding_at(texts, t, x);
  const std::vector<bool> flowing = texts.flowing(x);
  for (std::size_t v = 0; v < flowing.size(); ++v)
    if (!flowing[v] && !is_clock(texts.dynamics.variables[v].kind)) texts.part(result, v).setZero();
  return result;
}

/// What the rounding of the time at which a step begins makes of its values: a switch may just have
/// made the flow fast.
Eigen::VectorXd shift_of(const hybrid::DenseStep& step) {
  const Eigen::VectorXd swing =
      step.coefficients.rightCols(step.coefficients.cols() - 1).cwiseAbs().rowwise().sum();
  const double length = step.to - step.from;
  const double part = length > 0 ? 2 * time_rounding(step.from, step.to) / length : 1;
  return std::min(part, 1.0) * swing;
}

FlowCheck::FlowCheck(Texts& texts, Faults& faults)
    : texts_(texts), faults_(faults), moving_{{}, Eigen::VectorXd::Zero(texts.layout.size)} {
  for (std::size_t v = 0; v < texts.dynamics.variables.size(); ++v)
    if (is_clock(texts.dynamics.variables[v].kind))
      texts.part(moving_.clocks, v).setConstant(texts.is(v, V::left) ? -1 : 1);
}

void FlowCheck::report(double t, const std::string& what, const Eigen::VectorXd& size,
                       const Eigen::VectorXd& allowed) {
  for (const hybrid::Slot& slot : texts_.layout.slots)
    for (Eigen::Index i = slot.offset; i < slot.offset + slot.shape.size(); ++i)
      faults_.check(part_, t, what + ": " + slot.name, size(i), allowed(i));
}

/// Which variables flow, and the bits of what rests, are those at the start of the piece.
void FlowCheck::operator()(std::size_t part, const hybrid::FlowPiece& piece) {
  part_ = part;
  flowing_ = texts_.flowing(piece.start);
  moving_.active.clear();
  for (std::size_t v = 0; v < flowing_.size(); ++v)
    for (Eigen::Index i = 0; flowing_[v] && i < texts_.layout.slots[v].shape.size(); ++i)
      moving_.active.push_back(texts_.layout.slots[v].offset + i);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(texts_.layout.size);
  Eigen::VectorXd largest = sum;
  Eigen::VectorXd x = piece.start;
  for (const hybrid::DenseStep& step : piece.steps) {
    const Eigen::VectorXd sizes = step_sizes(texts_, step);
    largest = largest.cwiseMax(sizes);
    Eigen::VectorXd from = step(step.from);
    check_joint(x, step.from, from, sizes, &step != &piece.steps.front(), shift_of(step));
    check_rest(step, from, sizes);
    check_measured(texts_, part_, step, faults_);
    texts_.settle(piece.start, from);
    check_step(step, from, sizes, sum);
    x = step(step.to);
  }
  check_joint(x, piece.to(), piece.end, largest, false, Eigen::VectorXd::Zero(texts_.layout.size));
  const double steps = static_cast<double>(piece.steps.size());
  report(piece.to(), "a flow drifts away from its text", sum.cwiseAbs(),
         kFactor * (1 + kCertain * steps) * texts_.accuracy(largest) +
             time_rounding_at(texts_, piece.to(), piece.end));
}

void FlowCheck::check_joint(const Eigen::VectorXd& x, double t, const Eigen::VectorXd& next,
                            const Eigen::VectorXd& sizes, bool inner,
                            const Eigen::VectorXd& shift) {
  Eigen::VectorXd difference = (next - x).cwiseAbs();
  for (std::size_t v = 0; inner && v < flowing_.size(); ++v)
    if (texts_.is_measured(v)) {
      if (texts_.has_row(v, t)) texts_.part(difference, v).setZero();
    } else if (texts_.is(v, V::noise)) {
      const auto& every = texts_.noise[texts_.dynamics.variables[v].of].every;
      if (every ? same_time(std::round(t / *every) * *every, t) : texts_.changes_inside(v))
        texts_.part(difference, v).setZero();
    }
  report(t, "the steps of a flow do not join", difference,
         hybrid::kAddedUp * sizes + hybrid::kOfAccuracy * texts_.accuracy(sizes) +
             time_rounding_at(texts_, t, next) + shift);
}

void FlowCheck::check_rest(const hybrid::DenseStep& step, const Eigen::VectorXd& x,
                           const Eigen::VectorXd& sizes) {
  const Eigen::VectorXd clock_allowed =
      4 * kRounding * sizes.array() + time_rounding(step.from, step.to);
  for (int k = 0; k <= inner_points; ++k) {
    const double t =
        k == inner_points ? step.to : step.from + (step.to - step.from) * (k + 0.5) / inner_points;
    const Eigen::VectorXd moved = step(t) - x;
    for (std::size_t v = 0; v < flowing_.size(); ++v) {
      const hybrid::Slot& slot = texts_.layout.slots[v];
      if (flowing_[v]) continue;
      for (Eigen::Index i = slot.offset; i < slot.offset + slot.shape.size(); ++i) {
        const bool clock = is_clock(texts_.dynamics.variables[v].kind);
        const double off = std::abs(moved(i) - moving_.clocks(i) * (t - step.from));
        faults_.check(
            part_, t,
            (clock ? "a clock does not run at its rate: " : "flows, but rests: ") + slot.name, off,
            clock ? clock_allowed(i) : kRounding * sizes(i));
      }
    }
  }
}

void FlowCheck::check_step(const hybrid::DenseStep& step, const Eigen::VectorXd& x,
                           const Eigen::VectorXd& sizes, Eigen::VectorXd& sum) {
  if (moving_.active.empty()) return;
  // An integrator holds the root of the mean square over all n moving elements to the accuracy, so
  // one of them may have sqrt(n) times as much.
  const double of_one = std::sqrt(static_cast<double>(moving_.active.size()));
  const Eigen::VectorXd allowed =
      kFactor * of_one * texts_.accuracy(sizes) + time_rounding_at(texts_, step.to, step(step.to));
  const Eigen::VectorXd allowed_of_active = allowed(moving_.active);
  const auto again = StepAgain(texts_, moving_, step, x, allowed_of_active)();
  if (!again) {
    faults_.add(part_, step.from, "a step of the flow could not be integrated again");
    return;
  }
  for (int k = 1; k <= 4; ++k) {
    const double t = k == 4 ? step.to : step.from + (step.to - step.from) * 0.25 * k;
    Eigen::VectorXd difference = Eigen::VectorXd::Zero(x.size());
    difference(moving_.active) = step(t)(moving_.active) - again->col(k - 1);
    report(t, "a flow does not follow its text", difference.cwiseAbs(), allowed);
    if (k == 4) sum += difference;
  }
}

}  // namespace gainsmith::judge
