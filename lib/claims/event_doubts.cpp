#include "claims/event_doubts.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/number.h"
#include "claims/sample_points.h"
#include "claims/tolerances.h"

namespace gainsmith::claims {

namespace {

using Eigen::Index;
using Eigen::VectorXd;
using hybrid::EventCondition;
using hybrid::EventFunction;
using hybrid::NearTurn;
using EventKind = model::Dynamics::EventKind;

/// Not a number where it has no value.
double element(EventFunction& guard, const VectorXd& values, Index e) {
  try {
    return guard(values)(e);
  } catch (const expr::EvaluationError&) {
    return std::numeric_limits<double>::quiet_NaN();
  }
}

/// kTermRounding times the terms; 0 where they have no value.
double noise_of(EventFunction& guard, const VectorXd& values, Index e) {
  try {
    const double terms = guard.terms(values)(e);
    return std::isnan(terms) ? 0 : hybrid::kTermRounding * terms;
  } catch (const expr::EvaluationError&) {
    return 0;
  }
}

double length(const hybrid::FlowPiece& flow) { return flow.to() - flow.from(); }

}  // namespace

EventDoubts::EventDoubts(const hybrid::System& system)
    : system_(&system),
      watch_(system),
      maps_(system),
      are_independent_(system.dynamics),
      breaks_(system.dynamics.events.size()) {
  for (std::size_t e = 0; e < system.dynamics.events.size(); ++e)
    has_clocks_ = has_clocks_ || system.has_clock(e);
  const auto moves = [&](const std::string& name) { return system.layout.moves(name); };
  for (const model::Dynamics::Reaction& reaction : system.dynamics.reactions)
    for (const model::Dynamics::Pass& pass : reaction.passes)
      for (const model::Dynamics::Assignment& assignment : pass.map) {
        hybrid::Breaks breaks(assignment.value.program, system.layout, system.constants, moves);
        if (!breaks.none()) breaks_[reaction.event].push_back(std::move(breaks));
      }
}

VectorXd EventDoubts::whole(const VectorXd& variables) const {
  VectorXd result = VectorXd::Zero(system_->whole);
  result.head(variables.size()) = variables;
  return result;
}

/// |value| <= factor max |g(run) - g(second run)| + noise, at five points from the turn back over a
/// quarter of the flow before it.
std::optional<std::string> EventDoubts::of_turn(const NearTurn& turn, const TwinFlow& flow) {
  const int points = 2 * kSamplesBeside + 1;
  if (flow.twin == nullptr) return std::nullopt;
  EventFunction& guard = watch_.function_of(turn);
  const double from = std::max(flow.flow->from(), flow.twin->from());
  const double last = std::min({turn.t, flow.flow->to(), flow.twin->to()});
  if (!(from < last)) return std::nullopt;
  double difference = 0;
  VectorXd here;
  for (int k = 0; k < points; ++k) {
    const double t = last - (last - from) * k / 16;
    const auto at = [&](const hybrid::FlowPiece& piece) {
      return whole(state_at(piece, std::min((t - piece.from()) / length(piece), 1.0)));
    };
    const VectorXd own = at(*flow.flow);
    if (k == 0) here = own;
    difference = std::fmax(difference, std::abs(element(guard, own, turn.element) -
                                                element(guard, at(*flow.twin), turn.element)));
  }
  const double error = error_factor(*system_) * difference + noise_of(guard, here, turn.element);
  if (!(std::abs(turn.value) <= error)) return std::nullopt;
  return fmt::format("t = {}: '{}' turns at {} from being reached, and that is known to {}",
                     brief(turn.t, 12), turn.text, brief(turn.value, 3), brief(error, 2));
}

bool EventDoubts::is_long(std::size_t part) const {
  const auto* flow = std::get_if<TwinFlow>(&twins_->parts[part]);
  return flow != nullptr && length(*flow->flow) > kInstantOfRun * flow->flow->to();
}

void EventDoubts::begin(const TwinParts& twins) {
  twins_ = &twins;
  walk_to(0);
  if (!has_clocks_) return;
  const std::size_t count = twins.parts.size();
  next_clock_.assign(count + 1, count);
  for (std::size_t k = count; k-- > 0;) {
    const auto* jump = std::get_if<TwinJump>(&twins.parts[k]);
    const bool is_clock = jump != nullptr && system_->has_clock(jump->jump->event);
    next_clock_[k] = is_clock ? k : is_long(k) ? count : next_clock_[k + 1];
  }
}

void EventDoubts::walk_to(std::size_t jump) {
  if (jump < next_ || jump == 0) {
    next_ = 0;
    flow_ = nullptr;
    first_.reset();
    happened_.assign(system_->dynamics.events.size(), false);
  }
  for (; next_ < jump; ++next_) {
    if (const auto* own = std::get_if<TwinJump>(&twins_->parts[next_])) {
      happened_[own->jump->event] = true;
      if (!first_) first_ = own->jump->event;
    } else if (is_long(next_)) {
      flow_ = std::get<TwinFlow>(twins_->parts[next_]).flow;
      std::fill(happened_.begin(), happened_.end(), false);
      first_.reset();
    }
  }
}

/// None at the start, which no flow leads to.
std::optional<EventDoubts::Instant> EventDoubts::instant(std::size_t jump) {
  walk_to(jump);
  if (flow_ == nullptr) return std::nullopt;
  const auto& own = std::get<TwinJump>(twins_->parts[jump]);
  const hybrid::DenseStep& step = flow_->steps.back();
  Instant at;
  at.now = whole(own.jump->before);
  at.twin = whole(own.twin_before);
  at.since = (step.to - step.from) * kBeforeEnd;
  at.before = whole(step(step.to - at.since));
  at.t = own.jump->t;
  at.event = own.jump->event;
  at.lost = own.jump->lost;
  return at;
}

/// Whether values lie on the side of the guard on which the event happens.
bool EventDoubts::stays(const Instant& at, const VectorXd& values) {
  if (watch_.only_if[at.event] && !(*watch_.only_if[at.event])(values)) return false;
  if (watch_.when[at.event]) return (*watch_.when[at.event])(values);
  auto& crossing = watch_.crossing[at.event];
  return !crossing || element(*crossing, values, 0) * element(*crossing, at.now, 0) >= 0;
}

/// Whether the maps of the event jump within the errors of the values before: a text that they
/// branch on is as near to 0, and what they do differs as much within the errors as within 64 times
/// of them. Of what is smooth it grows as they do, of a root by 8.
bool EventDoubts::is_on_step(const Instant& at) {
  const VectorXd errors = errors_of(at.now, at.twin, error_factor(*system_));
  const auto is_near = [&](hybrid::Breaks& breaks) {
    for (std::size_t k = 0; k < breaks.differences().size(); ++k)
      if (!breaks.is_far(k, at.now, errors, 1)) return true;
    return false;
  };
  if (std::ranges::none_of(breaks_[at.event], is_near)) return false;
  try {
    const VectorXd after = maps_(at.event, at.lost, at.now);
    const auto change = [&](double times) {
      VectorXd largest = VectorXd::Zero(errors.size());
      for (Index bit = 1; bit < 2 * errors.size(); bit *= 2)
        for (const double sign : {times, -times}) {
          VectorXd moved = at.now;
          for (Index e = 0; e < moved.size(); ++e)
            moved(e) += ((e & bit) != 0 ? -sign : sign) * errors(e);
          if (stays(at, moved))
            largest = largest.cwiseMax((maps_(at.event, at.lost, moved) - after).cwiseAbs());
        }
      return largest;
    };
    const VectorXd within = change(1);
    const auto least = kValueRounding * at.now.cwiseAbs().cwiseMax(after.cwiseAbs());
    return (within.array() > least.array() && change(64).array() < 4 * within.array()).any();
  } catch (const std::exception&) {
    return true;
  }
}

/// Whether a jump leads it to 0, up to its error, and it is not sure to be 0, up to rounding.
bool EventDoubts::leads_to_zero(EventFunction& crossing, std::size_t jump) {
  const auto& own = std::get<TwinJump>(twins_->parts[jump]);
  const VectorXd after = whole(own.jump->after);
  const double before = std::abs(element(crossing, whole(own.jump->before), 0));
  const double value = element(crossing, after, 0);
  const double twin = element(crossing, whole(own.twin_after), 0);
  const double noise = noise_of(crossing, after, 0);
  const double error =
      error_factor(*system_) * std::abs(value - twin) + noise + hybrid::kTermRounding * before;
  return std::abs(value) <= error && error < before &&
         std::fmax(std::abs(value), std::abs(twin)) > noise;
}

bool EventDoubts::stays_at_zero(EventFunction& crossing, std::size_t jump) {
  const auto* flow = jump > 0 ? std::get_if<TwinFlow>(&twins_->parts[jump - 1]) : nullptr;
  if (flow == nullptr) return false;
  for (const hybrid::DenseStep& step : flow->flow->steps)
    for (const double part : {0.0, 0.25, 0.5, 0.75}) {
      const VectorXd values = whole(step(step.from + part * (step.to - step.from)));
      if (!(std::abs(element(crossing, values, 0)) <= noise_of(crossing, values, 0))) return false;
    }
  return true;
}

/// Whether errors of the values before a jump leave an element that is 0 behind it there, so that no
/// rounding has made it 0.
bool EventDoubts::leads_exactly_to_zero(EventFunction& guard, Index e, const TwinJump& own) {
  const VectorXd before = whole(own.jump->before);
  const VectorXd errors = errors_of(before, whole(own.twin_before), error_factor(*system_));
  try {
    return element(guard, maps_(own.jump->event, own.jump->lost, before + 64 * errors), e) == 0;
  } catch (const std::exception&) {
    return false;
  }
}

bool EventDoubts::leads_to_a_tie(EventCondition& condition, std::size_t jump) {
  const auto& own = std::get<TwinJump>(twins_->parts[jump]);
  const VectorXd before = whole(own.jump->before), after = whole(own.jump->after),
                 twin = whole(own.twin_after);
  for (std::size_t k = 0; k < condition.comparisons().size(); ++k) {
    EventFunction& difference = condition.comparisons()[k].function;
    for (Index e = 0; e < difference.size(); ++e) {
      const double value = element(difference, after, e);
      const double apart = std::abs(value - element(difference, twin, e));
      const double error = error_factor(*system_) * apart + noise_of(difference, after, e);
      if (!(std::abs(value) <= error) || std::abs(element(difference, before, e)) <= error)
        continue;
      if (value == 0 && apart == 0 && leads_exactly_to_zero(difference, e, own)) continue;
      if (condition.if_changed(after, k) != condition(after)) return true;
    }
  }
  return false;
}

/// Whether a jump leads over what the event is a crossing of, or makes its condition true.
bool EventDoubts::becomes_due(std::size_t event, std::size_t jump) {
  const hybrid::JumpPoint& own = *std::get<TwinJump>(twins_->parts[jump]).jump;
  const VectorXd before = whole(own.before), after = whole(own.after);
  if (auto& crossing = watch_.crossing[event])
    return element(*crossing, before, 0) * element(*crossing, after, 0) < 0;
  auto& when = watch_.when[event];
  return when && !(*when)(before) && (*when)(after);
}

std::string EventDoubts::tie(std::size_t event, std::size_t jump) {
  const std::string& name = system_->dynamics.events[event].name;
  if (watch_.when[event] && leads_to_a_tie(*watch_.when[event], jump))
    return "the condition of " + name + " to a tie";
  if (watch_.only_if[event] && becomes_due(event, jump) &&
      leads_to_a_tie(*watch_.only_if[event], jump))
    return "the 'if' of " + name + ", which is due, to a tie";
  if (watch_.crossing[event] && leads_to_zero(*watch_.crossing[event], jump))
    return "that of which " + name + " is a crossing to 0";
  return "";
}

/// Those that a flow changes, of a condition all its elements.
std::vector<EventDoubts::Guard> EventDoubts::guards(std::size_t event, const Instant& at) {
  std::vector<Guard> result;
  const auto add = [&](EventFunction& guard, std::size_t comparison) {
    if (guard.rests()) return;
    for (Index e = 0; e < guard.size(); ++e) {
      const double value = element(guard, at.now, e);
      const double difference = std::abs(value - element(guard, at.twin, e));
      result.push_back({&guard, comparison, value, element(guard, at.before, e),
                        error_factor(*system_) * difference + noise_of(guard, at.now, e)});
    }
  };
  if (watch_.crossing[event]) add(*watch_.crossing[event], 0);
  if (watch_.when[event]) {
    auto& comparisons = watch_.when[event]->comparisons();
    for (std::size_t k = 0; k < comparisons.size(); ++k) add(comparisons[k].function, k);
  }
  return result;
}

/// By the guard that comes to 0 there.
void EventDoubts::set_time_error(Instant& at) {
  // Rounding of the time, and the noise of the guard over its rate.
  at.time_error = 4 * std::numeric_limits<double>::epsilon() * at.t;
  const auto nearest = std::min_element(
      at.own.begin(), at.own.end(),
      [](const Guard& a, const Guard& b) { return std::abs(a.value) < std::abs(b.value); });
  if (nearest == at.own.end()) return;
  const double rate = std::abs(nearest->value - nearest->before) / at.since;
  if (rate > 0) at.time_error += noise_of(*nearest->function, at.now, 0) / rate;
}

/// Whether the event is arrived at, and lies within its error.
bool EventDoubts::may_happen(std::size_t event, const Instant& at,
                             const std::vector<Guard>& guards) {
  for (const Guard& guard : guards) {
    const double rate = std::abs(guard.value - guard.before) / at.since;
    if (!(std::abs(guard.value) <= guard.error + rate * at.time_error)) continue;
    const bool together = std::any_of(at.own.begin(), at.own.end(), [&](const Guard& own) {
      return std::abs(own.value) == std::abs(guard.value) &&
             std::abs(own.before) == std::abs(guard.before);
    });
    if (together) continue;
    if (watch_.crossing[event]) {
      const EventKind kind = system_->dynamics.events[event].kind;
      const bool rising = guard.before < 0;
      if (kind == EventKind::crosses || (kind == EventKind::rises) == rising) return true;
      continue;
    }
    EventCondition& condition = *watch_.when[event];
    if (!condition(at.before) &&
        (condition(at.now) || condition.if_changed(at.now, guard.comparison)))
      return true;
  }
  return false;
}

/// Whether it happens at these values, where what lies within its error counts as reached.
bool EventDoubts::fires(std::size_t event, const std::vector<Guard>& guards, const Instant& at,
                        const VectorXd& values) {
  if (system_->has_clock(event)) return true;
  const auto is_near = [&](const Guard& guard, double value) {
    const double rate = std::abs(guard.value - guard.before) / at.since;
    return std::abs(value) <= guard.error + rate * at.time_error;
  };
  if (watch_.crossing[event]) {
    EventFunction& crossing = *watch_.crossing[event];
    const double value = element(crossing, values, 0);
    // None where jumps alone change it.
    return (!guards.empty() && is_near(guards.front(), value)) ||
           (value > 0) != (element(crossing, at.before, 0) > 0);
  }
  EventCondition& condition = *watch_.when[event];
  if (condition(values)) return true;
  return std::any_of(guards.begin(), guards.end(), [&](const Guard& guard) {
    const auto difference = (*guard.function)(values).reshaped();
    return is_near(guard, difference.cwiseAbs().minCoeff()) &&
           condition.if_changed(values, guard.comparison);
  });
}

/// |g_b(g_a(x)) - g_a(g_b(x))| <= kValueRounding of the sizes, element by element; the second event
/// happens only where it still fires.
bool EventDoubts::commute(std::size_t other, const std::vector<Guard>& guards, const Instant& at) {
  if (are_independent_(at.event, other)) return true;
  try {
    VectorXd first = maps_(at.event, at.lost, at.now);
    if (fires(other, guards, at, first)) first = maps_(other, false, first);
    VectorXd second = maps_(other, false, at.now);
    if (fires(at.event, at.own, at, second)) second = maps_(at.event, at.lost, second);
    const auto sizes = first.cwiseAbs().cwiseMax(second.cwiseAbs()).cwiseMax(at.now.cwiseAbs());
    return ((first - second).cwiseAbs().array() <= kValueRounding * sizes.array()).all();
  } catch (const std::exception&) {
    return false;
  }
}

std::string EventDoubts::message(const Instant& at, std::size_t other, double distance,
                                 double error) const {
  const auto& events = system_->dynamics.events;
  return fmt::format(
      "t = {}: the events {} and {} lie within their errors ({}, known to {}), and what comes of "
      "them depends on their order: make them one event, or set them apart",
      brief(at.t, 12), events[at.event].name, events[other].name, brief(distance, 3),
      brief(error, 2));
}

/// Clocks that strike so soon after an event that they may do so before it. An event that a jump
/// leads to, and no flow, is in the order of the file when a clock began its instant.
std::optional<std::string> EventDoubts::clocks_after(std::size_t jump, const Instant& at) {
  if (!has_clocks_ || system_->has_clock(at.event)) return std::nullopt;
  if (at.own.empty() && first_ && system_->has_clock(*first_)) return std::nullopt;
  const auto& own = std::get<TwinJump>(twins_->parts[jump]);
  for (std::size_t k = next_clock_[jump + 1]; k < twins_->parts.size(); k = next_clock_[k + 1]) {
    const auto& next = std::get<TwinJump>(twins_->parts[k]);
    const std::size_t other = next.jump->event;
    const double gap = next.jump->t - at.t;
    const double error =
        error_factor(*system_) * std::abs(gap - (next.twin_t - own.twin_t)) + at.time_error;
    if (gap <= error && !commute(other, {}, at)) return message(at, other, gap, error);
  }
  return std::nullopt;
}

std::optional<EventDoubts::Doubt> EventDoubts::first(const hybrid::Trajectory& run,
                                                     const TwinParts& twins) {
  begin(twins);
  auto turn = run.turns.begin();
  for (std::size_t k = 0; k < twins.parts.size(); ++k) {
    const auto* flow = std::get_if<TwinFlow>(&twins.parts[k]);
    if (flow == nullptr) {
      if (auto why = of_jump(k))
        return Doubt{k, std::get<TwinJump>(twins.parts[k]).jump->t, std::move(*why)};
      continue;
    }
    for (; turn != run.turns.end() && turn->t <= flow->flow->to(); ++turn) {
      if (turn->t < flow->flow->from()) continue;
      if (auto why = of_turn(*turn, *flow)) return Doubt{k, turn->t, std::move(*why)};
    }
  }
  return std::nullopt;
}

std::optional<std::string> EventDoubts::of_jump(std::size_t jump) {
  const auto& events = system_->dynamics.events;
  const std::size_t own = std::get<TwinJump>(twins_->parts[jump]).jump->event;
  if (events.size() < 2 && breaks_[own].empty()) return std::nullopt;
  for (std::size_t other = 0; other < events.size(); ++other)
    if (const std::string what = tie(other, jump); !what.empty())
      return fmt::format("t = {}: the jump of {} leads {}, up to its error",
                         brief(std::get<TwinJump>(twins_->parts[jump]).jump->t, 12),
                         events[own].name, what);
  auto at = instant(jump);
  if (!at) return std::nullopt;
  if (is_on_step(*at))
    return fmt::format("t = {}: the jump of {} takes a step within the errors of its values",
                       brief(at->t, 12), events[own].name);
  if (watch_.crossing[own] && happened_[own] && stays_at_zero(*watch_.crossing[own], jump))
    return fmt::format("t = {}: {} crosses 0 again within its rounding", brief(at->t, 12),
                       events[own].name);
  const auto has_happened = [&](std::size_t event) {
    return event == at->event || happened_[event];
  };
  if (!system_->has_clock(at->event)) at->own = guards(at->event, *at);
  set_time_error(*at);
  for (std::size_t other = 0; other < events.size(); ++other) {
    if (has_happened(other) || system_->has_clock(other)) continue;
    const std::vector<Guard> theirs = guards(other, *at);
    if (!may_happen(other, *at, theirs) || commute(other, theirs, *at)) continue;
    const auto nearest = std::min_element(
        theirs.begin(), theirs.end(),
        [](const Guard& a, const Guard& b) { return std::abs(a.value) < std::abs(b.value); });
    return message(*at, other, nearest->value, nearest->error);
  }
  return clocks_after(jump, *at);
}

}  // namespace gainsmith::claims
