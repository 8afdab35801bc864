#include "bind/campaign.h"

#include <cmath>

#include "base/named.h"
#include "base/nearest.h"
#include "base/number.h"
#include "bind/formulas.h"
#include "bind/simulation.h"

namespace gainsmith::bind {

namespace {

/// The value of a formula that is to be checked and uses data and parameters alone; none when it
/// uses gains.
std::optional<numbers::Matrix> known_value(const Binding& binding, const model::Formula& formula) {
  const bool known = formula.program.functions.empty() &&
                     model::has_values(formula.program, binding.recorder->values);
  if (!known || binding.checks == Checks::none) return std::nullopt;
  return numbers::evaluate(formula.program, binding.recorder->values);
}

/// The value of a formula over data alone; none where it uses gains or nothing is to be checked.
std::optional<double> known_scalar(const Binding& binding, const model::Formula& formula) {
  const auto value = known_value(binding, formula);
  return value ? std::optional((*value)(0, 0)) : std::nullopt;
}

/// InputError when the value is known and outside [low, high] by more than the rounding that the
/// simulation forgives, 1e-12 of high.
void check_within(const Binding& binding, const model::Formula& formula, const model::Formula& low,
                  const model::Formula& high, const std::string& what) {
  const auto value = known_scalar(binding, formula);
  const auto least = known_scalar(binding, low);
  const auto most = known_scalar(binding, high);
  if (!value || !least || !most) return;
  const double slack = 1e-12 * std::abs(*most);
  if (*value >= *least - slack && *value <= *most + slack) return;
  throw InputError(formula.place, what + " " + brief(*value) + " is outside [" + brief(*least) +
                                      ", " + brief(*most) + "]");
}

/// Low ends are not above high ends, element by element.
void check_box(const Binding& binding, const model::Design::Start& start,
               const model::InitialValue& initial) {
  const auto low = known_value(binding, start.values[0]);
  const auto high = known_value(binding, start.values[1]);
  if (!low || !high || numbers::shape_of(*low) != numbers::shape_of(*high)) return;
  if ((low->array() > high->array()).any())
    throw InputError(initial.values[1].place,
                     "the box of " + initial.state + " has its low end above its high end");
}

/// The fault, with the nearest name of a state.
InputError no_state(const Binding& binding, const std::string& name, const Place& place) {
  return {place, "there is no state '" + name + "'" +
                     suggestion(name, names_of_all(binding.design->states))};
}

/// {x: (x - c)'Q(x - c) <= level}, or the shell between two levels: c n x 1, Q n x n, level 1 x 1
/// or 1 x 2.
std::vector<model::Formula> ellipsoid(const Binding& binding, const model::InitialValue& initial,
                                      expr::Shape state) {
  const expr::Scope& scope = binding.names->running;
  if (initial.values.size() != 3)
    throw InputError(initial.place, "the initial value of " + initial.state + " is incomplete");
  if (state.cols != 1)
    throw InputError(initial.place, "an ellipsoid is of a column or a number; the state " +
                                        initial.state + " is " + to_string(state));
  model::Formula level = value(initial.values[2], scope, std::nullopt);
  const expr::Shape shape = level.program.shape();
  if (!shape.is_scalar() && shape != expr::Shape{1, 2})
    throw InputError(level.place, "the level of an ellipsoid is a number, or two of them, " +
                                      std::string("[low, high]; found ") + to_string(shape));
  return {value(initial.values[0], scope, state),
          value(initial.values[1], scope, expr::Shape{state.rows, state.rows}), std::move(level)};
}

/// One rule for the start of one state. Shapes are those of the state, or numbers for all of its
/// elements in a box.
model::Design::Start start(const Binding& binding, const model::InitialValue& initial) {
  const expr::Scope& scope = binding.names->running;
  model::Design::Start bound{
      state_of(*binding.design, initial.state), initial.kind, {}, initial.place};
  bound.covariance = initial.covariance;
  if (bound.state == binding.design->states.size())
    throw no_state(binding, initial.state, initial.place);
  const expr::Shape state = binding.design->states[bound.state].shape;
  if (initial.kind == model::StartKind::ellipsoid) {
    bound.values = ellipsoid(binding, initial, state);
    return bound;
  }
  if (has_center(initial.kind)) {
    for (const model::Value& given : initial.values)
      bound.values.push_back(value(given, scope, std::nullopt));
    check_spread(bound.values, initial.covariance, state, "the state " + initial.state);
    return bound;
  }
  for (const model::Value& given : initial.values) {
    if (initial.kind != model::StartKind::box) {
      bound.values.push_back(value(given, scope, state));
      continue;
    }
    model::Formula end = value(given, scope, std::nullopt);
    const expr::Shape shape = end.program.shape();
    const bool turned = given.flat && shape == expr::Shape{state.cols, state.rows};
    if (shape != state && !shape.is_scalar() && !turned)
      throw InputError(given.place, "a bound of the state " + initial.state +
                                        " must be a number or " + to_string(state) + "; found " +
                                        to_string(shape));
    bound.values.push_back(shape.is_scalar() ? std::move(end) : value(given, scope, state));
  }
  const bool enough = initial.kind == model::StartKind::list  ? !bound.values.empty()
                      : initial.kind == model::StartKind::box ? bound.values.size() == 2
                                                              : bound.values.size() == 1;
  if (!enough)
    throw InputError(initial.place, "the initial value of " + initial.state + " is incomplete");
  if (initial.kind == model::StartKind::box) check_box(binding, bound, initial);
  return bound;
}

/// The event of a timer that is the only clock; nullptr: there is none.
const model::Dynamics::Event* timer_event(const Binding& binding) {
  if (!binding.design->dynamics || timer_name(binding.method()).empty()) return nullptr;
  const auto& events = binding.design->dynamics->events;
  const model::Dynamics::Event* timer = nullptr;
  for (const model::Dynamics::Event& event : events) {
    if (event.low && timer != nullptr) return nullptr;
    if (event.low) timer = &event;
  }
  return timer;
}

/// Relative and absolute accuracy of runs, the latter also of single states.
void bind_accuracy(Binding& binding, const model::RunAccuracy& accuracy) {
  model::Design::RunAccuracy bound{accuracy.relative, accuracy.absolute, {}};
  for (const model::RunAccuracy::OfState& of_state : accuracy.states) {
    std::vector<std::string> names = binding.dynamics_names->states(of_state.state);
    if (names.empty()) names.push_back(of_state.state);
    for (const std::string& name : names) {
      const std::size_t state = state_of(*binding.design, name);
      if (state == binding.design->states.size()) throw no_state(binding, name, of_state.place);
      bound.states.emplace_back(state, of_state.absolute);
    }
  }
  binding.design->campaign.accuracy = std::move(bound);
}

/// The event whose clock a law is for.
std::size_t clock_of(const Binding& binding, const model::SamplingLaw& law) {
  const auto name = binding.dynamics_names->event(nullptr, law.event);
  const std::vector<model::Dynamics::Event> events = binding.design->dynamics
                                                         ? binding.design->dynamics->events
                                                         : std::vector<model::Dynamics::Event>{};
  for (std::size_t k = 0; name && k < events.size(); ++k)
    if (events[k].name == *name && events[k].low) return k;
  std::vector<std::string> clocks;
  for (const model::Dynamics::Event& event : events)
    if (event.low) clocks.push_back(event.name);
  throw InputError(law.place, "sampling: there is no event '" + law.event + "' with 'every'" +
                                  suggestion(law.event, clocks));
}

/// Whether runs are wanted: of a design that has inequalities the gains may be all that is.
bool is_run(const Binding& binding) {
  const bool wanted = !binding.method().claims.empty() || !binding.problem().compare.empty() ||
                      (binding.problem().expect && !binding.problem().expect->run.empty());
  const bool gains_alone =
      binding.problem().campaign.place.line == 0 && !binding.method().require.empty();
  return wanted && !gains_alone && binding.design->no_campaign.empty();
}

/// A name refers to the state of each observer that has it. A state that starts nowhere is an
/// error of runs alone (hybrid/scenario.h).
void bind_starts(Binding& binding) {
  auto& starts = binding.design->campaign.starts;
  for (const model::InitialValue& initial : binding.problem().campaign.initial) {
    const auto names = binding.dynamics_names->states(initial.state);
    if (names.empty()) starts.push_back(start(binding, initial));
    for (const std::string& name : names) {
      model::InitialValue begun = initial;
      begun.state = name;
      starts.push_back(start(binding, begun));
    }
  }
  if (!binding.design->dynamics) return;
  if (is_run(binding) && !ends(*binding.design))
    throw InputError(binding.problem().campaign.place.line > 0 ? binding.problem().campaign.place
                                                               : Place{binding.problem().file},
                     "the campaign needs 'horizon: ...': how long a run is");
}

}  // namespace

/// Values over data alone are checked here; those with gains are checked when a run begins.
void bind_campaign(Binding& binding) {
  const model::Campaign& campaign = binding.problem().campaign;
  const expr::Scope& scope = binding.names->running;
  model::Design::Campaign& bound = binding.design->campaign;
  bound.runs = campaign.runs;
  bound.seed = campaign.seed;
  bound.place = campaign.place;
  binding.design->no_campaign = binding.problem().no_campaign.empty()
                                    ? binding.method().no_campaign
                                    : binding.problem().no_campaign;
  if (campaign.horizon) {
    bound.horizon = scalar(*campaign.horizon, scope);
    const auto horizon = known_scalar(binding, *bound.horizon);
    if (horizon && !(*horizon > 0))
      throw InputError(bound.horizon->place,
                       "the horizon must be positive, not " + brief(*horizon));
  }
  if (campaign.first) {
    bound.first = scalar(*campaign.first, scope);
    if (const model::Dynamics::Event* timer = timer_event(binding); timer != nullptr)
      check_within(binding, *bound.first, *timer->first_low, *timer->first_high,
                   "the first timer value");
  }
  for (const model::SamplingLaw& law : campaign.sampling) {
    model::Design::Law& into = bound.laws.emplace_back();
    into.kind = law.kind;
    into.place = law.place;
    if (!law.event.empty()) into.event = clock_of(binding, law);
    for (const expr::Expression& each : law.values) {
      into.values.push_back(scalar(each, scope));
      if (const model::Dynamics::Event* timer = timer_event(binding);
          timer != nullptr && !into.event)
        check_within(binding, into.values.back(), *timer->low, *timer->high,
                     "the sampling interval");
    }
  }
  if (campaign.accuracy) bind_accuracy(binding, *campaign.accuracy);
  bind_starts(binding);
}

}  // namespace gainsmith::bind
