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
    field.set_due(e, clocks_.due(e));
    if (watch_->crossing[e]) marks_[e].sign = sign_of(e, values);
  }
}

std::optional<std::size_t> DueEvents::first(const VectorXd& values, double t) {
  for (std::size_t e = 0; e < marks_.size(); ++e)
    if (is_due(e, values, t)) return e;
  return std::nullopt;
}

bool DueEvents::is_due(std::size_t event, const VectorXd& values, double t) {
  Mark& mark = marks_[event];
  if (system_->has_clock(event))
    return clocks_.is_due(event, t >= horizon_ ? t + hybrid::kAddedUp * horizon_ : t);
  if (watch_->crossing[event]) {
    // What leaves 0 has left it once it is no rounding.
    if (mark.sign != 0 || !watch_->is_noise(event, values))
      note_sign(event, sign_of(event, values));
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

void DueEvents::note_sign(std::size_t event, int sign) {
  Mark& mark = marks_[event];
  if (sign == 0 || sign == mark.sign) return;
  const DueKind kind = system_->dynamics.events[event].kind;
  const bool wanted = kind == DueKind::crosses || (kind == DueKind::rises) == (sign > 0);
  mark.crossed = wanted;
  mark.sign = sign;
}

void DueEvents::spend(std::size_t event, double t, VectorField& field) {
  marks_[event].spent = system_->dynamics.events[event].kind == DueKind::when;
  marks_[event].crossed = false;
  if (!system_->has_clock(event)) return;
  clocks_.advance(event, t);
  field.set_due(event, clocks_.due(event));
}

void DueEvents::jumped(std::size_t event, const VectorXd& before, const VectorXd& values) {
  marks_[event].spent = false;
  watch_->forget_step();
  for (std::size_t e = 0; e < marks_.size(); ++e) {
    if (!watch_->crossing[e]) continue;
    const int sign = sign_of(e, values);
    if (e == event || (sign == 0 && sign_of(e, before) != 0)) marks_[e].sign = sign;
  }
}

}  // namespace gainsmith::simulate
