#include "model/dynamics.h"

#include "model/dynamics_programs.h"

namespace gainsmith::model {

namespace {

template <class Condition, class Visit>
void visit_condition(Condition& condition, const Visit& visit) {
  if (condition.is_comparison()) visit(condition.difference, condition.place);
  for (auto& part : condition.parts) visit_condition(part, visit);
}

/// Of dynamics, constant or not.
template <class Dynamics, class Visit>
void visit_run_programs(Dynamics& dynamics, const Visit& visit) {
  const auto optional = [&](auto& condition) {
    if (condition) visit_condition(*condition, visit);
  };
  for (auto& component : dynamics.components) {
    optional(component.frozen);
    for (auto& flow_set : component.flow_sets) visit_condition(flow_set.where, visit);
  }
  for (auto& entry : dynamics.flow) visit(entry.value.program, entry.value.place);
  for (auto& event : dynamics.events) {
    optional(event.condition);
    optional(event.only_if);
    if (event.crossing) visit(event.crossing->program, event.crossing->place);
  }
  for (auto& reaction : dynamics.reactions)
    for (auto& pass : reaction.passes) {
      for (auto& entry : pass.map) visit(entry.value.program, entry.value.place);
      optional(pass.until);
    }
}

}  // namespace

void for_each_program(const Dynamics& dynamics,
                      const std::function<void(const expr::Program&)>& visit) {
  visit_run_programs(dynamics, [&](const expr::Program& program, const Place&) { visit(program); });
  for (const Dynamics::Signal& signal : dynamics.signals) visit(signal.value.program);
}

void for_each_run_program(Dynamics& dynamics,
                          const std::function<void(expr::Program&, const Place&)>& visit) {
  visit_run_programs(dynamics, visit);
}

}  // namespace gainsmith::model
