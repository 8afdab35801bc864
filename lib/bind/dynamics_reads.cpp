// Who may read what: observers read outputs of the plant, not its states.
#include "bind/dynamics_binding.h"

namespace gainsmith::bind {

/// Definitions are followed: what they read is read too.
void DynamicsBinding::check_reads(const Reader& reader, const expr::Expression& text,
                                  const expr::Scope& scope) const {
  std::set<std::string> seen;
  expr::visit_names(text, [&](const expr::Node& node) {
    check_name(reader, text, node, node.text, true, scope, seen);
  });
}

/// `states`: whether the states of the plant are checked for; within one of its outputs they are
/// not.
void DynamicsBinding::check_name(const Reader& reader, const expr::Expression& top,
                                 const expr::Node& node, const std::string& name, bool states,
                                 const expr::Scope& scope, std::set<std::string>& seen) const {
  const auto fail = [&](const std::string& message) { throw InputError(top.place(node), message); };
  const bool by_observer = reader.component != nullptr && reader.component->name != "plant";
  for (const model::Dynamics::Variable& variable : result_.variables) {
    const bool own_state = variable.kind == model::Dynamics::VariableKind::state ||
                           variable.kind == model::Dynamics::VariableKind::mode;
    if (!by_observer || !own_state || variable.name != name) continue;
    const model::Dynamics::Component& of = result_.components[variable.component];
    if (of.name == reader.component->name) continue;
    if (!of.observer && states)
      fail("'" + name + "' is a state of the plant, which the observer " +
           (reader.component->name == "observer" ? "" : reader.component->name + " ") +
           "does not know: it reads outputs, 'output: {y: ...}' of the plant");
    if (of.observer)
      fail("'" + name + "' belongs to the observer " + of.name + "; an observer reads its own");
  }
  if (const auto exists = output_events_.find(name); exists != output_events_.end()) {
    const std::size_t at = event(nullptr, exists->second, top.place(node));
    if (reader.event != at && (reader.component != nullptr || reader.event))
      fail("'" + name + "' exists only at the event '" + exists->second + "'");
  }
  const auto definition = scope.definitions.find(name);
  if (definition == scope.definitions.end() || !seen.insert(name).second) return;
  const bool inside = states && !outputs_of_plant_.contains(name);
  expr::visit_names(definition->second.body, [&](const expr::Node& inner) {
    const auto& own = definition->second.parameters;
    if (std::find(own.begin(), own.end(), inner.text) == own.end())
      check_name(reader, top, node, inner.text, inside, scope, seen);
  });
}

/// A flow_map goes back in time: measurements, draws and, within an observer, states of the plant
/// have no past that could be evaluated there.
void DynamicsBinding::set_reader(const model::Component* component) {
  using Kind = model::Dynamics::VariableKind;
  const bool by_observer = component != nullptr && component->name != "plant";
  scope_->without_past.clear();
  for (const model::Dynamics::Variable& variable : result_.variables) {
    const bool measured = variable.kind == Kind::measured || variable.kind == Kind::measured_rate;
    const bool drawn = variable.kind == Kind::noise &&
                       (result_.noise[variable.of].event || result_.noise[variable.of].every);
    const bool of_plant = by_observer && variable.kind == Kind::state && variable.component == 0;
    if (of_plant)
      scope_->without_past[variable.name] =
          "e has what the observer measures of '" + variable.name +
          "', and the past of measurements is not kept; it may have the observer's own states, the "
          "time and inputs that are functions of it";
    else if (measured || drawn)
      scope_->without_past[variable.name] =
          "e has '" + variable.name +
          "', whose past is not kept; it may have functions of the time";
  }
}

}  // namespace gainsmith::bind
