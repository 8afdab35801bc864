#include "bind/simulation.h"

#include <memory>
#include <set>
#include <utility>

#include "bind/dynamics_binding.h"
#include "bind/estimates.h"
#include "bind/formulas.h"
#include "model/dynamics_programs.h"

namespace gainsmith::bind {

namespace {

/// where(condition, 1, 0).
expr::Expression one_where(const expr::Expression& condition) {
  const auto made = [&](expr::NodeKind kind, const char* text) {
    auto node = std::make_shared<expr::Node>();
    node->kind = kind;
    node->text = text;
    node->begin = condition.root->begin;
    node->end = condition.root->end;
    return node;
  };
  auto whole = made(expr::NodeKind::call, "where");
  whole->children = {condition.root, made(expr::NodeKind::number, "1"),
                     made(expr::NodeKind::number, "0")};
  return {condition.text, whole};
}

/// A text that is this name.
/// With a text of its own, so that messages can quote it.
expr::Expression named_alone(const std::string& name, const Place& place) {
  auto node = std::make_shared<expr::Node>();
  node->kind = expr::NodeKind::name;
  node->text = name;
  node->end = name.size();
  return {std::make_shared<const expr::Text>(expr::Text::generated(name, place)), node};
}

/// 1 or -1, as a text.
expr::Expression unit_rate(bool falls, const Place& place) {
  auto one = std::make_shared<expr::Node>();
  one->kind = expr::NodeKind::number;
  one->text = "1";
  auto root = one;
  if (falls) {
    root = std::make_shared<expr::Node>();
    root->kind = expr::NodeKind::negate;
    root->children = {one};
  }
  const std::string text = falls ? "-1" : "1";
  root->end = text.size();
  return {std::make_shared<const expr::Text>(expr::Text::generated(text, place)), root};
}

/// Each text as a formula, with its name.
std::vector<model::NamedFormula> named(const std::vector<model::Named>& list,
                                       const expr::Scope& scope) {
  std::vector<model::NamedFormula> bound;
  for (const model::Named& entry : list)
    bound.push_back({entry.name, formula(entry.value, scope), entry.place});
  return bound;
}

/// What rate(v) is made of: the flows of the states, and those of t and of the clocks.
/// rate(x) is the flow of x, 1 for the time and for times since an event, -1 for times left.
/// frozen(x) is 1 where the component of x rests.
void add_rates(Binding& binding) {
  using VariableKind = model::Dynamics::VariableKind;
  expr::Scope& scope = binding.names->running;
  for (const model::Dynamics::Variable& variable : binding.design->dynamics->variables) {
    const bool rises = variable.kind == VariableKind::time || variable.kind == VariableKind::since;
    if (rises || variable.kind == VariableKind::left)
      scope.definitions[expr::rate_name(variable.name)] = {
          {}, unit_rate(!rises, binding.method().dynamics_place)};
    if (variable.kind == VariableKind::measured_rate)
      scope.definitions[expr::rate_name(binding.design->dynamics->measured[variable.of].name)] = {
          {}, named_alone(variable.name, binding.method().dynamics_place)};
  }
  const auto add_flows = [&](const model::Component& component) {
    for (const model::Named& entry : component.flow) {
      const std::string name = binding.dynamics_names->full(component, entry.name);
      scope.definitions[expr::rate_name(name)] = {
          {}, binding.dynamics_names->within(component, entry.value)};
      if (component.frozen)
        scope.definitions[expr::frozen_name(name)] = {
            {}, one_where(binding.dynamics_names->within(component, *component.frozen))};
    }
  };
  add_flows(binding.method().plant);
  for (const model::Component& observer : binding.method().observers) add_flows(observer);
}

/// What the method asks to be shown, and the problem besides.
void bind_report(Binding& binding, const expr::Scope& scope) {
  std::vector<model::NamedFormula>& report = binding.design->report;
  report = named(binding.method().report, scope);
  for (model::NamedFormula& shown : named(binding.problem().report, scope)) {
    for (const model::NamedFormula& known : report)
      if (known.name == shown.name)
        throw InputError(shown.place, "report: '" + shown.name +
                                          "' is in the report of the method; choose another name");
    report.push_back(std::move(shown));
  }
  for (const model::NamedFormula& shown : report)
    note_estimate(*binding.design, shown.name, shown.value.program);
}

/// Plant, observers and events; outputs and signals by the names under which they are shown.
/// Signals are bound in their order; each may read those before it. One that reads an output of an
/// event exists at that event alone.
void bind_dynamics(Binding& binding) {
  expr::Scope& scope = binding.names->running;
  DynamicsBinding dynamics_binding(binding.method(), binding.design->dimensions,
                                   *binding.dynamics_names, binding.problem().uncertain,
                                   binding.data_texts, scope);
  binding.design->dynamics = dynamics_binding.run();
  model::Dynamics& dynamics = *binding.design->dynamics;
  dynamics.has_timer = !timer_name(binding.method()).empty();
  for (const model::Dynamics::Variable& variable : dynamics.variables)
    if (variable.kind == model::Dynamics::VariableKind::state ||
        variable.kind == model::Dynamics::VariableKind::mode)
      binding.design->states.push_back({variable.name, variable.shape, variable.start});
  const auto add_outputs = [&](const model::Component& component) {
    for (const model::Output& output : component.outputs) {
      const std::string name = binding.dynamics_names->full(component, output.name);
      const model::Formula value =
          formula(binding.dynamics_names->within(component, output.value), scope);
      dynamics.signals.push_back({name, value, dynamics_binding.event_of_output(name), true});
    }
  };
  for (const model::Named& input : binding.method().inputs)
    dynamics.signals.push_back({input.name, formula(input.value, scope), std::nullopt});
  add_outputs(binding.method().plant);
  for (const model::Component& observer : binding.method().observers) add_outputs(observer);
  add_rates(binding);
  for (const model::Named& signal : binding.method().signals)
    for (const Reading& reading : binding.dynamics_names->add_signal(signal)) {
      const std::string name =
          reading.observer.empty() ? signal.name : reading.observer + "." + signal.name;
      scope.definitions[name] = {{}, reading.texts.front()};
      const auto events = events_read(binding, reading.texts.front());
      std::optional<std::size_t> at;
      if (events.size() == 1) at = *events.begin();
      if (events.size() > 1)
        check_measured(binding, reading.texts.front(), at, signal.place,
                       ", and at another: a signal of both exists at none");
      dynamics.signals.push_back({name, formula(reading.texts.front(), scope), at});
    }
  bind_report(binding, scope);
}

/// Uncertain data, and the definitions and other data that use them, by others too.
std::set<std::string> varied(const Binding& binding) {
  std::set<std::string> names;
  for (const model::UncertainText& text : binding.problem().uncertain) names.insert(text.name);
  if (names.empty()) return names;
  const auto add = [&](const std::string& name, const expr::Expression& text) {
    for (const std::string& used : names_in(text))
      if (names.contains(used)) names.insert(name);
  };
  for (std::size_t before = 0; before != names.size();) {
    before = names.size();
    for (const auto& [name, definition] : binding.names->running.definitions)
      add(name, definition.body);
    for (const auto& [name, text] : binding.data_texts) add(name, text);
  }
  return names;
}

}  // namespace

/// Definitions are followed, so that a signal of a signal is at the event of the first.
std::set<std::size_t> events_read(const Binding& binding, const expr::Expression& text,
                                  bool measured) {
  const model::Dynamics& dynamics = *binding.design->dynamics;
  const auto is_measured = [&](const model::Dynamics::Signal& signal) {
    return std::ranges::any_of(dynamics.variables, [&](const auto& one) {
      return one.kind == model::Dynamics::VariableKind::measured &&
             signal.value.program.uses(one.name);
    });
  };
  std::set<std::string> names = expr::names_in(text), seen;
  std::set<std::size_t> events;
  while (!names.empty()) {
    const std::string name = names.extract(names.begin()).value();
    if (!seen.insert(name).second) continue;
    for (const model::Dynamics::Signal& signal : dynamics.signals)
      if (signal.name == name && signal.at && (!measured || (signal.output && is_measured(signal))))
        events.insert(*signal.at);
    const auto definition = binding.names->running.definitions.find(name);
    if (definition == binding.names->running.definitions.end()) continue;
    std::set<std::string> inner = expr::names_in(definition->second.body);
    for (const std::string& parameter : definition->second.parameters) inner.erase(parameter);
    names.merge(std::move(inner));
  }
  return events;
}

/// A measurement has a value at its event alone.
void check_measured(const Binding& binding, const expr::Expression& text,
                    std::optional<std::size_t> at, const Place& place, const std::string& advice) {
  for (const std::size_t event : events_read(binding, text, true))
    if (event != at)
      throw InputError(place, "this reads what is measured at the event '" +
                                  binding.design->dynamics->events[event].name + "' only" + advice);
}

/// States are in the order of the plant and the observers.
std::size_t state_of(const model::Design& design, const std::string& name) {
  std::size_t at = 0;
  while (at < design.states.size() && design.states[at].name != name) ++at;
  return at;
}

/// Names are sorted first, as uncertain data are of the plant alone.
void bind_components(Binding& binding) {
  binding.dynamics_names = std::make_unique<DynamicsNames>(binding.method(), varied(binding));
  if (binding.method().has_dynamics) return bind_dynamics(binding);
  bind_report(binding, binding.names->running);
}

/// Reads are those of flows, jumps, events, figures and claims.
void finish_dynamics(Binding& binding) {
  if (!binding.design->dynamics) return;
  std::set<std::string> read = {timer_name(binding.method())};
  const auto add = [&](const expr::Program& program) {
    for (const expr::Input& input : program.inputs) read.insert(input.name);
  };
  for_each_program(*binding.design->dynamics, add);
  const auto add_figure = [&](const model::Figure& figure) {
    if (figure.value) add(figure.value->program);
    if (figure.kind == model::FigureKind::passes)
      read.insert(
          expr::event_number("passes", binding.design->dynamics->events[figure.event].name));
  };
  for (const model::Figure& figure : binding.design->compare) add_figure(figure);
  if (binding.design->search && binding.design->search->run_figure)
    add_figure(*binding.design->search->run_figure);
  if (binding.design->expect)
    for (const model::ExpectedFigure& expected : binding.design->expect->run)
      add_figure(expected.figure);
  for (const model::Design::Claim& claim : binding.design->claims) {
    add(claim.value.program);
    for (const auto* part : {&claim.flow_cost, &claim.jump_cost, &claim.factor})
      if (*part) add((*part)->program);
  }
  drop_unread(*binding.design->dynamics, read);
}

}  // namespace gainsmith::bind
