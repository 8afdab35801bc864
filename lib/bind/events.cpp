// Events, what components do at them, noise.
#include <algorithm>
#include <functional>
#include <tuple>
#include <utility>

#include "base/nearest.h"
#include "base/number.h"
#include "bind/dynamics_binding.h"
#include "bind/formulas.h"
#include "expr/binding/compile.h"
#include "expr/binding/condition.h"

namespace gainsmith::bind {

namespace {

using EventKind = model::Dynamics::EventKind;
using Kind = model::Dynamics::VariableKind;

}  // namespace

/// Those of the method, of the plant, of the observers, in this order but for `order`. InputError
/// for a name that is given twice.
void DynamicsBinding::add_events() {
  const auto add = [&](const std::vector<model::EventText>& texts,
                       const model::Component* component, std::optional<std::size_t> at) {
    for (const model::EventText& text : texts) {
      model::Dynamics::Event event;
      event.own = text.name;
      event.name = component == nullptr ? text.name : full_name(*component, text.name);
      event.kind = text.kind;
      event.component = at;
      event.rows = text.rows;
      event.lost = text.lost;
      event.lost_in_a_row = text.lost_in_a_row;
      event.place = text.place;
      const auto [known, fresh] = events_.emplace(event.name, result_.events.size());
      if (!fresh)
        throw InputError(text.place, "there already is an event '" + text.name + "', in line " +
                                         std::to_string(result_.events[known->second].place.line));
      result_.events.push_back(std::move(event));
      event_texts_.push_back(&text);
    }
  };
  add(method_->events, nullptr, std::nullopt);
  add(method_->plant.events, &method_->plant, 0);
  for (std::size_t k = 0; k < method_->observers.size(); ++k)
    add(method_->observers[k].events, &method_->observers[k], k + 1);
  sort_events();
  for (std::size_t k = 0; k < result_.events.size(); ++k) events_[result_.events[k].name] = k;
  add_moments();
}

/// Those that `order` names come first, in its order.
void DynamicsBinding::sort_events() {
  const std::vector<std::string>& order = method_->order;
  const auto rank = [&](const model::Dynamics::Event& event) {
    return std::find(order.begin(), order.end(), event.name) - order.begin();
  };
  for (const std::string& name : order)
    if (std::count(order.begin(), order.end(), name) > 1)
      throw InputError(method_->dynamics_place, "order: '" + name + "' is given twice");
  for (const std::string& name : order)
    if (!events_.contains(name))
      throw InputError(method_->dynamics_place, "order: there is no event '" + name + "'" +
                                                    suggestion(name, names_->event_names(nullptr)));
  std::vector<std::size_t> at(result_.events.size());
  for (std::size_t k = 0; k < at.size(); ++k) at[k] = k;
  std::stable_sort(at.begin(), at.end(), [&](std::size_t a, std::size_t b) {
    return rank(result_.events[a]) < rank(result_.events[b]);
  });
  std::vector<model::Dynamics::Event> events;
  std::vector<const model::EventText*> texts;
  for (const std::size_t k : at) {
    events.push_back(std::move(result_.events[k]));
    texts.push_back(event_texts_[k]);
  }
  result_.events = std::move(events);
  event_texts_ = std::move(texts);
}

/// The numbers that texts may ask of events.
void DynamicsBinding::add_moments() {
  const auto add = [&](Kind kind, const std::string& name, std::size_t event) {
    model::Dynamics::Variable number;
    number.kind = kind;
    number.name = name;
    number.of = event;
    number.place = result_.events[event].place;
    scope_->symbols[name] = {{}, false, true};
    result_.variables.push_back(std::move(number));
  };
  for (std::size_t k = 0; k < result_.events.size(); ++k) {
    const model::Dynamics::Event& event = result_.events[k];
    add(Kind::count, expr::event_number("count", event.name), k);
    add(Kind::since, expr::event_number("since", event.name), k);
    add(Kind::passes, expr::event_number("passes", event.name), k);
    const std::string& left = event_texts_[k]->left;
    if (event.kind == EventKind::every)
      add(Kind::left, left.empty() ? event.name + ".left" : left, k);
  }
}

std::size_t DynamicsBinding::event(const model::Component* component, const std::string& name,
                                   const Place& place) const {
  if (const auto found = names_->event(component, name)) return events_.at(*found);
  throw InputError(
      place, "there is no event '" + name + "'" + suggestion(name, names_->event_names(component)));
}

/// A value that does not change along a run.
model::Formula DynamicsBinding::constant(const expr::Expression& text,
                                         std::optional<expr::Shape> shape) const {
  model::Formula bound = formula(text, *scope_, shape);
  for (const expr::Input& input : bound.program.inputs)
    if (is_moving(input.name))
      throw InputError(bound.place,
                       "'" + input.name +
                           "' changes along a run; this is made of what data, parameters "
                           "and gains give");
  return bound;
}

/// A condition over what its reader may read. `event`: at which it is read.
expr::Condition DynamicsBinding::condition(const expr::Expression& text,
                                           const model::Component* reader,
                                           std::optional<std::size_t> event,
                                           const expr::Scope& scope) const {
  check_reads({reader, event}, text, scope);
  return expr::compile_condition(text, scope);
}

namespace {

/// Whether a name that the condition reads is as asked.
bool any_input(const expr::Condition& condition,
               const std::function<bool(const std::string&)>& is) {
  if (!condition.is_comparison())
    return std::any_of(condition.parts.begin(), condition.parts.end(),
                       [&](const expr::Condition& part) { return any_input(part, is); });
  return std::any_of(condition.difference.inputs.begin(), condition.difference.inputs.end(),
                     [&](const expr::Input& input) { return is(input.name); });
}

}  // namespace

/// Of what has a value beforehand; the rest is checked when a run begins.
void DynamicsBinding::check_ends(const std::string& event, const model::Formula& low,
                                 const model::Formula& high) const {
  const auto is_known = [&](const model::Formula& end) {
    return end.program.functions.empty() &&
           std::all_of(end.program.inputs.begin(), end.program.inputs.end(),
                       [&](const expr::Input& input) {
                         const auto found = scope_->symbols.find(input.name);
                         return found != scope_->symbols.end() && found->second.known;
                       });
  };
  if (!is_known(low) || !is_known(high)) return;
  const double least = scope_->known->number(low.program);
  const double most = scope_->known->number(high.program);
  if (0 <= least && least <= most) return;
  throw InputError(low.place, "the event '" + event + "' comes after a time in [" + brief(least) +
                                  ", " + brief(most) + "]: expected 0 <= low <= high");
}

/// `when` has a condition, rises, falls and crosses have a number, `every` has the ends of its
/// length and of its first length, `at` has times. What never changes is refused.
void DynamicsBinding::bind_event(const model::EventText& text, const model::Component* component,
                                 std::size_t at) {
  const auto read = [&](const expr::Expression& expression) {
    return component != nullptr ? names_->within(*component, expression)
                                : names_->outside(expression);
  };
  model::Dynamics::Event& event = result_.events[at];
  const auto moves = [&](const std::string& name) { return is_moving(name); };
  if (text.kind == EventKind::when) {
    event.condition = condition(read(*text.what), component, std::nullopt, *scope_);
    if (!any_input(*event.condition, moves))
      throw InputError(event.condition->place,
                       "the condition of the event '" + text.name +
                           "' never changes: nothing that it compares moves");
  } else if (text.what) {
    const expr::Expression what = read(*text.what);
    if (expr::is_condition(what))
      throw InputError(what.place(*what.root),
                       "expected a number that changes its sign, such as x(1) - 2; a condition is "
                       "for 'when'");
    check_reads({component, std::nullopt}, what, *scope_);
    event.crossing = formula(what, *scope_, expr::Shape{});
    const auto& inputs = event.crossing->program.inputs;
    if (std::none_of(inputs.begin(), inputs.end(),
                     [&](const expr::Input& input) { return is_moving(input.name); }))
      throw InputError(event.crossing->place, "the event '" + text.name +
                                                  "' never is due: nothing in '" +
                                                  event.crossing->text + "' moves");
  }
  const auto ends = [&](const std::vector<expr::Expression>& list) {
    return std::pair{constant(read(list.front()), expr::Shape{}),
                     constant(read(list.back()), expr::Shape{})};
  };
  if (text.kind == EventKind::every) {
    std::tie(event.low, event.high) = ends(text.numbers);
    check_ends(text.name, *event.low, *event.high);
    if (!text.first.empty()) {
      std::tie(event.first_low, event.first_high) = ends(text.first);
      check_ends(text.name, *event.first_low, *event.first_high);
    }
  }
  if (text.kind == EventKind::at)
    for (const expr::Expression& expression : text.numbers)
      event.times.push_back(constant(read(expression), std::nullopt));
  if (text.only_if) event.only_if = condition(read(*text.only_if), component, at, *scope_);
}

/// x+ = g(x) for all entries at once. `repeats`: the pass is made again until its condition holds,
/// at most so often.
model::Dynamics::Pass DynamicsBinding::pass(const model::PassText& text,
                                            const model::Component& component, std::size_t at,
                                            std::size_t event) const {
  expr::Scope scope = *scope_;
  model::Component names = component;  // the names of `let` hide those of the component
  names.let.insert(names.let.end(), text.let.begin(), text.let.end());
  for (const model::Let& let : text.let)
    scope.definitions[names_->full(component, let.signature.name)] = {
        let.signature.parameters, names_->within(names, let.body, let.signature.parameters)};
  model::Dynamics::Pass bound;
  bound.repeats = text.repeats;
  bound.go_on = text.go_on;
  bound.place = text.place;
  for (const model::Named& entry : text.map) {
    const std::size_t of = state(component, at, entry, "the jump");
    const expr::Expression value = names_->within(names, entry.value);
    check_reads({&component, event}, value, scope);
    bound.map.push_back({of, formula(value, scope, result_.variables[of].shape), entry.place});
  }
  if (text.until)
    bound.until = condition(names_->within(names, *text.until), &component, event, scope);
  if (text.at_most)
    bound.at_most = constant(names_->within(component, *text.at_most), expr::Shape{});
  return bound;
}

/// What one component does at one event, pass after pass.
void DynamicsBinding::bind_reaction(const model::ReactionText& text,
                                    const model::Component& component, std::size_t at) {
  model::Dynamics::Reaction bound;
  bound.event = event(&component, text.event, text.place);
  bound.component = at;
  bound.place = text.place;
  for (const model::PassText& pass_text : text.passes)
    bound.passes.push_back(pass(pass_text, component, at, bound.event));
  result_.reactions.push_back(std::move(bound));
}

/// A frozen component rests while a condition of its modes holds; conditions of states would have
/// to be watched along flows.
void DynamicsBinding::bind_flow_sets(const model::Component& component, std::size_t at) {
  model::Dynamics::Component& bound = result_.components[at];
  const auto is_mode = [&](const std::string& name) {
    return std::any_of(result_.variables.begin(), result_.variables.end(),
                       [&](const model::Dynamics::Variable& variable) {
                         return variable.name == name && variable.kind == Kind::mode;
                       });
  };
  if (component.frozen) {
    bound.frozen =
        condition(names_->within(component, *component.frozen), &component, std::nullopt, *scope_);
    if (any_input(*bound.frozen,
                  [&](const std::string& name) { return is_moving(name) && !is_mode(name); }))
      throw InputError(bound.frozen->place, "frozen: a condition of modes, which do not flow");
  }
  for (const model::FlowSetText& flow_set : component.flow_sets)
    bound.flow_sets.push_back({condition(names_->within(component, flow_set.condition), &component,
                                         std::nullopt, *scope_),
                               flow_set.say, flow_set.place});
}

/// The name of the time; a method may name something else t.
std::string DynamicsBinding::time_of(const std::string& noise) {
  for (const model::Dynamics::Variable& variable : result_.variables)
    if (variable.kind == Kind::time) return variable.name;
  model::Dynamics::Variable time;
  time.kind = Kind::time;
  time.name = noise + ".time";
  scope_->symbols[time.name] = {};
  result_.variables.push_back(time);
  return time.name;
}

/// amplitude*sin(frequency*t + phase), a definition over three numbers that are drawn once a run.
void DynamicsBinding::bind_sinusoid(const model::NoiseText& text) {
  const std::string& w = text.name;
  for (const auto& [part, ends] : text.sinusoid) {
    model::Dynamics::Noise bound;
    bound.name = w + "." + part;
    bound.kind = model::Dynamics::NoiseKind::uniform;
    bound.place = text.place;
    for (const expr::Expression& end : {ends.front(), ends.back()})
      bound.values.push_back(constant(end, std::nullopt));
    bound.shape = bound.values.front().program.shape();
    if (bound.values.back().program.shape() != bound.shape)
      throw InputError(bound.values.back().place,
                       "both ends of the " + part + " of the noise " + w + " must have one shape");
    add_noise(std::move(bound));
  }
  const std::string sinusoid =
      "(" + w + ".amplitude) .* sin((" + w + ".frequency)*(" + time_of(w) + ") + " + w + ".phase)";
  const expr::Expression body = expr::parse(expr::Text::generated(sinusoid, text.place));
  result_.signals.push_back({w, formula(body, *scope_, std::nullopt), std::nullopt});
  scope_->definitions[w] = {{}, body};
}

/// Kinds with a center have a center and a deviation or covariance, others values that must have
/// one shape. It is drawn at an event, at multiples of `every`, or once a run.
void DynamicsBinding::bind_noise(const model::NoiseText& text) {
  if (!is_free(text.name))
    throw InputError(text.place, "'" + text.name + "' already names something else");
  if (!text.sinusoid.empty()) return bind_sinusoid(text);
  model::Dynamics::Noise bound;
  bound.name = text.name;
  bound.kind = text.kind;
  bound.covariance = text.covariance;
  bound.place = text.place;
  for (const expr::Expression& value : text.values)
    bound.values.push_back(constant(value, std::nullopt));
  bound.shape = bound.values.front().program.shape();
  const expr::Shape last = bound.values.back().program.shape();
  if (bound.has_center()) {
    if (bound.shape.is_scalar()) bound.shape = text.covariance ? expr::Shape{last.rows, 1} : last;
    check_spread(bound.values, text.covariance, bound.shape, "noise " + text.name);
  } else if (last != bound.shape)
    throw InputError(bound.values.back().place,
                     "both ends of the noise " + text.name + " must have one shape");
  if (!text.event.empty()) bound.event = event(nullptr, text.event, text.place);
  if (text.every) bound.every = constant(*text.every, expr::Shape{});
  add_noise(std::move(bound));
}

/// A noise is a variable that rests between its draws.
void DynamicsBinding::add_noise(model::Dynamics::Noise noise) {
  model::Dynamics::Variable variable;
  variable.kind = Kind::noise;
  variable.name = noise.name;
  variable.of = result_.noise.size();
  variable.shape = noise.shape;
  variable.place = noise.place;
  scope_->symbols[noise.name] = {noise.shape, false, true};
  result_.variables.push_back(std::move(variable));
  result_.noise.push_back(std::move(noise));
}

}  // namespace gainsmith::bind
