#include "judge/judge.h"

#include <optional>
#include <variant>

#include "expr/program/number_type.h"
#include "judge/draws.h"
#include "judge/end.h"
#include "judge/events.h"
#include "judge/faults.h"
#include "judge/flow.h"
#include "judge/jump.h"
#include "judge/measured.h"
#include "judge/texts.h"
#include "judge/tolerances.h"

namespace gainsmith::judge {

namespace {

using V = model::Dynamics::VariableKind;

/// Whether the parts have the sizes without which nothing else can be asked.
bool is_well_formed(const hybrid::Trajectory& trajectory, const Texts& texts, Faults& faults) {
  const Eigen::Index n = texts.layout.size;
  const auto fits = [&](const std::variant<hybrid::FlowPiece, hybrid::JumpPoint>& part) {
    if (const auto* jump = std::get_if<hybrid::JumpPoint>(&part))
      return jump->event < texts.events.size() && jump->before.size() == n &&
             jump->after.size() == n;
    const auto& piece = std::get<hybrid::FlowPiece>(part);
    bool fine = !piece.steps.empty() && piece.start.size() == n && piece.end.size() == n;
    for (const hybrid::DenseStep& step : piece.steps)
      fine = fine && step.from < step.to && step.coefficients.rows() == n &&
             step.coefficients.cols() > 0;
    return fine;
  };
  if (trajectory.start.size() != n) faults.add(0, 0, "the start has another number of values");
  for (std::size_t k = 0; k < trajectory.parts.size(); ++k)
    if (!fits(trajectory.parts[k])) faults.add(k, 0, "the part is not well formed");
  return faults.list().empty();
}

/// Goes over the parts in order with t, j and x where the last part ended.
class Walk {
 public:
  Walk(const hybrid::Trajectory& trajectory, Texts& texts, Faults& faults)
      : trajectory_(trajectory),
        texts_(texts),
        faults_(faults),
        flows_(texts, faults),
        watch_(texts, trajectory, faults),
        x_(trajectory.start) {}

  void operator()() {
    check_start();
    for (part_ = 0; part_ < trajectory_.parts.size(); ++part_) step_over(trajectory_.parts[part_]);
    faults_.check(part_, trajectory_.end, "the run does not end where its last part does",
                  std::abs(trajectory_.end - t_), 0);
    if (trajectory_.ending == hybrid::Ending::horizon)
      guarded([&] { watch_.instant(part_, t_, x_, {}); });
    watch_.end(part_, t_);
    check_end(texts_, trajectory_, x_, faults_);
  }

 private:
  /// A text without a value is a fault, and the walk goes on.
  template <class Action>
  void guarded(Action action) {
    try {
      action();
    } catch (const expr::EvaluationError& error) {
      faults_.add(part_, t_, "a text has no value: " + error.message());
    }
  }

  void step_over(const std::variant<hybrid::FlowPiece, hybrid::JumpPoint>& part) {
    if (const auto* jump = std::get_if<hybrid::JumpPoint>(&part)) {
      over(*jump);
    } else {
      over(std::get<hybrid::FlowPiece>(part));
    }
  }

  /// Its start, whether its event is due, its map, and what follows from it.
  void over(const hybrid::JumpPoint& jump) {
    go_on(jump.t, jump.j, jump.before, jump.event);
    guarded([&] { watch_.instant(part_, t_, jump.before, jump.event); });
    guarded([&] { check_jump(texts_, part_, jump, faults_); });
    guarded([&] { watch_.jumped(part_, jump); });
    check_noise(jump.after);
    check_measured(texts_, part_, t_, jump.before, faults_);
    x_ = jump.after;
    ++j_;
  }

  /// Its start, that nothing was due, its steps, and what happens inside.
  void over(const hybrid::FlowPiece& piece) {
    go_on(piece.from(), piece.j, piece.start, {});
    guarded([&] { watch_.instant(part_, t_, piece.start, {}); });
    for (std::size_t k = 1; k < piece.steps.size(); ++k)
      faults_.check(part_, piece.steps[k].from, "the steps of a flow are not contiguous",
                    std::abs(piece.steps[k].from - piece.steps[k - 1].to), 0);
    guarded([&] { flows_(part_, piece); });
    guarded([&] { watch_.flow(part_, piece); });
    check_noise(piece.end);
    x_ = piece.end;
    t_ = piece.to();
  }

