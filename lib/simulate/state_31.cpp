#include "simulate/state_31.h"

#include <algorithm>
#include <cmath>

#include "base/number.h"
#include "base/unit_roundoff.h"
#include "ode/gauss_stages.h"
#include "simulate/tolerances.h"

namespace gainsmith::simulate {

using Eigen::Index;
using Eigen::VectorXd;
using VariableKind = model::Dynamics::VariableKind;

namespace {

/// A number that a person wrote; none: one of so many digits may have been computed.
std::optional<DoubleDouble> written(double value) {
  constexpr int kDigits = 12;
  const std::string text = brief(value, kDigits);
  if (parse_decimal(text) != value) return std::nullopt;
  return parse_as<DoubleDouble>(text);
}

/// In the order of hybrid::EventCondition::comparisons.
void add_comparisons(const expr::Condition& condition, const hybrid::System& system,
                     const Constants31& constants, std::vector<Function31>& all) {
  if (condition.is_comparison()) all.emplace_back(condition.difference, system, constants);
  for (const expr::Condition& part : condition.parts) add_comparisons(part, system, constants, all);
}

bool is_clock(VariableKind kind) {
  return kind == VariableKind::time || kind == VariableKind::since || kind == VariableKind::left;
}

}  // namespace

bool State31::may_run(const hybrid::System& system, const hybrid::Scenario& scenario) {
  const auto is_known = [](const std::optional<hybrid::StartRule>& rule) {
    if (!rule || rule->kind != model::StartKind::list) return true;
    return std::ranges::all_of(rule->values, [](const numbers::Matrix& value) {
      return std::ranges::all_of(value.reshaped(),
                                 [](double number) { return written(number).has_value(); });
    });
  };
  return system.in_31_digits && std::ranges::all_of(scenario.starts, is_known);
}

State31::State31(const hybrid::System& system, const hybrid::Scenario& scenario)
    : system_(&system), scenario_(&scenario), constants_(system.in_31_digits()) {
  const auto& dynamics = system.dynamics;
  const auto add_moving = [&](std::size_t variable) {
    const hybrid::Slot& slot = system.layout.slots[variable];
    for (Index k = 0; k < slot.shape.size(); ++k) moving_.push_back(slot.offset + k);
  };
  for (const model::Dynamics::Assignment& assignment : dynamics.flow) {
    rates_.push_back(
        {assignment.variable, Function31(assignment.value.program, system, constants_)});
    add_moving(assignment.variable);
  }
  for (Index k = system.size; k < system.whole; ++k) adopted_.push_back(k);
  for (std::size_t i = 0; i < dynamics.variables.size(); ++i) {
    const hybrid::Slot& slot = system.layout.slots[i];
    const VariableKind kind = dynamics.variables[i].kind;
    for (Index k = slot.offset; k < slot.offset + slot.shape.size(); ++k) {
      if (kind == VariableKind::noise) adopted_.push_back(k);
      if (kind == VariableKind::measured || kind == VariableKind::measured_rate)
        measured_.push_back(k);
    }
    if (!is_clock(kind)) continue;
    clocks_.push_back({slot.offset, kind, dynamics.variables[i].of});
    add_moving(i);
  }
  for (std::size_t e = 0; e < dynamics.events.size(); ++e) {
    const model::Dynamics::Event& event = dynamics.events[e];
    std::vector<Function31>& guards = guards_.emplace_back();
    if (event.condition) add_comparisons(*event.condition, system, constants_, guards);
    if (event.crossing) guards.emplace_back(event.crossing->program, system, constants_);
    add_clocks(e);
  }
  for (const model::Dynamics::Noise& noise : dynamics.noise)
    if (noise.every)
      drawn_every_.push_back(numbers::evaluate<DoubleDouble>(noise.every->program, constants_)(0));
  for (const hybrid::Switch& found : system.switches)
    switches_.emplace_back(found.difference, system, constants_);
}

void State31::add_clocks(std::size_t event) {
  const model::Dynamics::Event& clocked = system_->dynamics.events[event];
  const auto value = [&](const model::Formula& formula) {
    return numbers::evaluate<DoubleDouble>(formula.program, constants_);
  };
  std::vector<DoubleDouble>& times = times_.emplace_back();
  for (const model::Formula& formula : clocked.times) {
    const Matrix31 given = value(formula);
    times.insert(times.end(), given.data(), given.data() + given.size());
  }
  period_.emplace_back();
  first_.emplace_back();
  const auto& clock = system_->clocks[event];
  if (!clock || clock->low != clock->high) return;
  period_.back() = value(*clocked.low)(0);
  const auto& given = scenario_->first.empty() ? std::nullopt : scenario_->first[event];
  if (given)
    first_.back() = written(*given);
  else if (!clock->first)
    first_.back() = period_.back();
  else if (clock->first->first == clock->first->second)
    first_.back() = value(*clocked.first_low)(0);
}

Values31 State31::start_of(std::uint64_t run, const VectorXd& values) {
  Values31 x = values.cast<DoubleDouble>();
  const hybrid::GivenRun* given = scenario_->given_for(run);
  for (std::size_t i = 0; i < scenario_->starts.size(); ++i) {
    if (!scenario_->starts[i]) continue;
    if (given != nullptr && i < given->starts.size() && given->starts[i]) continue;
    const hybrid::StartRule& rule = *scenario_->starts[i];
    const hybrid::Slot& slot = system_->layout.slots[i];
    auto state = x.segment(slot.offset, slot.shape.size());
    if (rule.kind == model::StartKind::expression)
      state = Function31(rule.program, *system_, constants_)(x).reshaped();
    if (rule.kind == model::StartKind::list)
      state = state.unaryExpr([](const DoubleDouble& number) { return *written(number.hi()); });
  }
  for (const auto& [b, a] : scenario_->differences) {
    const hybrid::Slot& slot = system_->layout.slots[b];
    const auto& rule = scenario_->starts[b];
    if (!rule || rule->kind != model::StartKind::expression) continue;  // that of the draw
    auto d = x.segment(slot.offset, slot.shape.size());
    d = Values31(x.segment(system_->layout.slots[a].offset, slot.shape.size()) - d);
  }
  return x;
}

void State31::begin(std::uint64_t run, const VectorXd& values, const hybrid::EventClocks& clocks,
                    const LastPlaces* moved) {
  moved_ = moved;
  t_ = 0;
  to_ = longest_ = 0;
  since_.assign(system_->dynamics.events.size(), t_);
  x_ = start_of(run, values);
  sizes_ = VectorXd::Zero(x_.size());
  drawn_first_.clear();
  for (std::size_t e = 0; e < first_.size(); ++e) drawn_first_.push_back(clocks.due(e));
  fill_clocks(clocks);
}

void State31::adopt(const VectorXd& values) {
  for (const Index k : adopted_) x_(k) = values(k);
}

void State31::adopt_given(const VectorXd& values, bool arrives) {
  const double t = t_.hi();
  std::optional<DoubleDouble> time;
  for (const DoubleDouble& every : drawn_every_)
    if (const DoubleDouble at = std::round(t / every.hi()) * every;
        std::abs(at.hi() - t) <= hybrid::kOneInstant * t)
      time = at;
  for (const model::Dynamics::Measured& measured : system_->dynamics.measured)
    if (const std::size_t row = measured.series->not_before(t - hybrid::kOneInstant * t);
        row < measured.series->times.size() &&
        measured.series->times[row] <= t + hybrid::kOneInstant * t)
      time = parse_as<DoubleDouble>(shortest(measured.series->times[row]));
  if (arrives && time) shift(*time - t_);
  adopt(values);
  for (const Index k : measured_) x_(k) = values(k);
}

DoubleDouble State31::due(std::size_t event, double rounded) const {
  const auto nearer = [&](const DoubleDouble& a, const DoubleDouble& b) {
    return abs(a - rounded) < abs(b - rounded);
  };
  if (!times_[event].empty())
    return *std::min_element(times_[event].begin(), times_[event].end(), nearer);
  if (!period_[event]) return rounded;
  const DoubleDouble first = first_[event].value_or(drawn_first_[event]);
  const double count = std::round(((rounded - first) / *period_[event]).hi());
  return first + count * *period_[event];
}

void State31::fill_clocks(const hybrid::EventClocks& clocks) {
  for (const Clock& clock : clocks_) {
    DoubleDouble& value = x_(clock.element);
    if (clock.kind == VariableKind::time) value = t_;
    if (clock.kind == VariableKind::since) value = t_ - since_[clock.event];
    if (clock.kind != VariableKind::left) continue;
    const double rounded = clocks.due(clock.event);
    value = std::isfinite(rounded) ? due(clock.event, rounded) - t_ : DoubleDouble(rounded);
  }
}

bool State31::shift_to_root(const Guard& guard) {
  constexpr int kSteps = 3;  // of Newton, from 16 digits
  const double beside = std::ldexp(longest_, -40);
  for (int k = 0; k < kSteps; ++k) {
    const DoubleDouble value = guard();
    if (value == 0) return true;
    const Values31 here = x_;
    const DoubleDouble t = t_;
    shift(beside);
    const DoubleDouble slope = (guard() - value) / DoubleDouble(beside);
    x_ = here;
    t_ = t;
    const DoubleDouble by = -value / slope;
    if (!(std::abs(by.hi()) <= beside + k31Near * longest_ + 64 * kUnitRoundoff * t_.hi()))
      return false;
    shift(by);
  }
  return true;
}

void State31::meet(std::size_t event, EventWatch& watch, const VectorXd& values,
                   const hybrid::EventClocks& clocks, bool by_flow) {
  if (!goes_to(event, watch, values, clocks, by_flow)) blur();
}

bool State31::goes_to(std::size_t event, EventWatch& watch, const VectorXd& values,
                      const hybrid::EventClocks& clocks, bool by_flow) {
  const double rounding = k31Solved * std::max(std::abs(t_.hi()), std::abs(length_.hi()));
  if (system_->has_clock(event)) {
    const DoubleDouble by = due(event, clocks.due(event)) - t_;
    if (std::abs(by.hi()) <= rounding) return true;
    if (by < 0 && !by_flow) return false;
    shift(by);
    return true;
  }
  bool moved = !by_flow;
  for (std::size_t k = 0; k < guards_[event].size(); ++k) {
    hybrid::EventFunction& guard = watch.crossing[event]
                                       ? *watch.crossing[event]
                                       : watch.when[event]->comparisons()[k].function;
    if (guard.rests()) continue;
    const numbers::Matrix value = guard(values), terms = guard.terms(values);
    for (Index e = 0; e < value.size(); ++e) {
      if (!(std::abs(value(e)) <= k31Near * terms(e))) continue;
      const auto in_31_digits = [&] { return guards_[event][k](x_)(e); };
      if (!moved && !shift_to_root(in_31_digits)) return false;
      if (moved && !(std::abs(in_31_digits().hi()) <= k31Solved * terms(e))) return false;
      moved = true;
    }
  }
  return true;
}

void State31::meet_switch(std::size_t which, Index element) {
  if (!shift_to_root([&] { return switches_[which](x_)(element); })) blur();
}

void State31::jumped(std::size_t event, const Values31& after, const hybrid::EventClocks& clocks) {
  x_ = after;
  since_[event] = t_;
  fill_clocks(clocks);
}

}  // namespace gainsmith::simulate
