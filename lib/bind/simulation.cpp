// Plant, observers and events, outputs, signals and reports.
#include <memory>
#include <set>
#include <utility>

#include "bind/binding.h"
#include "bind/dynamics_binding.h"
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

}  // namespace

std::size_t Binding::state_of(const std::string& name) const {
  std::size_t at = 0;
  while (at < design_->states.size() && design_->states[at].name != name) ++at;
  return at;
}

std::vector<model::NamedFormula> Binding::named(const std::vector<model::Named>& list,
                                                const expr::Scope& scope) const {
  std::vector<model::NamedFormula> bound;
  for (const model::Named& entry : list)
    bound.push_back({entry.name, formula(entry.value, scope), entry.place});
  return bound;
}

void Binding::bind_components() {
  dynamics_names_ = std::make_unique<DynamicsNames>(method(), varied());
  if (method().has_dynamics) return bind_dynamics();
  design_->report = named(method().report, names_->running);
  for (const model::NamedFormula& shown : design_->report)
    note_estimate(shown.name, shown.value.program);
}

/// Plant, observers and events; outputs and signals by the names under which they are shown.
void Binding::bind_dynamics() {
  expr::Scope& scope = names_->running;
  DynamicsBinding binding(method(), design_->dimensions, *dynamics_names_, problem().uncertain,
                          scope);
  design_->dynamics = binding.run();
  model::Dynamics& dynamics = *design_->dynamics;
  dynamics.has_timer = !timer_name(method()).empty();
  for (const model::Dynamics::Variable& variable : dynamics.variables)
    if (variable.kind == model::Dynamics::VariableKind::state ||
        variable.kind == model::Dynamics::VariableKind::mode)
      design_->states.push_back({variable.name, variable.shape, variable.start});
  const auto add_outputs = [&](const model::Component& component) {
    for (const model::Output& output : component.outputs) {
      const std::string name = dynamics_names_->full(component, output.name);
      const model::Formula value = formula(dynamics_names_->within(component, output.value), scope);
      dynamics.signals.push_back({name, value, binding.event_of_output(name)});
    }
  };
  for (const model::Named& input : method().inputs)
    dynamics.signals.push_back({input.name, formula(input.value, scope), std::nullopt});
  add_outputs(method().plant);
  for (const model::Component& observer : method().observers) add_outputs(observer);
  add_rates();
  for (const model::Named& signal : method().signals)
    for (const Reading& reading : dynamics_names_->add_signal(signal)) {
      const std::string name =
          reading.observer.empty() ? signal.name : reading.observer + "." + signal.name;
      scope.definitions[name] = {{}, reading.texts.front()};
      dynamics.signals.push_back({name, formula(reading.texts.front(), scope), std::nullopt});
    }
  design_->report = named(method().report, scope);
  for (const model::NamedFormula& shown : design_->report)
    note_estimate(shown.name, shown.value.program);
  names_->results = scope;
  names_->results.symbols["objective"] = {};
}

/// What rate(v) is made of: the flows of the states, and those of t and of the clocks.
void Binding::add_rates() {
  using Kind = model::Dynamics::VariableKind;
  expr::Scope& scope = names_->running;
  for (const model::Dynamics::Variable& variable : design_->dynamics->variables) {
    const bool rises = variable.kind == Kind::time || variable.kind == Kind::since;
    if (rises || variable.kind == Kind::left)
      scope.definitions[expr::rate_name(variable.name)] = {
          {}, unit_rate(!rises, method().dynamics_place)};
    if (variable.kind == Kind::measured_rate)
      scope.definitions[expr::rate_name(design_->dynamics->measured[variable.of].name)] = {
          {}, named_alone(variable.name, method().dynamics_place)};
  }
  const auto add_flows = [&](const model::Component& component) {
    for (const model::Named& entry : component.flow) {
      const std::string name = dynamics_names_->full(component, entry.name);
      scope.definitions[expr::rate_name(name)] = {{},
                                                  dynamics_names_->within(component, entry.value)};
      if (component.frozen)
        scope.definitions[expr::frozen_name(name)] = {
            {}, one_where(dynamics_names_->within(component, *component.frozen))};
    }
  };
  add_flows(method().plant);
  for (const model::Component& observer : method().observers) add_flows(observer);
}

/// Uncertain data and the definitions that use them, by others too.
std::set<std::string> Binding::varied() const {
  std::set<std::string> names;
  for (const model::UncertainText& text : problem().uncertain) names.insert(text.name);
  if (names.empty()) return names;
  for (std::size_t before = 0; before != names.size();) {
    before = names.size();
    for (const auto& [name, definition] : names_->running.definitions)
      for (const std::string& used : names_in(definition.body))
        if (names.contains(used)) names.insert(name);
  }
  return names;
}

/// What no program asks for is left out; all texts are bound.
void Binding::finish_dynamics() {
  if (!design_->dynamics) return;
  std::set<std::string> read = {timer_name(method())};
  const auto add = [&](const expr::Program& program) {
    for (const expr::Input& input : program.inputs) read.insert(input.name);
  };
  for_each_program(*design_->dynamics, add);
  std::set<std::size_t> counted;
  const auto add_figure = [&](const model::Figure& figure) {
    if (figure.kind == model::FigureKind::count || figure.kind == model::FigureKind::at_event ||
        figure.kind == model::FigureKind::lost)
      counted.insert(figure.event);
    if (figure.value) add(figure.value->program);
    if (figure.kind == model::FigureKind::passes)
      read.insert(expr::event_number("passes", design_->dynamics->events[figure.event].name));
  };
  for (const model::Figure& figure : design_->compare) add_figure(figure);
  if (design_->search && design_->search->run_figure) add_figure(*design_->search->run_figure);
  if (design_->expect)
    for (const model::ExpectedFigure& expected : design_->expect->run) add_figure(expected.figure);
  for (const model::Design::Claim& claim : design_->claims) {
    add(claim.value.program);
    for (const auto* part : {&claim.flow_cost, &claim.jump_cost, &claim.factor})
      if (*part) add((*part)->program);
    if (claim.over) counted.insert(*claim.over);
  }
  drop_unread(*design_->dynamics, read, counted);
}

}  // namespace gainsmith::bind
