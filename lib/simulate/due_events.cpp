#include "simulate/due_events.h"

#include <utility>

namespace gainsmith::simulate {

using Eigen::VectorXd;
using DueKind = model::Dynamics::EventKind;

DueEvents::DueEvents(const hybrid::System& system, EventWatch& watch, hybrid::EventClocks clocks,
                     double horizon)
    : system_(&system),
      watch_(&watch),
      clocks_(std::move(clocks)),
      horizon_(horizon),
      marks_(system.dynamics.events.size()) {}

void DueEvents::begin(const VectorXd& values, VectorField& field) {
  for (std::size_t e = 0; e < marks_.size(); ++e) {
    field.set_clock(model::Dynamics::VariableKind::left, e, clocks_.due(e));
    if (auto& crossing = watch_->crossing[e])
      marks_[e].sign = crossing->is_noise(values) ? 0 : sign_of(e, values);
  }
}

std::optional<std::size_t> DueEvents::first(const VectorXd& values, double t) {
  for (std::size_t e = 0; e < marks_.size(); ++e)
    if (is_due(e, values, t)) return e;
  for (Mark& mark : marks_)
    if (mark.pending != 0) {
      mark.sign = mark.pending;
      mark.since = t;
      mark.pending = 0;
    }
  return std::nullopt;
}

bool DueEvents::is_due(std::size_t event, const VectorXd& values, double t) {
  Mark& mark = marks_[event];
  if (system_->has_clock(event))
    return clocks_.is_due(event, t >= horizon_ ? t + hybrid::kAddedUp * horizon_ : t);
  if (watch_->crossing[event]) {
    note_sign(event, values, t);
    return mark.crossed;
  }
  if ((*watch_->when[event])(values)) return !mark.spent;
  mark.spent = false;
  return false;
}

int DueEvents::sign_of(std::size_t event, const VectorXd& values) {
  const double value = (*watch_->crossing[event])(values)(0);
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}

void DueEvents::note_sign(std::size_t event, const VectorXd& values, double t) {
  Mark& mark = marks_[event];
  mark.pending = 0;
  const int sign = sign_of(event, values);
  if (sign == 0 || sign == mark.sign) return;
  const bool noise = watch_->is_noise(event, values);
  // What leaves 0 has left it once it is no rounding.
  if (noise && mark.sign == 0) return;
  const DueKind kind = system_->dynamics.events[event].kind;
  const bool wanted = kind == DueKind::crosses || (kind == DueKind::rises) == (sign > 0);
  // One root that several texts share, or beside which the flow starts again, is met once.
  if (noise && t - mark.since <= hybrid::kAddedUp * horizon_) {
    if (wanted && kind != DueKind::crosses) mark.sign = sign;
    return;
  }
  if (!wanted && watch_->may_be_noise(event, values)) {
    mark.pending = sign;
    mark.crossed = false;
    return;
  }
  mark.crossed = wanted;
  mark.sign = sign;
  mark.since = noise ? t : Mark().since;
}

/// The clock goes on; `when` waits until its condition has been false.
void DueEvents::spend(std::size_t event, double t, VectorField& field) {
  marks_[event].spent = system_->dynamics.events[event].kind == DueKind::when;
  marks_[event].crossed = false;
  if (!system_->has_clock(event)) return;
  clocks_.advance(event, t);
  field.set_clock(model::Dynamics::VariableKind::left, event, clocks_.due(event));
}

void DueEvents::jumped(std::size_t event, const VectorXd& before, const VectorXd& values) {
  marks_[event].spent = false;
  for (std::size_t e = 0; e < marks_.size(); ++e) {
    if (!watch_->crossing[e]) continue;
    // A jump leads to exactly 0, to values that have no rounding of a step, or leaves e at its root.
    const bool comes_to_zero = sign_of(e, values) == 0 && sign_of(e, before) != 0;
    if (!comes_to_zero && watch_->is_noise(e, before) && watch_->is_noise(e, values)) continue;
    watch_->forget_step(e);
    const bool noise = watch_->is_noise(e, values);
    marks_[e].since = Mark().since;
    if (noise || e == event) marks_[e].sign = noise ? 0 : sign_of(e, values);
  }
}

}  // namespace gainsmith::simulate
