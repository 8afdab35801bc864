#include "model/dynamics.h"

#include "model/dynamics_programs.h"

namespace gainsmith::model {

namespace {

using Visit = std::function<void(const expr::Program&)>;

void visit_condition(const expr::Condition& condition, const Visit& visit) {
  if (condition.is_comparison()) visit(condition.difference);
  for (const expr::Condition& part : condition.parts) visit_condition(part, visit);
}

void visit_condition(const std::optional<expr::Condition>& condition, const Visit& visit) {
  if (condition) visit_condition(*condition, visit);
}

}  // namespace

void for_each_program(const Dynamics& dynamics, const Visit& visit) {
  for (const Dynamics::Component& component : dynamics.components) {
    visit_condition(component.frozen, visit);
    for (const Dynamics::Component::FlowSet& flow_set : component.flow_sets)
      visit_condition(flow_set.where, visit);
  }
  for (const Dynamics::Assignment& entry : dynamics.flow) visit(entry.value.program);
  for (const Dynamics::Event& event : dynamics.events) {
    visit_condition(event.condition, visit);
    visit_condition(event.only_if, visit);
    if (event.crossing) visit(event.crossing->program);
  }
  for (const Dynamics::Reaction& reaction : dynamics.reactions)
    for (const Dynamics::Pass& pass : reaction.passes) {
      for (const Dynamics::Assignment& entry : pass.map) visit(entry.value.program);
      visit_condition(pass.until, visit);
    }
  for (const Dynamics::Signal& signal : dynamics.signals) visit(signal.value.program);
}

}  // namespace gainsmith::model