  /// A part begins with these values where the one before it ended.
  void go_on(double t, std::int64_t j, const Eigen::VectorXd& x, std::optional<std::size_t> event) {
    faults_.check(part_, t, "does not begin where the part before it ended", std::abs(t - t_), 0);
    faults_.check(part_, t, "has another number of jumps before it",
                  std::abs(static_cast<double>(j - j_)), 0);
    t_ = t;
    for (std::size_t v = 0; v < texts_.dynamics.variables.size(); ++v) {
      const hybrid::Slot& slot = texts_.layout.slots[v];
      if (slot.shape.size() == 0 || may_change(v, t, event)) continue;
      faults_.check(part_, t, "does not go on from the part before it: " + slot.name,
                    (texts_.part(x, v) - texts_.part(x_, v)).cwiseAbs().maxCoeff(), slack(v, t));
    }
  }

  /// Clocks may be set to what they must be at an event.
  double slack(std::size_t v, double t) const {
    const bool clock = texts_.is(v, V::time) || texts_.is(v, V::since) || texts_.is(v, V::left);
    return clock ? time_rounding(t, t) : 0;
  }

  /// Noise that is drawn, at a jump or where its occurrence is spent; a clock that starts again.
  bool may_change(std::size_t v, double t, std::optional<std::size_t> event) const {
    const model::Dynamics::Variable& variable = texts_.dynamics.variables[v];
    if (variable.kind == V::left) return texts_.dynamics.events[variable.of].only_if.has_value();
    if (texts_.is_measured(v)) return texts_.has_row(v, t);
    if (variable.kind != V::noise) return false;
    const auto& every = texts_.noise[variable.of].every;
    if (every) return same_time(std::round(t / *every) * *every, t);
    const auto& at = texts_.dynamics.noise[variable.of].event;
    return at && (event == at || texts_.dynamics.events[*at].only_if);
  }

  /// States and modes at their starts, counts at 0, and the draws where a seed is known.
  void check_start() {
    for (std::size_t v = 0; v < texts_.dynamics.variables.size(); ++v) {
      if (texts_.is(v, V::passes))
        faults_.check(0, 0, "starts with another value: " + texts_.layout.slots[v].name,
                      std::abs(texts_.part(x_, v)(0)), 0);
      if (texts_.is(v, V::state) || texts_.is(v, V::mode)) guarded([&] { check_start_of(v); });
    }
    watch_.check_numbers(0, 0, x_);
    check_noise(x_);
    check_measured(texts_, 0, 0, x_, faults_);
    if (texts_.question.drawn)
      guarded([&] { check_draws(texts_, trajectory_, *texts_.question.drawn, faults_); });
  }

  /// The range that the campaign gives, or else the value of the start.
  void check_start_of(std::size_t v) {
    const hybrid::Slot& slot = texts_.layout.slots[v];
    const auto here = texts_.part(x_, v);
    for (const StartRange& range : texts_.question.starts) {
      if (range.variable != v) continue;
      if ((here.array() < range.low.reshaped().array()).any() ||
          (here.array() > range.high.reshaped().array()).any() || !here.allFinite())
        faults_.add(0, 0, "starts outside of its range: " + slot.name);
      return;
    }
    const auto start = texts_.start(v, x_);
    if (!start || slot.shape.size() == 0) return;
    faults_.check(0, 0, "starts with another value: " + slot.name,
                  (here - start->reshaped()).cwiseAbs().maxCoeff(),
                  kRounding * start->cwiseAbs().maxCoeff());
  }

  /// Each noise is finite and in its range.
  void check_noise(const Eigen::VectorXd& x) {
    for (std::size_t v = 0; v < texts_.dynamics.variables.size(); ++v) {
      if (!texts_.is(v, V::noise)) continue;
      const NoiseRange& range = texts_.noise[texts_.dynamics.variables[v].of];
      const auto here = texts_.part(x, v);
      if (!here.allFinite() || (here.array() < range.low.reshaped().array()).any() ||
          (here.array() > range.high.reshaped().array()).any())
        faults_.add(part_, t_, "noise outside of its range: " + texts_.layout.slots[v].name);
    }
  }

  const hybrid::Trajectory& trajectory_;
  Texts& texts_;
  Faults& faults_;
  FlowCheck flows_;
  EventCheck watch_;
  std::size_t part_ = 0;
  double t_ = 0;
  std::int64_t j_ = 0;
  Eigen::VectorXd x_;
};

}  // namespace

std::vector<Fault> check_trajectory(const hybrid::Trajectory& trajectory,
                                    const model::Dynamics& dynamics, const model::Stated& stated,
                                    const Question& question) {
  Faults faults;
  Texts texts(dynamics, stated, question);
  if (is_well_formed(trajectory, texts, faults)) Walk(trajectory, texts, faults)();
  return faults.list();
}

}  // namespace gainsmith::judge
